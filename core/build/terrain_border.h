// The borders of terrain tiles: which samples along a border are vertices of the tiles beside it. Decided
// from the border line alone, so that both sides choose the same; and, because every level's choice is known,
// the gap between a tile and any neighbour of another level is known exactly: skirts are as deep as that,
// borderErrorMetres says it. Vertices are inserted one by one where the line is farthest from the samples
// (Douglas and Peucker 1973, greedily).
#pragma once

#include <cstdint>
#include <vector>

#include "build/terrain_grid.h"
#include "build/terrain_heights.h"
#include "build/terrain_layout.h"

namespace fb {

// A point of a border line. `sides`: on which sides of the stretch to the next point there is terrain.
struct BorderPoint {
    std::int32_t place = 0, height = 0;  // grid units
    std::uint8_t sides = 0;
};
inline constexpr std::uint8_t kSideBefore = 1,
                              kSideAfter = 2;  // above or left of the line; below or right of it

// Which points stay: ends, places where `sides` changes, and the most telling others up to `edges` stretches
// in all.
[[nodiscard]] std::vector<std::uint8_t> keepOnBorder(const std::vector<BorderPoint>& line,
                                                     std::uint32_t edges);

// Stretches that a line of `cells` cells may keep: as many as a leaf's has, in proportion to the whole side.
[[nodiscard]] std::uint32_t borderEdges(const TerrainLayout& layout, std::uint32_t level,
                                        std::uint32_t cells);

// One side of a tile, from left to right or from top to bottom.
struct BorderSide {
    std::uint32_t level = 0;
    bool vertical = false;
    std::uint32_t line = 0;   // between tiles line - 1 and line
    std::uint32_t along = 0;  // the tile's number along the line
};
// The vertices that tiles of `side.level` have there; empty where the map has ended.
[[nodiscard]] Result<std::vector<BorderPoint>> borderOf(const TerrainHeights& heights,
                                                        const TerrainGrid& grid, const TerrainLayout& layout,
                                                        const BorderSide& side);

// Against every level whose tiles can lie across `own`, the vertices of `side`: by stretch of `own` how deep
// a skirt must reach, in grid units (the lowest that any neighbour lies where it lies below; kNoNeighbour
// where there is none of another level), and the widest gap either way.
inline constexpr double kNoNeighbour = 1e300;
struct BorderGaps {
    std::vector<double> reach;
    double widest = 0.0;
};
[[nodiscard]] Result<BorderGaps> borderGaps(const TerrainHeights& heights, const TerrainGrid& grid,
                                            const TerrainLayout& layout, const BorderSide& side,
                                            const std::vector<BorderPoint>& own);

}  // namespace fb
