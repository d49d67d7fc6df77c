// The yardstick of the benchmarks: all blocks welded by position into one mesh, and one call of
// meshoptimizer, without attributes, seams, cuts or locks.
#pragma once

#include "base/triangle_tree.h"
#include "import/source_scene.h"

namespace fb::bench {

struct WeldedMesh {
    std::vector<glm::vec3> points;  // metres from a common centre
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
    [[nodiscard]] std::vector<TriangleCorners> cornersOf(std::span<const std::uint32_t> chosen) const;
};

// Positions are one where they are equal in the source.
[[nodiscard]] WeldedMesh weldBlocks(std::span<const SourceBlock> blocks, const glm::dvec3& centre);

// Indices into `mesh.points`; stops at no error. More triangles than there are give all.
[[nodiscard]] std::vector<std::uint32_t> simplifyPlainly(const WeldedMesh& mesh, std::size_t triangles);

}  // namespace fb::bench
