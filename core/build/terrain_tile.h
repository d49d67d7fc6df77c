// The surface of one terrain tile, without skirts: a leaf has every cell of the map, two triangles each; a
// coarser tile is shaped from samples of the pyramid and simplified to about build.desired_triangles.
// Vertices are samples. Comes from terrain_heights; terrain_error measures it, terrain_node makes it a node.
// Borders: both tiles beside one keep the same samples there (terrain_border.h); before simplification the
// other border vertices are merged with the nearest kept one of their stretch, and the kept ones are locked.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "build/terrain_border.h"

namespace fb {

struct TileVertex {
    std::uint32_t column = 0, row = 0;  // of the map
    std::int32_t across = 0, down = 0, height = 0;
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  // (across, up, down), unit

    [[nodiscard]] glm::dvec3 place() const { return {across, height, down}; }
};

struct TileMesh {
    std::vector<TileVertex> vertices;
    std::vector<glm::uvec3> triangles;  // counter-clockwise as seen from above
    // The borders above, to the left, to the right and below, as this tile draws them, with their line's
    // numbers.
    std::array<std::vector<BorderPoint>, 4> borders;
    std::array<BorderSide, 4> sides;
    std::uint32_t firstColumn = 0, lastColumn = 0, firstRow = 0, lastRow = 0;  // of the map
    bool stuck = false;  // more than kStuckFactor times the aim
};

struct TerrainBuild {
    const TerrainHeights& heights;
    const TerrainGrid& grid;
    const TerrainLayout& layout;
    std::uint64_t desiredTriangles = 900;
};

[[nodiscard]] Result<TileMesh> makeTile(const TerrainBuild& build, const TerrainTile& tile);

}  // namespace fb
