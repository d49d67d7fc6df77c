// The closest points of a few triangles for many points near them, four points at a time and in single precision: for
// colours, where of two triangles almost as close either will do. Used by bake_charts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/triangle_tree.h"

namespace fb {

class ClosestOfFew {
  public:
    struct Hit {
        std::uint32_t triangle = 0;  // number among those given to search()
        glm::vec3 weights{0.0f};     // of its corners, adding to 1
    };

    // Begins with new points. `centre` lies amid them: single precision is to hold differences from it.
    void clear(const glm::dvec3& centre);
    void add(const glm::dvec3& point);
    // Looks at the triangles one after the other: of equally close ones the first is taken.
    void search(std::span<const TriangleCorners> triangles);
    [[nodiscard]] Hit hit(std::size_t point) const;

  private:
    static constexpr std::size_t kLanes = 4;
    // Vectors of GCC and Clang: compilers do not see by themselves that the loop over points needs no branches.
    using Floats [[gnu::vector_size(kLanes * sizeof(float))]] = float;
    using Numbers [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;
    struct Lanes {
        Floats x, y, z;
        Floats best;           // squared distance
        Floats second, third;  // weights of the corners
        Numbers triangle;
    };
    struct Edges;
    static void look(const Edges& edges, std::int32_t number, Lanes& lanes);

    glm::dvec3 centre_{0.0};
    std::vector<Lanes> lanes_;
    std::size_t count_ = 0;
};

}  // namespace fb
