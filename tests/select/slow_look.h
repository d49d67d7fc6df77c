// Visibility, cost and priority of a node for the slow implementations: corners of the box in camera axes instead
// of planes (algorithms 1 and 2, items 1 and 2).
#pragma once

#include "select/select.h"

namespace fb {

// How far all of the box lies outside the one side of the view that it misses most (item 1); 0: in view.
[[nodiscard]] double slowOutside(const View& view, const Box3f& box);
[[nodiscard]] double slowDistance(const glm::dvec3& eye, const Box3f& box);  // 0 inside
// To the finest surface that the hierarchy knows of (item 8).
[[nodiscard]] double slowSurfaceDistance(const Hierarchy& h, NodeId node, const glm::dvec3& eye);
[[nodiscard]] double slowCost(const SelectInput& in, NodeId node);
// Item 2, before anything is repaired: may be 0.
[[nodiscard]] double slowPriority(const SelectInput& in, NodeId node, double outside);

}  // namespace fb
