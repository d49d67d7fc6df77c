#include "build/block_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "build/cover_texels.h"

namespace fb {
namespace {

// 8-bit images with 1 to 4 channels to 3, or 4 when the alpha is wanted and there.
Image toColour(const Image& image, bool wantAlpha) {
    const bool hasAlpha = image.channels == 2 || image.channels == 4;
    Image result{image.width, image.height, wantAlpha && hasAlpha ? 4 : 3, {}, image.lossless};
    const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
    const auto from = static_cast<std::size_t>(image.channels),
               to = static_cast<std::size_t>(result.channels);
    result.pixels.resize(count * to);
    const bool grey = image.channels <= 2;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* texel = image.pixels.data() + i * from;
        std::uint8_t* out = result.pixels.data() + i * to;
        for (std::size_t c = 0; c < 3; ++c) out[c] = texel[grey ? 0 : c];
        if (to == 4) out[3] = texel[from - 1];
    }
    return result;
}

struct Usage {
    std::uint64_t triangles = 0;
    bool masked = false;
};

std::vector<Usage> countUsage(const SourceBlock& block) {
    std::vector<Usage> usage(block.textures.size());
    if (!block.mesh.hasUvs()) return usage;
    for (const std::uint32_t index : block.mesh.materials) {
        if (index == kNoMaterial) continue;
        const SourceMaterial& material = block.materials[index];
        if (material.texture < 0) continue;
        Usage& of = usage[static_cast<std::size_t>(material.texture)];
        ++of.triangles;
        of.masked = of.masked || material.alphaMask;
    }
    return usage;
}

}  // namespace

const Image& TextureLevels::level(int level) {
    while (static_cast<int>(levels.size()) <= level &&
           (levels.back().width > 1 || levels.back().height > 1)) {
        const Image& finer = levels.back();
        Image half{std::max(1, finer.width / 2), std::max(1, finer.height / 2), finer.channels, {}, false};
        half.pixels.resize(static_cast<std::size_t>(half.width) * half.height * half.channels);
        const TexelRect all{0, 0, static_cast<double>(finer.width), static_cast<double>(finer.height)};
        resampleArea(finer, all, EdgeMode::extend, {half, 0, 0, half.width, half.height, 0});
        levels.push_back(std::move(half));
    }
    return levels[std::min(static_cast<std::size_t>(std::max(level, 0)), levels.size() - 1)];
}

BlockTextures decodeTextures(const SourceBlock& block) {
    BlockTextures result;
    result.textures.resize(block.textures.size());
    const std::vector<Usage> usage = countUsage(block);
    for (std::size_t i = 0; i < usage.size(); ++i) {
        if (usage[i].triangles == 0) continue;
        const SourceTexture& source = block.textures[i];
        Result<Image> image = loadTexture(source);
        if (!image) {
            result.warnings.push_back(
                "texture " + source.name + " cannot be used: its " + std::to_string(usage[i].triangles) +
                " triangles are drawn in their base colour: " + image.error().oneLine());
            continue;
        }
        const bool fromFile = !source.file.empty() || !source.encoded.empty();
        result.losslessFiles = result.losslessFiles && fromFile && image->lossless;
        result.texels += static_cast<std::uint64_t>(image->width) * static_cast<std::uint64_t>(image->height);
        result.textures[i].emplace();
        result.textures[i]->levels.push_back(toColour(*image, usage[i].masked));
    }
    return result;
}

void fillUnusedTexels(BlockTextures& textures, const BlockMesh& mesh,
                      std::span<const MeshTriangle> triangles) {
    std::vector<std::vector<std::uint8_t>> shown(textures.textures.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!textures.textures[i]) continue;
        const Image& image = textures.textures[i]->levels[0];
        shown[i].resize(static_cast<std::size_t>(image.width) * image.height);
    }
    for (const MeshTriangle& triangle : triangles) {
        const int texture = mesh.surfaces[mesh.wedges[triangle.wedges.x].surface].texture;
        if (texture < 0) continue;
        const auto index = static_cast<std::size_t>(texture);
        const Image& image = textures.textures[index]->levels[0];
        const glm::dvec2 size(image.width, image.height);
        std::array<glm::dvec2, 3> corners;
        for (int k = 0; k < 3; ++k) corners[k] = glm::dvec2(mesh.wedges[triangle.wedges[k]].uv) * size;
        coverTexels(corners, image.width, image.height, shown[index]);
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!textures.textures[i]) continue;
        Image& image = textures.textures[i]->levels[0];
        if (std::find(shown[i].begin(), shown[i].end(), std::uint8_t{1}) == shown[i].end()) continue;
        if (image.channels == 4) {
            fillUnknown(image, shown[i], 3, 4);
            // Holes show no colour, but filtering would draw theirs into the edges around them.
            for (std::size_t t = 0; t < shown[i].size(); ++t) {
                if (image.pixels[t * 4 + 3] == 0) shown[i][t] = 0;
            }
        }
        fillUnknown(image, shown[i], 0, 3);
    }
}

glm::vec4 sampleTexture(TextureLevels& texture, const glm::vec2& uv, float footprint) {
    int wanted = 0;
    while (footprint >= 2.0f && wanted < 16) {
        footprint *= 0.5f;
        ++wanted;
    }
    const Image& image = texture.level(wanted);
    const glm::vec2 inTile = uv - glm::floor(uv);
    // Within one tile: the opposite edge of the picture must not bleed in.
    const float x = std::clamp(inTile.x * static_cast<float>(image.width) - 0.5f, 0.0f,
                               static_cast<float>(image.width - 1));
    const float y = std::clamp(inTile.y * static_cast<float>(image.height) - 0.5f, 0.0f,
                               static_cast<float>(image.height - 1));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    glm::vec4 result(0, 0, 0, 255);
    const auto texel = [&](int tx, int ty, int c) {
        return static_cast<float>(
            image.pixels[(static_cast<std::size_t>(ty) * image.width + tx) * image.channels + c]);
    };
    for (int c = 0; c < image.channels; ++c) {
        const float top = texel(x0, y0, c) * (1 - fx) + texel(x1, y0, c) * fx;
        const float bottom = texel(x0, y1, c) * (1 - fx) + texel(x1, y1, c) * fx;
        result[c] = top * (1 - fy) + bottom * fy;
    }
    return result;
}

}  // namespace fb
