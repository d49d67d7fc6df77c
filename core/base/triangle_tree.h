// Finds the closest point of a set of triangles: a tree of boxes, built once for a set.
// Used to find where blocks touch, for geometric errors, by skirts, and to carry colours from the original to a simplified
// mesh.
// Deterministic: of equally close triangles the one met first in the tree is taken, and the tree depends on
// the triangles alone.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/bounds.h"

namespace fb {

using TriangleCorners = std::array<glm::vec3, 3>;

struct ClosestPoint {
    std::uint32_t triangle = ~std::uint32_t{0};  // none
    glm::vec3 weights{0.0f};                     // of its corners, adding to 1
    float squaredDistance = std::numeric_limits<float>::infinity();
};

// The point of the triangle closest to `p` (Ericson 2005, Real-Time Collision Detection, 5.1.5).
[[nodiscard]] ClosestPoint closestOnTriangle(const glm::dvec3& p, const TriangleCorners& corners);

class TriangleTree {
  public:
    explicit TriangleTree(std::vector<TriangleCorners> triangles);

    [[nodiscard]] std::span<const TriangleCorners> triangles() const { return triangles_; }

    // The closest point of the triangles that `accepts(index)` admits, if closer than `best`; else `best`.
    // Stops at the first one not farther than `goodEnough` (squared).
    template <class Accepts>
    [[nodiscard]] ClosestPoint closest(const glm::vec3& p, ClosestPoint best, float goodEnough,
                                       Accepts&& accepts) const;
    [[nodiscard]] ClosestPoint closest(const glm::vec3& p) const {
        return closest(p, {}, -1.0f, [](std::uint32_t) { return true; });
    }
    // Calls visit(index) for the admitted triangles that are not farther from `p` than `distance`.
    template <class Accepts, class Visit>
    void visitNear(const glm::vec3& p, float distance, Accepts&& accepts, Visit&& visit) const;
    // Distance of `p` to triangle `index`, as a start for closest().
    [[nodiscard]] ClosestPoint closestOn(std::uint32_t index, const glm::dvec3& p) const {
        ClosestPoint result = closestOnTriangle(p, triangles_[index]);
        result.triangle = index;
        return result;
    }

    struct Node {
        Box3f box;
        std::uint32_t first = 0;  // leaf: into order(); inner node: its second child (the first one follows it)
        std::uint32_t count = 0;  // 0 for inner nodes
    };
    // Node 0 is the root; none without triangles.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

  private:
    static constexpr std::uint32_t kLeafSize = 4;

    struct Placed;  // a triangle by its centre
    std::uint32_t build(std::span<Placed> entries, std::uint32_t first);
    [[nodiscard]] static float squaredDistance(const Box3f& box, const glm::vec3& p) {
        const glm::vec3 d = glm::max(glm::max(box.min - p, p - box.max), glm::vec3(0.0f));
        return glm::dot(d, d);
    }

    std::vector<TriangleCorners> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<TriangleCorners> inOrder_;  // triangles_ as order_ has them: those of a leaf lie together
    std::vector<Node> nodes_;
};

template <class Accepts>
ClosestPoint TriangleTree::closest(const glm::vec3& p, ClosestPoint best, float goodEnough,
                                   Accepts&& accepts) const {
    if (nodes_.empty()) return best;
    struct Entry {
        std::uint32_t node;
        float squaredDistance;
    };
    std::array<Entry, 64> stack;  // the tree halves: never deeper than 32
    std::size_t size = 0;
    stack[size++] = {0, squaredDistance(nodes_[0].box, p)};
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.squaredDistance >= best.squaredDistance) continue;
        const Node& node = nodes_[entry.node];
        if (node.count == 0) {
            Entry near{entry.node + 1, squaredDistance(nodes_[entry.node + 1].box, p)};
            Entry far{node.first, squaredDistance(nodes_[node.first].box, p)};
            if (far.squaredDistance < near.squaredDistance) std::swap(near, far);
            if (far.squaredDistance < best.squaredDistance) stack[size++] = far;
            if (near.squaredDistance < best.squaredDistance) stack[size++] = near;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (!accepts(order_[i])) continue;
            const ClosestPoint candidate = closestOnTriangle(p, inOrder_[i]);
            if (candidate.squaredDistance < best.squaredDistance) {
                best = candidate;
                best.triangle = order_[i];
            }
            if (best.squaredDistance <= goodEnough) return best;
        }
    }
    return best;
}

template <class Accepts, class Visit>
void TriangleTree::visitNear(const glm::vec3& p, float distance, Accepts&& accepts, Visit&& visit) const {
    if (nodes_.empty()) return;
    const float limit = distance * distance;
    std::array<std::uint32_t, 64> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t at = stack[--size];
        const Node& node = nodes_[at];
        if (squaredDistance(node.box, p) > limit) continue;
        if (node.count == 0) {
            stack[size++] = node.first;
            stack[size++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (accepts(order_[i]) && closestOn(order_[i], p).squaredDistance <= limit) visit(order_[i]);
        }
    }
}

}  // namespace fb
