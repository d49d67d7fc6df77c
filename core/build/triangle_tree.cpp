#include "build/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace fb {
namespace {

ClosestPoint pointWith(const glm::vec3& p, const TriangleCorners& corners, const glm::vec3& weights) {
    const glm::vec3 on = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
    const glm::vec3 d = p - on;
    return {0, weights, glm::dot(d, d)};
}

// part / whole, both >= 0; edges that are short against the distance may have a whole of 0.
float share(float part, float whole) {
    return whole > 0.0f ? std::min(part / whole, 1.0f) : 0.0f;
}

// Of slivers the plane is not known well enough: the nearest of the three edges is.
ClosestPoint closestOnEdges(const glm::vec3& p, const TriangleCorners& corners) {
    ClosestPoint best;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3& a = corners[static_cast<std::size_t>(k)];
        const glm::vec3 along = corners[static_cast<std::size_t>((k + 1) % 3)] - a;
        const float length2 = glm::dot(along, along);
        const float t = length2 > 0.0f ? glm::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
        glm::vec3 weights(0.0f);
        weights[k] = 1.0f - t;
        weights[(k + 1) % 3] = t;
        const ClosestPoint candidate = pointWith(p, corners, weights);
        if (candidate.squaredDistance < best.squaredDistance) best = candidate;
    }
    return best;
}

}  // namespace

ClosestPoint closestOnTriangle(const glm::vec3& p, const TriangleCorners& corners) {
    const glm::vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = p - corners[0];
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return pointWith(p, corners, {1, 0, 0});
    const glm::vec3 bp = p - corners[1];
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return pointWith(p, corners, {0, 1, 0});
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
        const float v = share(d1, d1 - d3);
        return pointWith(p, corners, {1 - v, v, 0});
    }
    const glm::vec3 cp = p - corners[2];
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return pointWith(p, corners, {0, 0, 1});
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
        const float w = share(d2, d2 - d6);
        return pointWith(p, corners, {1 - w, 0, w});
    }
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
        const float w = share(d4 - d3, (d4 - d3) + (d5 - d6));
        return pointWith(p, corners, {0, 1 - w, w});
    }
    const float sum = va + vb + vc;
    const glm::vec3 normal = glm::cross(ab, ac);
    const float longest2 = std::max(glm::dot(ab, ab), glm::dot(ac, ac));
    if (!(sum > 0.0f) || glm::dot(normal, normal) < 1e-8f * longest2 * longest2)
        return closestOnEdges(p, corners);
    return pointWith(p, corners, {va / sum, vb / sum, vc / sum});
}

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles) : triangles_(std::move(triangles)) {
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(triangles_.size());
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box3f box, centres;
    for (std::uint32_t i = begin; i < end; ++i) {
        const TriangleCorners& t = triangles_[order_[i]];
        for (const glm::vec3& corner : t) box.grow(corner);
        centres.grow(t[0] + t[1] + t[2]);
    }
    nodes_[index].box = box;
    if (end - begin <= kLeafSize) {
        nodes_[index].first = begin;
        nodes_[index].count = end - begin;
        std::sort(order_.begin() + begin, order_.begin() + end);
        return index;
    }
    const int axis = centres.longestAxis();
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const TriangleCorners &s = triangles_[a], &t = triangles_[b];
                         const float left = s[0][axis] + s[1][axis] + s[2][axis];
                         const float right = t[0][axis] + t[1][axis] + t[2][axis];
                         return left != right ? left < right : a < b;
                     });
    build(begin, middle);
    const std::uint32_t second = build(middle, end);
    nodes_[index].first = second;
    return index;
}

}  // namespace fb
