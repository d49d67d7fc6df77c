// Moves the vertices that a simplified piece kept of the original so that its surface runs amid the original instead of
// inside its curves. Comes from simplify_level; block_levels draws the result in place of what was kept.
// Simplifiers by edge collapses keep a part of the vertices where they are: chords of a curved surface then all lie on
// one side of it, and half of the error is that they do. Each vertex moves along its normal by what makes the squares of
// the distances least, from vertices of the original to the planes of the triangles closest to them (Hoppe et al. 1993,
// Mesh Optimization, 4.1, with planes in place of points as Chen and Medioni 1992 have them).
#pragma once

#include <span>
#include <vector>

#include "build/block_mesh.h"
#include "build/numbering.h"

namespace fb {

// A position and the one that is drawn in its place.
struct MovedVertex {
    std::uint32_t from = 0, to = 0;

    auto operator<=>(const MovedVertex&) const = default;
};

// `drawn`: triangles of positions. Vertices on cuts, on the block's border, at the surface's own border or not of the
// original stay where they are, and so do all where the surface hardly deviates. No triangle turns by more than 60
// degrees. Ascending by `from`; adds positions to the mesh. `numbering` is for the positions before.
[[nodiscard]] std::vector<MovedVertex> fitSurface(BlockMesh& mesh, std::span<const MeshTriangle> original,
                                                  std::span<const glm::uvec3> drawn, Numbering& numbering);

}  // namespace fb
