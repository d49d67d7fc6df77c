#include "prepare_blocks.h"

#include <algorithm>

#include "build/build_scene.h"
#include "build/check_block.h"
#include "build/quantise_block.h"

namespace fb::bench {
namespace {

struct SurfaceBuilder {
    const glm::dvec3& centre;
    NodeSurface surface{};

    void add(const BlockMesh& mesh, const std::vector<glm::uvec3>& triangles, std::uint32_t block,
             std::uint32_t piece) {
        for (const glm::uvec3& t : triangles) {
            TriangleCorners corners;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 onGrid(mesh.positions[t[k]]);
                corners[static_cast<std::size_t>(k)] =
                    glm::vec3(mesh.grid.origin + mesh.grid.step * onGrid - centre);
            }
            surface.triangles.push_back(corners);
            surface.origins.push_back({block, piece, t});
        }
    }
};

}  // namespace

Result<std::vector<PreparedBlock>> prepareBlocks(const std::vector<SourceBlock>& blocks,
                                                 const BuildSettings& settings) {
    TextureStore store(kTextureCacheBytes);
    std::vector<PreparedBlock> result;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const SourceBlock& source = blocks[i];
        if (Result<void> sound = checkBlock(source); !sound) return passOn(sound);
        QuantisedBlock quantised = quantiseBlock(source, decodeTextures(source, store));
        PreparedBlock block{source.name, i, std::move(quantised.mesh), {}};
        if (quantised.triangles.empty()) continue;
        Level root;
        root.triangles = std::move(quantised.triangles);
        root.pieces.push_back({0, 0, static_cast<std::uint32_t>(root.triangles.size())});
        SplitCounters counters;
        block.levels = makeLevels(block.mesh, std::move(root), settings, counters);
        result.push_back(std::move(block));
    }
    return result;
}

std::size_t innerLevels(const std::vector<PreparedBlock>& blocks) {
    std::size_t most = 0;
    for (const PreparedBlock& block : blocks) most = std::max(most, block.levels.size() - 1);
    return most;
}

NodeSurface surfaceOfLevel(const std::vector<PreparedBlock>& blocks, std::size_t level,
                           const glm::dvec3& centre) {
    SurfaceBuilder builder{centre};
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        const BlockLevel& drawn = blocks[b].levels[blocks[b].levelFor(level)];
        for (std::uint32_t i = 0; i < drawn.original.pieces.size(); ++i)
            builder.add(blocks[b].mesh, drawn.drawn(blocks[b].mesh, i), b, i);
    }
    return std::move(builder.surface);
}

NodeSurface surfaceOfSource(const std::vector<PreparedBlock>& blocks, const glm::dvec3& centre) {
    SurfaceBuilder builder{centre};
    for (std::uint32_t b = 0; b < blocks.size(); ++b)
        builder.add(blocks[b].mesh, positionsOf(blocks[b].mesh, blocks[b].levels[0].piece(0)), b, 0);
    return std::move(builder.surface);
}

}  // namespace fb::bench
