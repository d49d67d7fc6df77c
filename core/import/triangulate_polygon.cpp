#include "import/triangulate_polygon.h"

#include <cmath>

#include "base/check.h"

namespace fb {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 ab = b - a, ac = c - a;
    return ab.x * ac.y - ab.y * ac.x;
}

// Newell: twice the vector area; relative to the first corner, so that far coordinates lose nothing.
glm::dvec3 vectorArea(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

// The polygon seen along the largest component of its normal, counter-clockwise.
std::vector<glm::dvec2> projected(std::span<const glm::dvec3> corners) {
    const glm::dvec3 normal = vectorArea(corners);
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 relative = corner - corners[0];
        const glm::dvec2 point(relative[u], relative[v]);
        flat.push_back(normal[drop] < 0.0 ? glm::dvec2(point.y, point.x) : point);
    }
    return flat;
}

bool isStrictlyConvex(const std::vector<glm::dvec2>& flat) {
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (!(cross(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) > 0.0)) return false;
    }
    return true;
}

void addFan(std::size_t corners, std::vector<glm::uvec3>& triangles) {
    for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.emplace_back(0u, i, i + 1);
}

// The shorter of the diagonals that leave both halves on the right side.
void cutQuad(std::span<const glm::dvec3> c, std::vector<glm::uvec3>& triangles) {
    const glm::dvec3 normal = vectorArea(c);
    const auto faces = [&](int i, int j, int k) {
        return glm::dot(glm::cross(c[j] - c[i], c[k] - c[i]), normal) > 0.0;
    };
    const bool first = faces(0, 1, 2) && faces(0, 2, 3);
    const bool second = faces(0, 1, 3) && faces(1, 2, 3);
    const bool secondIsShorter = glm::distance(c[1], c[3]) < glm::distance(c[0], c[2]);
    if (second && (!first || secondIsShorter)) {
        triangles.insert(triangles.end(), {{0u, 1u, 3u}, {1u, 2u, 3u}});
    } else {
        triangles.insert(triangles.end(), {{0u, 1u, 2u}, {0u, 2u, 3u}});
    }
}

class EarClipping {
  public:
    explicit EarClipping(const std::vector<glm::dvec2>& flat) : flat_(flat) {
        for (std::uint32_t i = 0; i < flat.size(); ++i) left_.push_back(i);
    }

    void run(std::vector<glm::uvec3>& triangles) {
        std::size_t at = 0;
        while (left_.size() > 3) {
            at = nextEar(at % left_.size());
            triangles.emplace_back(corner(at, -1), left_[at], corner(at, 1));
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
        }
        triangles.emplace_back(left_[0], left_[1], left_[2]);
    }

  private:
    [[nodiscard]] std::uint32_t corner(std::size_t at, int step) const {
        return left_[(at + left_.size() + static_cast<std::size_t>(step)) % left_.size()];
    }

    // The first ear from `start` on; where none is left (the polygon crosses itself) a corner without area,
    // and where there is none of those either, `start`: every step removes one corner.
    [[nodiscard]] std::size_t nextEar(std::size_t start) const {
        std::size_t flatCorner = start;
        bool foundFlat = false;
        for (std::size_t i = 0; i < left_.size(); ++i) {
            const std::size_t at = (start + i) % left_.size();
            const double turn = cross(flat_[corner(at, -1)], flat_[left_[at]], flat_[corner(at, 1)]);
            if (turn > 0.0 && !holdsACorner(at)) return at;
            if (turn == 0.0 && !foundFlat) {
                flatCorner = at;
                foundFlat = true;
            }
        }
        return flatCorner;
    }

    // A corner on the border counts, unless it lies exactly on one of the three (polygons with a bridge to a
    // hole).
    [[nodiscard]] bool holdsACorner(std::size_t at) const {
        const glm::dvec2 a = flat_[corner(at, -1)], b = flat_[left_[at]], c = flat_[corner(at, 1)];
        for (const std::uint32_t other : left_) {
            const glm::dvec2 p = flat_[other];
            if (p == a || p == b || p == c) continue;
            if (cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0) return true;
        }
        return false;
    }

    const std::vector<glm::dvec2>& flat_;
    std::vector<std::uint32_t> left_;
};

}  // namespace

void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<glm::uvec3>& triangles) {
    FB_CHECK(corners.size() >= std::size_t{3});
    if (corners.size() == 3) return triangles.emplace_back(0u, 1u, 2u), void();
    if (corners.size() == 4) return cutQuad(corners, triangles);
    const std::vector<glm::dvec2> flat = projected(corners);
    if (corners.size() > kMaxConcaveCorners || isStrictlyConvex(flat))
        return addFan(corners.size(), triangles);
    EarClipping(flat).run(triangles);
}

}  // namespace fb
