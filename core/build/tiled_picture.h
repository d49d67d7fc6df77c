// A picture of which only some tiles are there: what a block holds of a texture, however large that is.
// Comes from block_textures, which loads the tiles that triangles show; goes to resample_image as crops.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "build/resample_image.h"

namespace fb {

inline constexpr int kTileSide = 64;  // texels; the bits of a word
inline constexpr std::uint32_t kNoTile = ~std::uint32_t{0};

// One bit a texel: bit x of rows[y].
struct TileMask {
    std::array<std::uint64_t, kTileSide> rows{};

    [[nodiscard]] bool any() const;
};

struct TiledPicture {
    int width = 0, height = 0, channels = 0;
    int columns = 0, rows = 0;         // of tiles
    std::vector<std::uint32_t> tiles;  // columns * rows; number of the tile among those there are, or kNoTile
    std::vector<glm::ivec2> places;    // column and row of each tile that there is
    std::vector<std::uint8_t> texels;  // kTileSide * kTileSide * channels for each of them, rows from the top

    [[nodiscard]] static TiledPicture ofSize(int width, int height, int channels);
    [[nodiscard]] std::size_t tileBytes() const {
        return static_cast<std::size_t>(kTileSide) * kTileSide * static_cast<std::size_t>(channels);
    }
    [[nodiscard]] std::uint32_t tileAt(int column, int row) const {
        return tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
    // Outside the picture there is none.
    [[nodiscard]] std::uint32_t tileOrNone(int column, int row) const {
        const bool inside = column >= 0 && row >= 0 && column < columns && row < rows;
        return inside ? tileAt(column, row) : kNoTile;
    }
    // The number of the tile, which is made (without its texels) if it is not there.
    std::uint32_t addTile(int column, int row);
    // The texel's channels; its tile is there.
    [[nodiscard]] const std::uint8_t* texel(int x, int y) const {
        const std::size_t tile = tileAt(x / kTileSide, y / kTileSide);
        const auto inTile = static_cast<std::size_t>(y % kTileSide * kTileSide + x % kTileSide);
        return texels.data() + tile * tileBytes() + inTile * static_cast<std::size_t>(channels);
    }
    // Texels of the tile that lie in the picture: all but at its right and lower edge.
    [[nodiscard]] TileMask insideMask(std::uint32_t tile) const;
};

struct TexelBox {
    int x = 0, y = 0, width = 0, height = 0;
};

// The box as a picture of its own; one axis or both may wrap around the picture's edge. What lies in missing tiles
// takes the colour of the nearest texel that is there.
[[nodiscard]] Image cropPicture(const TiledPicture& picture, const TexelBox& box);

// Half as wide and high, rounded up, so that texel (x, y) is the mean of texels (2x, 2y) to (2x + 1, 2y + 1). It has
// every tile of which a quarter is there; the rest of such a tile is filled from around.
[[nodiscard]] TiledPicture halvedPicture(const TiledPicture& picture);

// The texel that is there and (nearly) nearest to (x, y). The picture has a tile.
[[nodiscard]] glm::ivec2 nearestTexel(const TiledPicture& picture, int x, int y);

}  // namespace fb
