// How far one surface lies from another: the one-sided Hausdorff distance, bounded from above.
// Used by measure_error. Branch and bound: boxes of `from` whose corners all lie close enough to one triangle of `to`
// are done with as a whole, since the distance to a convex set is convex; a triangle over the crease between two
// neighbours is bounded by the distances at its corners plus how far the crease lies off the straight connections;
// what is left is cut in two. (After Tang, Lee and Kim, "Interactive Hausdorff Distance Computation for General
// Polygonal Models", 2009; the bound over creases is our own.)
#pragma once

#include "build/triangle_tree.h"

namespace fb {

// A surface to measure from or to. Triangles index points.
class MeasuredSurface {
  public:
    MeasuredSurface(std::vector<glm::vec3> points, std::vector<glm::uvec3> triangles);

    [[nodiscard]] const TriangleTree& tree() const { return tree_; }
    [[nodiscard]] std::span<const glm::vec3> points() const { return points_; }
    [[nodiscard]] std::span<const glm::uvec3> triangles() const { return triangles_; }

  private:
    std::vector<glm::vec3> points_;
    std::vector<glm::uvec3> triangles_;
    TriangleTree tree_;
};

// The bound exceeds the distance (or `atLeast`) by no more than about this share and this many grid units; the latter
// also cover rounding of coordinates below 2^24 in float.
inline constexpr double kFarthestRelative = 0.1, kFarthestUnits = 4.0;

// An upper bound of the largest distance of any point of `from` to `to`, never below `atLeast`. Neither is empty.
[[nodiscard]] double farthestFrom(const MeasuredSurface& from, const TriangleTree& to, double atLeast);

}  // namespace fb
