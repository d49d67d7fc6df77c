// How near the finest surface of a node may be to the eye. Runs wherever a distance stands below an error in metres.
// A box that contains the eye says 0, and every bound on pixels the whole picture; the boxes of what it is made of
// say more: a street runs through the box of its block, but not through the boxes of its houses.
#pragma once

#include "scenefile/hierarchy.h"

namespace fb {

// Metres, a lower bound: the distance to the box where the eye is outside it, else the least distance to its
// children's, and so on; 0 where the eye is inside a leaf's box. Visits only boxes with the eye inside and their
// children (algorithms section 8).
[[nodiscard]] double surfaceDistance(const Hierarchy& hierarchy, NodeId node, const glm::dvec3& eye);

}  // namespace fb
