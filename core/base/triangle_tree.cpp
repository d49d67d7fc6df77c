#include "base/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace fb {
namespace {

// In double precision: corners are whole numbers below 2^24, whose products float cannot hold, and of slivers it would
// not know the plane.
ClosestPoint pointWith(const glm::dvec3& toFirst, const glm::dvec3& ab, const glm::dvec3& ac, double v, double w) {
    const glm::dvec3 d = toFirst + v * ab + w * ac;  // from the point to the closest one
    return {0, {static_cast<float>(1.0 - v - w), static_cast<float>(v), static_cast<float>(w)},
            static_cast<float>(glm::dot(d, d))};
}

// part / whole, both >= 0; edges without length have a whole of 0.
double share(double part, double whole) {
    return whole > 0.0 ? std::min(part / whole, 1.0) : 0.0;
}

}  // namespace

ClosestPoint closestOnTriangle(const glm::dvec3& p, const TriangleCorners& corners) {
    const glm::dvec3 a(corners[0]), ab = glm::dvec3(corners[1]) - a, ac = glm::dvec3(corners[2]) - a;
    const glm::dvec3 ap = p - a;
    const auto result = [&](double v, double w) { return pointWith(-ap, ab, ac, v, w); };
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return result(0.0, 0.0);
    const glm::dvec3 bp = ap - ab;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return result(1.0, 0.0);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return result(share(d1, d1 - d3), 0.0);
    const glm::dvec3 cp = ap - ac;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return result(0.0, 1.0);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return result(0.0, share(d2, d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = share(d4 - d3, (d4 - d3) + (d5 - d6));
        return result(1.0 - w, w);
    }
    const double sum = va + vb + vc;
    return sum > 0.0 ? result(vb / sum, vc / sum) : result(0.0, 0.0);
}

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles) : triangles_(std::move(triangles)) {
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(triangles_.size());
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
    inOrder_.reserve(order_.size());
    for (const std::uint32_t i : order_) inOrder_.push_back(triangles_[i]);
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
