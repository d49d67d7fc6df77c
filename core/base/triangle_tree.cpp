#include "base/triangle_tree.h"

#include <algorithm>

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

struct TriangleTree::Placed {
    glm::vec3 centre;  // sum of the corners
    std::uint32_t triangle;
};

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles) : triangles_(std::move(triangles)) {
    std::vector<Placed> entries;
    entries.reserve(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        const TriangleCorners& t = triangles_[i];
        entries.push_back({t[0] + t[1] + t[2], i});
    }
    nodes_.reserve(triangles_.size());
    if (!entries.empty()) build(entries, 0);
    order_.reserve(entries.size());
    inOrder_.reserve(entries.size());
    for (const Placed& entry : entries) {
        order_.push_back(entry.triangle);
        inOrder_.push_back(triangles_[entry.triangle]);
    }
}

// Of entries that begin with number `first`; boxes are known from the leaves up.
std::uint32_t TriangleTree::build(std::span<Placed> entries, std::uint32_t first) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    const auto count = static_cast<std::uint32_t>(entries.size());
    if (count <= kLeafSize) {
        std::ranges::sort(entries, {}, &Placed::triangle);
        Node& leaf = nodes_[index];
        leaf.first = first;
        leaf.count = count;
        for (const Placed& entry : entries) {
            for (const glm::vec3& corner : triangles_[entry.triangle]) leaf.box.grow(corner);
        }
        return index;
    }
    Box3f centres;
    for (const Placed& entry : entries) centres.grow(entry.centre);
    const int axis = centres.longestAxis();
    const std::uint32_t half = count / 2;
    std::ranges::nth_element(entries, entries.begin() + half, [axis](const Placed& a, const Placed& b) {
        const float left = a.centre[axis], right = b.centre[axis];
        return left != right ? left < right : a.triangle < b.triangle;
    });
    build(entries.first(half), first);
    const std::uint32_t second = build(entries.subspan(half), first + half);
    Node& node = nodes_[index];
    node.first = second;
    node.box = nodes_[index + 1].box;
    node.box.grow(nodes_[second].box);
    return index;
}

}  // namespace fb
