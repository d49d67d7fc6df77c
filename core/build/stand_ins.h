// Stand-ins for many small separate parts (houses as boxes, trees, leaves), which edge collapses would remove
// one by one until whole quarters were bare: a few parts stay, each grown to the area and within the bounds
// of those around it that it stands for. Used by simplify_level before a piece is simplified. (After Cook,
// Halstead, Planck and Ryu, "Stochastic Simplification of Aggregate Detail", 2007; parts that are close along
// a space-filling curve are joined, the smallest common bounds first, instead of drawn at random.)
#pragma once

#include <span>
#include <vector>

#include "build/block_mesh.h"
#include "build/numbering.h"

namespace fb {

struct StandIns {
    std::vector<std::uint8_t> replaced;  // by input triangle: 1 where a stand-in is drawn for it; empty: none
    std::vector<glm::uvec3> triangles;   // of positions, some of them new in the mesh

    [[nodiscard]] bool empty() const { return triangles.empty(); }
};

// `triangles` of positions, of one piece that should have `aim` triangles. Parts are connected by positions;
// those whose share of the aim, by area, is less than a tetrahedron are small. Where these are few or matter little,
// only those far from all others have stand-ins, each its own.
// `numbering` is for the positions that the triangles have.
[[nodiscard]] StandIns makeStandIns(BlockMesh& mesh, std::span<const glm::uvec3> triangles, std::size_t aim,
                                    Numbering& numbering);

}  // namespace fb
