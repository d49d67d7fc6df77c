// What the tests of the procedural city share: making small cities, loading all of one, hashing it.
#pragma once

#include <gtest/gtest.h>

#include "base/hash.h"
#include "import/city.h"

namespace fb::test {

inline std::unique_ptr<BlockSource> cityOf(const CityOptions& options) {
    auto city = makeCity(options);
    if (!city) ADD_FAILURE() << city.error().oneLine();
    return city ? std::move(*city) : nullptr;
}

// Small enough for sanitizers, large enough for streets inside, corners, cars and trees.
inline CityOptions smallCity(std::uint64_t seed = 1) {
    return {9, 36000, 180000, seed};
}

inline std::vector<SourceBlock> loadAll(const BlockSource& city) {
    std::vector<SourceBlock> blocks;
    for (std::size_t i = 0; i < city.blockCount(); ++i) {
        auto block = city.load(i);
        EXPECT_TRUE(block.has_value());
        if (block) blocks.push_back(std::move(*block));
    }
    return blocks;
}

inline std::uint64_t hashOf(const SourceBlock& block) {
    Hasher hash;
    hash.text(block.name);
    const auto vectors = [&](const auto& items) { hash.number(std::uint64_t{items.size()}); };
    vectors(block.mesh.positions);
    for (const glm::dvec3& p : block.mesh.positions) hash.number(p.x).number(p.y).number(p.z);
    for (const glm::vec3& n : block.mesh.normals)
        hash.number(double{n.x}).number(double{n.y}).number(double{n.z});
    for (const glm::vec2& uv : block.mesh.uvs) hash.number(double{uv.x}).number(double{uv.y});
    vectors(block.mesh.triangles);
    for (const glm::uvec3& t : block.mesh.triangles)
        hash.number(std::uint64_t{t.x}).number(std::uint64_t{t.y}).number(std::uint64_t{t.z});
    for (const std::uint32_t m : block.mesh.materials) hash.number(std::uint64_t{m});
    for (const SourceMaterial& m : block.materials) {
        hash.text(m.name).number(double{m.baseColour.x}).number(static_cast<double>(m.texture));
    }
    for (const SourceTexture& t : block.textures) {
        hash.number(static_cast<double>(t.image->width))
            .bytes(t.image->pixels.data(), t.image->pixels.size());
    }
    return hash.digest();
}

struct CityCounts {
    std::uint64_t triangles = 0, grey = 0, texels = 0;
};

inline CityCounts countsOf(const std::vector<SourceBlock>& blocks) {
    CityCounts counts;
    for (const SourceBlock& block : blocks) {
        counts.triangles += block.mesh.triangles.size();
        for (const std::uint32_t m : block.mesh.materials)
            counts.grey += block.materials[m].texture < 0 ? 1 : 0;
        for (const SourceTexture& t : block.textures) {
            counts.texels +=
                static_cast<std::uint64_t>(t.image->width) * static_cast<std::uint64_t>(t.image->height);
        }
    }
    return counts;
}

}  // namespace fb::test
