#include "build/block_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "build/cover_texels.h"
#include "build/spread_texels.h"

namespace fb {
namespace {

// Of a store that serves one block only.
constexpr std::uint64_t kOwnCacheBytes = std::uint64_t{64} << 20;

// What the block's triangles show of one texture.
struct Shown {
    std::uint64_t triangles = 0;
    bool masked = false;
    StoredTexture stored;
    TiledPicture picture;         // tiles without their texels
    std::vector<TileMask> masks;  // by tile
};

int textureOf(const SourceBlock& block, std::size_t triangle) {
    const std::uint32_t material = block.mesh.materials[triangle];
    return material == kNoMaterial ? -1 : block.materials[material].texture;
}

std::vector<Shown> countUsage(const SourceBlock& block) {
    std::vector<Shown> usage(block.textures.size());
    if (!block.mesh.hasUvs()) return usage;
    for (const std::uint32_t index : block.mesh.materials) {
        if (index == kNoMaterial) continue;
        const SourceMaterial& material = block.materials[index];
        if (material.texture < 0) continue;
        Shown& of = usage[static_cast<std::size_t>(material.texture)];
        ++of.triangles;
        of.masked = of.masked || material.alphaMask;
    }
    return usage;
}

void markSpan(Shown& shown, int row, int begin, int end) {
    for (int column = begin / kTileSide; column * kTileSide < end; ++column) {
        const std::uint32_t tile = shown.picture.addTile(column, row / kTileSide);
        if (tile == shown.masks.size()) shown.masks.emplace_back();
        const int first = std::max(begin - column * kTileSide, 0);
        const int count = std::min(end - column * kTileSide, kTileSide) - first;
        const std::uint64_t bits = count == kTileSide ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
        shown.masks[tile].rows[static_cast<std::size_t>(row % kTileSide)] |= bits << first;
    }
}

void markShown(const SourceBlock& block, std::vector<Shown>& shown) {
    if (!block.mesh.hasUvs()) return;
    for (std::size_t i = 0; i < block.mesh.triangles.size(); ++i) {
        const int texture = block.mesh.materials.empty() ? -1 : textureOf(block, i);
        if (texture < 0) continue;
        Shown& of = shown[static_cast<std::size_t>(texture)];
        if (of.picture.width == 0) continue;  // unreadable
        const glm::dvec2 size(of.picture.width, of.picture.height);
        std::array<glm::dvec2, 3> corners;
        bool usable = true;
        for (int k = 0; k < 3; ++k) {
            const glm::vec2& uv = block.mesh.uvs[block.mesh.triangles[i][k]];
            usable = usable && std::abs(uv.x) <= kLargestUv && std::abs(uv.y) <= kLargestUv;
            corners[static_cast<std::size_t>(k)] = glm::dvec2(uv) * size;
        }
        if (!usable) continue;
        coverTexels(corners, of.picture.width, of.picture.height,
                    [&](int row, int begin, int end) { markSpan(of, row, begin, end); });
    }
}

// Decoders go from top to bottom, so tiles are numbered and read in that order.
void sortTiles(Shown& shown) {
    TiledPicture sorted =
        TiledPicture::ofSize(shown.picture.width, shown.picture.height, shown.picture.channels);
    std::vector<TileMask> masks;
    masks.reserve(shown.masks.size());
    for (int row = 0; row < sorted.rows; ++row) {
        for (int column = 0; column < sorted.columns; ++column) {
            const std::uint32_t tile = shown.picture.tileAt(column, row);
            if (tile == kNoTile) continue;
            sorted.addTile(column, row);
            masks.push_back(shown.masks[tile]);
        }
    }
    shown.picture = std::move(sorted);
    shown.masks = std::move(masks);
}

// A row of texels with 1 to 4 channels to 3 or 4.
void toColour(const std::uint8_t* from, int fromChannels, int count, std::uint8_t* to, int toChannels) {
    const int green = fromChannels <= 2 ? 0 : 1, blue = fromChannels <= 2 ? 0 : 2;
    for (int i = 0; i < count; ++i, from += fromChannels, to += toChannels) {
        to[0] = from[0];
        to[1] = from[green];
        to[2] = from[blue];
        if (toChannels == 4) to[3] = from[fromChannels - 1];
    }
}

Result<void> readTiles(Shown& shown, TextureStore& store) {
    TiledPicture& picture = shown.picture;
    const int channels = shown.stored.header.channels;
    picture.texels.resize(picture.places.size() * picture.tileBytes());
    std::vector<std::uint8_t> part(static_cast<std::size_t>(kTileSide * kTileSide * channels));
    for (std::size_t i = 0; i < picture.places.size(); ++i) {
        const glm::ivec2 corner = picture.places[i] * kTileSide;
        const StoredRect rect{corner.x, corner.y, std::min(kTileSide, picture.width - corner.x),
                              std::min(kTileSide, picture.height - corner.y)};
        if (Result<void> read = store.read(shown.stored, rect, part.data()); !read) return read;
        std::uint8_t* const tile = picture.texels.data() + i * picture.tileBytes();
        for (int y = 0; y < rect.height; ++y) {
            toColour(part.data() + static_cast<std::size_t>(y * rect.width * channels), channels, rect.width,
                     tile + static_cast<std::size_t>(y * kTileSide * picture.channels), picture.channels);
        }
    }
    return {};
}

void fillUnshown(TiledPicture& picture, std::vector<TileMask>& shown) {
    if (picture.channels == 4) {
        std::vector<TileMask> opaque = shown;
        spreadTexels(picture, shown, 3, 4);
        // Holes show no colour, but filtering would draw theirs into the edges around them.
        for (std::size_t i = 0; i < opaque.size(); ++i) {
            const std::uint8_t* const texels = picture.texels.data() + i * picture.tileBytes();
            for (std::size_t at = 0; at < std::size_t{kTileSide} * kTileSide; ++at) {
                if (texels[at * 4 + 3] == 0) opaque[i].rows[at / kTileSide] &= ~(std::uint64_t{1} << at % kTileSide);
            }
        }
        shown = std::move(opaque);
    }
    spreadTexels(picture, shown, 0, 3);
}

}  // namespace

BlockTextures decodeTextures(const SourceBlock& block, TextureStore& store) {
    BlockTextures result;
    result.textures.resize(block.textures.size());
    std::vector<Shown> shown = countUsage(block);
    const auto refuse = [&](std::size_t i, const Error& error) {
        result.warnings.push_back("texture " + block.textures[i].name + " cannot be used: its " +
                                  std::to_string(shown[i].triangles) +
                                  " triangles are drawn in their base colour: " + error.oneLine());
    };
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown[i].triangles == 0) continue;
        Result<StoredTexture> stored = store.open(block.textures[i]);
        if (!stored) {
            refuse(i, stored.error());
            continue;
        }
        const TextureHeader& header = stored->header;
        const bool withAlpha = shown[i].masked && header.channels % 2 == 0;
        shown[i].picture = TiledPicture::ofSize(header.width, header.height, withAlpha ? 4 : 3);
        shown[i].stored = std::move(*stored);
    }
    markShown(block, shown);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        Shown& of = shown[i];
        if (of.picture.width == 0) continue;
        sortTiles(of);
        if (Result<void> read = readTiles(of, store); !read) {
            refuse(i, read.error());
            continue;
        }
        fillUnshown(of.picture, of.masks);
        const TextureHeader& header = of.stored.header;
        result.losslessFiles = result.losslessFiles && of.stored.pixels == nullptr && header.lossless;
        result.texels += static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
        result.tiles += of.picture.places.size();
        result.textures[i].emplace();
        result.textures[i]->levels.push_back(std::move(of.picture));
        of = {};
    }
    return result;
}

BlockTextures decodeTextures(const SourceBlock& block) {
    TextureStore store(kOwnCacheBytes);
    return decodeTextures(block, store);
}

}  // namespace fb
