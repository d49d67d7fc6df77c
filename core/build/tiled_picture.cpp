#include "build/tiled_picture.h"

#include <algorithm>
#include <cstring>

#include "build/spread_texels.h"

namespace fb {
namespace {

constexpr int kHalfTile = kTileSide / 2;

int tilesAlong(int texels) {
    return (texels + kTileSide - 1) / kTileSide;
}

std::uint64_t firstBits(int count) {
    return count >= kTileSide ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

// The means of 2 x 2 texels of a tile with `inside` texels in the picture, beyond which its last ones repeat.
void halveTile(const std::uint8_t* from, glm::ivec2 inside, int channels, std::uint8_t* into) {
    const auto count = static_cast<std::size_t>(channels);
    for (int y = 0; 2 * y < inside.y; ++y) {
        const int low = std::min(2 * y + 1, inside.y - 1);
        const std::uint8_t* const top = from + static_cast<std::size_t>(2 * y * kTileSide) * count;
        const std::uint8_t* const bottom = from + static_cast<std::size_t>(low * kTileSide) * count;
        std::uint8_t* out = into + static_cast<std::size_t>(y * kTileSide) * count;
        for (int x = 0; 2 * x < inside.x; ++x) {
            const std::size_t left = static_cast<std::size_t>(2 * x) * count;
            const std::size_t right = static_cast<std::size_t>(std::min(2 * x + 1, inside.x - 1)) * count;
            for (std::size_t c = 0; c < count; ++c) {
                *out++ = static_cast<std::uint8_t>(
                    (top[left + c] + top[right + c] + bottom[left + c] + bottom[right + c] + 2) / 4);
            }
        }
    }
}

}  // namespace

bool TileMask::any() const {
    return std::any_of(rows.begin(), rows.end(), [](std::uint64_t row) { return row != 0; });
}

TiledPicture TiledPicture::ofSize(int width, int height, int channels) {
    TiledPicture picture;
    picture.width = width;
    picture.height = height;
    picture.channels = channels;
    picture.columns = tilesAlong(width);
    picture.rows = tilesAlong(height);
    picture.tiles.assign(static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows),
                         kNoTile);
    return picture;
}

std::uint32_t TiledPicture::addTile(int column, int row) {
    std::uint32_t& tile = tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                static_cast<std::size_t>(column)];
    if (tile != kNoTile) return tile;
    tile = static_cast<std::uint32_t>(places.size());
    places.emplace_back(column, row);
    return tile;
}

TileMask TiledPicture::insideMask(std::uint32_t tile) const {
    const glm::ivec2 corner = places[tile] * kTileSide;
    TileMask mask;
    const int inRows = std::min(height - corner.y, kTileSide);
    std::fill_n(mask.rows.begin(), inRows, firstBits(width - corner.x));
    return mask;
}

Image cropPicture(const TiledPicture& picture, const TexelBox& box) {
    Image crop{box.width, box.height, picture.channels, {}, false};
    const auto channels = static_cast<std::size_t>(picture.channels);
    const std::size_t row = static_cast<std::size_t>(box.width) * channels;
    crop.pixels.resize(row * static_cast<std::size_t>(box.height));
    std::vector<std::uint8_t> known;  // by texel; empty as long as nothing is missing
    for (int y = 0; y < box.height; ++y) {
        const int sourceY = (box.y + y) % picture.height;
        for (int x = 0; x < box.width;) {
            const int sourceX = (box.x + x) % picture.width;
            const int run = std::min(std::min(kTileSide - sourceX % kTileSide, picture.width - sourceX),
                                     box.width - x);
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) +
                                   static_cast<std::size_t>(x);
            if (picture.tileAt(sourceX / kTileSide, sourceY / kTileSide) != kNoTile) {
                std::memcpy(crop.pixels.data() + at * channels, picture.texel(sourceX, sourceY),
                            static_cast<std::size_t>(run) * channels);
            } else {
                known.resize(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height), 1);
                std::fill_n(known.begin() + static_cast<std::ptrdiff_t>(at), run, std::uint8_t{0});
            }
            x += run;
        }
    }
    if (known.empty() || picture.places.empty()) return crop;
    if (std::find(known.begin(), known.end(), std::uint8_t{1}) == known.end()) {
        const glm::ivec2 near = nearestTexel(picture, (box.x + box.width / 2) % picture.width,
                                             (box.y + box.height / 2) % picture.height);
        std::memcpy(crop.pixels.data(), picture.texel(near.x, near.y), channels);
        known[0] = 1;
    }
    fillUnknown(crop, known, 0, crop.channels);
    return crop;
}

TiledPicture halvedPicture(const TiledPicture& picture) {
    TiledPicture half =
        TiledPicture::ofSize((picture.width + 1) / 2, (picture.height + 1) / 2, picture.channels);
    for (const glm::ivec2& place : picture.places) half.addTile(place.x / 2, place.y / 2);
    half.texels.resize(half.places.size() * half.tileBytes());
    std::vector<TileMask> known(half.places.size());
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = 0; i < picture.places.size(); ++i) {
        const glm::ivec2 place = picture.places[i];
        const glm::ivec2 inside = glm::min(glm::ivec2(picture.width, picture.height) - place * kTileSide,
                                           glm::ivec2(kTileSide));
        const std::size_t tile = half.tileAt(place.x / 2, place.y / 2);
        const glm::ivec2 quarter = place % 2 * kHalfTile;
        std::uint8_t* const into =
            half.texels.data() + tile * half.tileBytes() +
            static_cast<std::size_t>(quarter.y * kTileSide + quarter.x) * channels;
        halveTile(picture.texels.data() + i * picture.tileBytes(), inside, picture.channels, into);
        const glm::ivec2 made = (inside + 1) / 2;
        for (int y = 0; y < made.y; ++y) {
            known[tile].rows[static_cast<std::size_t>(quarter.y + y)] |= firstBits(made.x) << quarter.x;
        }
    }
    spreadTexels(half, known, 0, half.channels);
    return half;
}

glm::ivec2 nearestTexel(const TiledPicture& picture, int x, int y) {
    const glm::ivec2 at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
    const glm::ivec2 home = at / kTileSide;
    glm::ivec2 best = at;
    std::int64_t bestDistance = -1;
    const auto offer = [&](int column, int row) {
        if (picture.tileOrNone(column, row) == kNoTile) return;
        const glm::ivec2 low = glm::ivec2(column, row) * kTileSide;
        const glm::ivec2 high = glm::min(low + kTileSide, glm::ivec2(picture.width, picture.height)) - 1;
        const glm::ivec2 near = glm::clamp(at, low, high);
        const glm::i64vec2 off = glm::i64vec2(near - at);
        const std::int64_t distance = off.x * off.x + off.y * off.y;
        if (bestDistance >= 0 && distance >= bestDistance) return;
        best = near;
        bestDistance = distance;
    };
    offer(home.x, home.y);
    // Rings of tiles, from near to far.
    for (int ring = 1; bestDistance < 0 && ring < std::max(picture.columns, picture.rows); ++ring) {
        for (int i = -ring; i <= ring; ++i) {
            offer(home.x + i, home.y - ring);
            offer(home.x + i, home.y + ring);
            offer(home.x - ring, home.y + i);
            offer(home.x + ring, home.y + i);
        }
    }
    return best;
}

}  // namespace fb
