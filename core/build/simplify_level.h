// Simplifies the pieces of one level from the original, each to its own aim (thesis 3.2).
// Comes from split_mesh; finish_node dresses the result with attributes.
// Many small separate parts of a piece make room for stand-ins first (stand_ins.h). Then two steps. First all
// pieces of the level together, to the sum of their aims: cutting planes are seams there, so both sides of a
// cut are simplified alike and pieces of one level always meet exactly, and triangles go where detail is. Then
// each piece that still has more than kStuckFactor times its aim alone, with the vertices on cutting planes
// locked. Where texture seams hinder, or keeping them costs accuracy, they are welded and colours carried over
// later; where even that misses the aim by far, vertices are clustered. Every step but the last stops where
// shapes would be lost: such a piece is stuck.
#pragma once

#include <span>

#include "build/block_mesh.h"
#include "build/fit_surface.h"
#include "settings/settings.h"

namespace fb {

// More than this many times its aim: a piece is stuck.
inline constexpr double kStuckFactor = 1.5;

struct SimplifiedPiece {
    // Triangles of wedges; or, when seams were welded, of positions.
    std::vector<glm::uvec3> triangles;
    bool welded = false;
    bool clustered = false;  // then not even pieces of one level meet at cuts
    bool stuck = false;
    std::uint64_t carriedTriangles = 0;
    std::vector<std::uint32_t> replaced;  // positions of parts that stand-ins are drawn for, ascending
    std::vector<MovedVertex> moved;       // drawn elsewhere than where `triangles` have them

    // Where a position of `triangles` is drawn.
    [[nodiscard]] std::uint32_t drawnAt(std::uint32_t position) const;
};

// Triangles that a piece of `triangles` should have at `factor`.
[[nodiscard]] std::size_t simplificationAim(std::size_t triangles, double factor);

// One result per piece; never without triangles. Stand-ins add positions to the mesh. `aims` by piece.
[[nodiscard]] std::vector<SimplifiedPiece> simplifyLevel(BlockMesh& mesh, const Level& level,
                                                         std::span<const std::size_t> aims,
                                                         Simplifier simplifier);

}  // namespace fb
