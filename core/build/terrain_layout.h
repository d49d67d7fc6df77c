// The quadtree over a height map: which squares of cells are nodes. Comes from the map's size and
// build.desired_triangles; goes to build_terrain and the makers of tiles.
// A leaf is a square of 2^k cells with at most twice the desired triangles, two a cell; four squares make the
// one above, up to one root for the whole map. Squares without any cell are no nodes; those at the map's end
// are cut off.
#pragma once

#include <cstdint>

namespace fb {

struct TerrainTile {
    std::uint32_t level = 0;  // 0 is the root
    std::uint32_t x = 0, y = 0;
};

struct TerrainLayout {
    std::uint32_t columns = 0, rows = 0;  // samples
    std::uint32_t leafExponent = 0;       // 2^this cells along a leaf's side
    std::uint32_t depth = 0;              // the leaves' level

    [[nodiscard]] std::uint32_t leafCells() const { return 1u << leafExponent; }
    // The side of a tile of `level` is 2^this cells; also the level of the height pyramid whose cells are
    // such tiles.
    [[nodiscard]] std::uint32_t sideExponent(std::uint32_t level) const {
        return leafExponent + depth - level;
    }
    // Coarse tiles are shaped from the pyramid's level with eight times as many cells along a side as a leaf
    // has.
    [[nodiscard]] std::uint32_t strideExponent(std::uint32_t level) const {
        return depth - level > kFinerExponent ? depth - level - kFinerExponent : 0;
    }
    // Cells of the pyramid's level strideExponent() along a whole tile's side.
    [[nodiscard]] std::uint32_t shapeCells(std::uint32_t level) const {
        return 1u << (sideExponent(level) - strideExponent(level));
    }
    static constexpr std::uint32_t kFinerExponent = 3;
};

[[nodiscard]] inline TerrainLayout layOutTerrain(std::uint32_t columns, std::uint32_t rows,
                                                 std::uint64_t desiredTriangles) {
    TerrainLayout layout{columns, rows, 0, 0};
    while ((std::uint64_t{4} << (2 * layout.leafExponent)) <= desiredTriangles) ++layout.leafExponent;
    const std::uint64_t cells = (columns > rows ? columns : rows) - 1;
    while ((std::uint64_t{1} << (layout.leafExponent + layout.depth)) < cells) ++layout.depth;
    return layout;
}

}  // namespace fb
