// The separate parts of a piece: triangles that are connected by positions. Goes to stand_ins.
#pragma once

#include <span>
#include <vector>

#include "build/block_mesh.h"
#include "build/numbering.h"

namespace fb {

// Lengths in grid units.
struct Part {
    std::vector<std::uint32_t> triangles;  // of the input
    double area = 0.0;
    glm::dvec3 centre{0.0};  // by area
    Box3d bounds;
    std::uint64_t curve = 0;  // of the centre along a space-filling curve (Morton)
};

// In the order of their first triangles, which have positions. `numbering` is for positions.
[[nodiscard]] std::vector<Part> findParts(const BlockMesh& mesh, std::span<const glm::uvec3> triangles,
                                          Numbering& numbering);

}  // namespace fb
