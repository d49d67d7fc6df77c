#include "build/measured_surface.h"

#include <algorithm>

namespace fb {
namespace {

std::vector<TriangleCorners> cornersOf(const std::vector<glm::vec3>& points,
                                       const std::vector<glm::uvec3>& triangles) {
    std::vector<TriangleCorners> corners;
    corners.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) corners.push_back({points[t.x], points[t.y], points[t.z]});
    return corners;
}

}  // namespace

MeasuredSurface::MeasuredSurface(std::vector<glm::vec3> points, std::vector<glm::uvec3> triangles)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      neighbours_(triangles_.size(), glm::uvec3(kNoTriangle)),
      tree_(cornersOf(points_, triangles_)) {
    findNeighbours();
}

// Edges by their lower point, the same way as a counting sort: the first of an edge waits for the second.
void MeasuredSurface::findNeighbours() {
    const auto ends = [&](std::uint32_t side) {
        const glm::uvec3& t = triangles_[side / 3];
        const std::uint32_t a = t[static_cast<int>(side % 3)], b = t[static_cast<int>((side + 1) % 3)];
        return std::pair(std::min(a, b), std::max(a, b));
    };
    const auto sides = static_cast<std::uint32_t>(triangles_.size() * 3);
    std::vector<std::uint32_t> first(points_.size() + 1, 0);
    for (std::uint32_t side = 0; side < sides; ++side) ++first[ends(side).first + 1];
    for (std::size_t p = 0; p < points_.size(); ++p) first[p + 1] += first[p];
    std::vector<std::uint32_t> waiting(sides), count(points_.size(), 0);
    for (std::uint32_t side = 0; side < sides; ++side) {
        const auto [low, high] = ends(side);
        const auto here = waiting.begin() + first[low];
        const auto other =
            std::find_if(here, here + count[low], [&](std::uint32_t s) { return ends(s).second == high; });
        if (other == here + count[low]) {
            here[count[low]++] = side;
            continue;
        }
        neighbours_[side / 3][static_cast<int>(side % 3)] = *other / 3;
        neighbours_[*other / 3][static_cast<int>(*other % 3)] = side / 3;
        *other = here[--count[low]];
    }
}

}  // namespace fb
