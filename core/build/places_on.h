// From texels of a baked chart to points of the triangles drawn, and to places on triangles of the original. Used by
// bake_charts.
#pragma once

#include "build/node_triangles.h"

namespace fb {

// The points of a triangle that places in its chart stand for.
class PlacesOn {
  public:
    PlacesOn(const NodeTriangle& t, const BlockMesh& mesh) {
        for (int k = 0; k < 3; ++k) {
            corners_[static_cast<std::size_t>(k)] = glm::dvec3(mesh.positions[t.positions[k]]);
            flat_[static_cast<std::size_t>(k)] = glm::vec3(t.texels[static_cast<std::size_t>(k)], 0.0f);
        }
        const glm::dvec2 a(flat_[0]), b = glm::dvec2(flat_[1]) - a, c = glm::dvec2(flat_[2]) - a;
        const double area = b.x * c.y - b.y * c.x, longest = std::max(glm::dot(b, b), glm::dot(c, c));
        isSliver_ = area < 1e-2 * longest;
        if (isSliver_) return;
        const glm::dvec3 toB = corners_[1] - corners_[0], toC = corners_[2] - corners_[0];
        across_ = (c.y * toB - b.y * toC) / area;
        down_ = (b.x * toC - c.x * toB) / area;
        origin_ = corners_[0] - a.x * across_ - a.y * down_;
    }
    // Beside the triangle, in its plane; beside slivers, whose plane is not known well, on them.
    [[nodiscard]] glm::dvec3 at(const glm::vec2& place) const {
        if (!isSliver_) return origin_ + static_cast<double>(place.x) * across_ + static_cast<double>(place.y) * down_;
        const glm::vec3 weights = closestOnTriangle(glm::vec3(place, 0.0f), flat_).weights;
        return corners_[0] * static_cast<double>(weights.x) + corners_[1] * static_cast<double>(weights.y) +
               corners_[2] * static_cast<double>(weights.z);
    }

    // From a texel to the next; 0 on slivers.
    [[nodiscard]] const glm::dvec3& across() const { return across_; }
    [[nodiscard]] const glm::dvec3& down() const { return down_; }

  private:
    std::array<glm::dvec3, 3> corners_;
    TriangleCorners flat_;
    glm::dvec3 origin_{0.0}, across_{0.0}, down_{0.0};
    bool isSliver_ = false;
};

// By how much the weights of a triangle's corners change along a way; by nothing on slivers.
inline glm::vec3 weightsAlong(const TriangleCorners& corners, const glm::dvec3& way) {
    const glm::dvec3 b(corners[1] - corners[0]), c(corners[2] - corners[0]);
    const double bb = glm::dot(b, b), bc = glm::dot(b, c), cc = glm::dot(c, c), area = bb * cc - bc * bc;
    if (area <= 1e-5 * bb * cc) return glm::vec3(0.0f);
    const double onB = glm::dot(b, way), onC = glm::dot(c, way);
    const double v = (cc * onB - bc * onC) / area, w = (bb * onC - bc * onB) / area;
    return glm::vec3(glm::dvec3(-v - w, v, w));
}

}  // namespace fb
