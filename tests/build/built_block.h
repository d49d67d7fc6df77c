// Builds a block in a test and looks at the nodes that came out.
#pragma once

#include <gtest/gtest.h>

#include "block_worlds.h"
#include "build/build_scene.h"

namespace fb::test {

inline BuildSettings settingsOf(std::int64_t desired, std::int64_t factor) {
    BuildSettings settings;
    settings.desiredTriangles = desired;
    settings.levelFactor = factor;
    return settings;
}

inline BlockBuild build(const SourceBlock& block, const BuildSettings& settings) {
    TextureStore store(std::uint64_t{1} << 24);
    Result<BlockBuild> built = buildBlock(block, settings, store);
    EXPECT_TRUE(built) << built.error().oneLine();
    return built ? std::move(*built) : BlockBuild{};
}

inline std::uint32_t trianglesOf(const BuiltNode& node) {
    return node.texturedTriangles + node.untexturedTriangles;
}

inline std::vector<int> nodesPerLevel(const BlockBuild& built) {
    std::vector<int> counts;
    for (const BuiltNode& node : built.block.nodes) {
        counts.resize(std::max<std::size_t>(counts.size(), node.level + 1u), 0);
        ++counts[node.level];
    }
    return counts;
}

inline double ripple(double x, double y) {
    return 0.3 * std::sin(1.3 * x) * std::cos(0.9 * y) + 0.05 * std::sin(11 * x + 5 * y);
}

struct NodeView {
    const BlockBuild& built;
    std::size_t node;

    [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const {
        const NodeVertex& v = built.nodes[node].mesh.vertices[vertex];
        return built.block.grid.origin + built.block.grid.step * glm::dvec3(v.x, v.y, v.z);
    }
};

}  // namespace fb::test
