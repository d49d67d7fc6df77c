// A polygon in space becomes triangles with the same winding. Comes from the readers of OBJ, PLY, OFF and
// STL.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace fb {

// Concave polygons of more corners are cut as a fan, which may overlap itself: the search for ears is
// quadratic.
inline constexpr std::size_t kMaxConcaveCorners = 1000;

// Appends exactly corners.size() - 2 triangles of corner numbers to `triangles`; the caller has checked that
// there are at least three corners. A simple planar polygon, convex or not, keeps its area; of anything else
// (crossing itself, far from planar) every corner is used and the result is valid triangles all the same.
void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<glm::uvec3>& triangles);

}  // namespace fb
