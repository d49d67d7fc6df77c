// A surface to measure distances from or to: its triangles, a tree of them, and which of them meet at which
// edge. Comes from measure_error; farthest_from walks over it.
#pragma once

#include "base/triangle_tree.h"

namespace fb {

class MeasuredSurface {
  public:
    static constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

    // Triangles index points; where they have two points in common, they are neighbours.
    MeasuredSurface(std::vector<glm::vec3> points, std::vector<glm::uvec3> triangles);

    [[nodiscard]] const TriangleTree& tree() const { return tree_; }
    [[nodiscard]] std::span<const glm::vec3> points() const { return points_; }
    [[nodiscard]] std::span<const glm::uvec3> triangles() const { return triangles_; }
    // Over the edge from corner `corner` to the next; kNoTriangle at a border. Of more than two triangles at
    // one edge, those that follow each other in pairs are neighbours.
    [[nodiscard]] std::uint32_t neighbour(std::uint32_t triangle, int corner) const {
        return neighbours_[triangle][corner];
    }

  private:
    void findNeighbours();

    std::vector<glm::vec3> points_;
    std::vector<glm::uvec3> triangles_;
    std::vector<glm::uvec3> neighbours_;  // by triangle
    TriangleTree tree_;
};

}  // namespace fb
