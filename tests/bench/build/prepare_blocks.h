// Blocks cut and simplified as a build does it, before nodes are dressed; and their levels as surfaces to
// measure between, in metres from one common point. Comes from open_source, goes to sample_distance.
#pragma once

#include "base/triangle_tree.h"
#include "build/block_levels.h"
#include "import/source_scene.h"

namespace fb::bench {

struct PreparedBlock {
    std::string name;
    std::size_t source = 0;  // index into the blocks it was made from
    BlockMesh mesh;
    std::vector<BlockLevel> levels;

    // The level that stands for level `l` of the hierarchy: leaves do for all below.
    [[nodiscard]] std::size_t levelFor(std::size_t l) const { return std::min(l, levels.size() - 1); }
};

// Blocks that have no triangles on their grid are left out.
[[nodiscard]] Result<std::vector<PreparedBlock>> prepareBlocks(const std::vector<SourceBlock>& blocks,
                                                               const BuildSettings& settings);

// Levels that at least one block simplifies.
[[nodiscard]] std::size_t innerLevels(const std::vector<PreparedBlock>& blocks);

// Where a triangle comes from: index into the blocks, piece of the level, and its positions in the block's
// mesh.
struct TriangleOrigin {
    std::uint32_t block = 0, piece = 0;
    glm::uvec3 positions{0};
};

struct NodeSurface {
    std::vector<TriangleCorners> triangles;
    std::vector<TriangleOrigin> origins;  // by triangle
};

// What the blocks' nodes at `level` draw together.
[[nodiscard]] NodeSurface surfaceOfLevel(const std::vector<PreparedBlock>& blocks, std::size_t level,
                                         const glm::dvec3& centre);
// The source on its grid, before any cut.
[[nodiscard]] NodeSurface surfaceOfSource(const std::vector<PreparedBlock>& blocks, const glm::dvec3& centre);

}  // namespace fb::bench
