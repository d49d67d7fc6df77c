// The geometric error of a node: how far the original may lie from what is drawn.
// Comes from simplify_level's result, goes into the hierarchy; policies divide it by the distance to get
// pixels. It is the largest of the simplifier's own estimate and the distances from vertices of the original
// (all up to kErrorSamples, evenly chosen ones above) to the node's surface, plus one step of the grid: an
// upper estimate, not a proof. build_block then raises parents to their children.
#pragma once

#include <span>

#include "build/node_triangles.h"

namespace fb {

inline constexpr std::size_t kErrorSamples = 4096;

// In grid units.
[[nodiscard]] double measureError(const BlockMesh& mesh, std::span<const MeshTriangle> piece,
                                  std::span<const NodeTriangle> node, double simplifierError);

}  // namespace fb
