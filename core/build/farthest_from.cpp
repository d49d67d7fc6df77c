#include "build/farthest_from.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace fb {
namespace {

// After so many cuts a part is 256 times smaller, and what it adds at most is taken for what it adds: work is bounded.
constexpr int kDeepest = 16;
// In the first cuts a side that leads over several creases counts for so many times its length.
constexpr int kFirstCuts = 8;
constexpr float kFarSide = 3.0f;
constexpr float kTouching = 2.0f;  // grid units: a corner this close to `to` may belong to several of its faces
constexpr float kEnough = 0.5f;    // of the bound: a face as close as this need not be the closest
constexpr auto kShare = static_cast<float>(1.0 + kFarthestRelative);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A point of `from` and the closest one of `to`.
struct Probe {
    glm::vec3 point{0.0f};
    std::uint32_t face = ~std::uint32_t{0};  // of `to`; none: not looked for yet
    float distance = 0.0f;
    glm::vec3 on{0.0f};  // the closest point
};
using Piece3 = std::array<Probe, 3>;

glm::vec3 pointOn(const TriangleCorners& face, const glm::vec3& weights) {
    return face[0] * weights.x + face[1] * weights.y + face[2] * weights.z;
}

// The edge that two triangles have in common; false where they have none.
bool sharedEdge(const TriangleCorners& a, const TriangleCorners& b, std::array<glm::vec3, 2>& edge) {
    std::size_t found = 0;
    for (const glm::vec3& p : a) {
        if (p != b[0] && p != b[1] && p != b[2]) continue;
        if (found == 2) return true;
        edge[found++] = p;
    }
    return found == 2;
}

// Where a straight connection p-q is bent to meet an edge: the points of both that are closest, or nearly so.
struct Bend {
    float at = 0.0f;  // along the connection
    float by = 0.0f;  // distance
};
Bend bendTo(const glm::vec3& p, const glm::vec3& q, const std::array<glm::vec3, 2>& edge) {
    const glm::vec3 u = q - p, v = edge[1] - edge[0], w = p - edge[0];
    const float a = glm::dot(u, u), b = glm::dot(u, v), c = glm::dot(v, v), d = glm::dot(u, w), e = glm::dot(v, w);
    const float det = a * c - b * b;
    const float s = det > 0.0f ? glm::clamp((b * e - c * d) / det, 0.0f, 1.0f) : 0.5f;
    const float t = c > 0.0f ? glm::clamp((b * s + e) / c, 0.0f, 1.0f) : 0.0f;
    const float again = a > 0.0f ? glm::clamp((b * t - d) / a, 0.0f, 1.0f) : 0.0f;
    return {again, glm::distance(p + u * again, edge[0] + v * t)};
}

class Farthest {
  public:
    Farthest(const TriangleTree& to, double atLeast)
        : to_(to),
          lower_(static_cast<float>(atLeast) / kShare),
          bound_(static_cast<float>(atLeast)) {}

    void coverSurface(const MeasuredSurface& from) {
        from_ = &from;
        probes_.resize(from.points().size());
        probeAll();
        coverNode(0);
    }
    [[nodiscard]] double bound() const { return static_cast<double>(bound_); }

  private:
    static constexpr auto kAny = [](std::uint32_t) { return true; };

    void reach(float distance) {
        lower_ = std::max(lower_, distance);
        bound_ = std::max(bound_, distance);
    }
    [[nodiscard]] ClosestPoint startAt(std::uint32_t face, const glm::vec3& p) const {
        return face < to_.triangles().size() ? to_.closestOn(face, p) : ClosestPoint{};
    }
    [[nodiscard]] Probe probeOn(const glm::vec3& p, const ClosestPoint& at) const {
        return {p, at.triangle, std::sqrt(at.squaredDistance), pointOn(to_.triangles()[at.triangle], at.weights)};
    }
    Probe probeAt(const glm::vec3& p, std::uint32_t near) {
        const ClosestPoint at = to_.closest(p, startAt(near, p), -1.0f, kAny);
        guess_ = at.triangle;
        reach(std::sqrt(at.squaredDistance));
        return probeOn(p, at);
    }
    // Halfway; a face of the two will do where it is well within the bound.
    Probe probeBetween(const Probe& a, const Probe& b) {
        const glm::vec3 middle = 0.5f * (a.point + b.point);
        ClosestPoint at = to_.closestOn(a.face, middle);
        if (b.face != a.face) {
            const ClosestPoint other = to_.closestOn(b.face, middle);
            if (other.squaredDistance < at.squaredDistance) at = other;
        }
        const float enough = kEnough * bound_;
        if (at.squaredDistance > enough * enough) return probeAt(middle, at.triangle);
        return probeOn(middle, at);
    }
    const Probe& probeOf(std::uint32_t point) {
        Probe& probe = probes_[point];
        if (probe.face != ~std::uint32_t{0}) return probe;
        const glm::vec3& p = from_->points()[point];
        const ClosestPoint start = startAt(guess_, p);
        const float enough = kEnough * bound_;
        return probe = start.squaredDistance > enough * enough ? probeAt(p, guess_) : probeOn(p, start);
    }

    // Raises what is reached for certain before anything is refined: searches end at the first triangle not farther.
    void probeAll() {
        for (const glm::vec3& p : from_->points()) {
            const ClosestPoint start = startAt(guess_, p);
            if (start.squaredDistance <= lower_ * lower_) continue;
            const ClosestPoint near = to_.closest(p, start, lower_ * lower_, kAny);
            guess_ = near.triangle;
            reach(std::sqrt(near.squaredDistance));
        }
        bound_ = std::max(bound_, lower_ * kShare);
    }

    [[nodiscard]] bool boxIsNear(const Box3f& box, std::uint32_t face) const {
        for (std::size_t i = 0; i < 8; ++i) {
            const glm::vec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                   (i & 4) != 0 ? box.max.z : box.min.z);
            if (to_.closestOn(face, corner).squaredDistance > bound_ * bound_) return false;
        }
        return true;
    }

    void coverNode(std::uint32_t index) {
        const TriangleTree& from = from_->tree();
        const TriangleTree::Node& node = from.nodes()[index];
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) coverIndexed(from.order()[i]);
            return;
        }
        if (guess_ < to_.triangles().size() && boxIsNear(node.box, guess_)) return;
        coverNode(index + 1);
        coverNode(node.first);
    }

    void coverIndexed(std::uint32_t triangle) {
        const TriangleCorners& corners = from_->tree().triangles()[triangle];
        if (guess_ < to_.triangles().size() && farthestCorner(corners, guess_) <= bound_) return;
        const glm::uvec3& t = from_->triangles()[triangle];
        cover({probeOf(t.x), probeOf(t.y), probeOf(t.z)}, 0);
    }

    // The largest distance of the corners to the face, or infinity once one is beyond the bound.
    [[nodiscard]] float farthestCorner(const TriangleCorners& corners, std::uint32_t face) const {
        float worst = 0.0f;
        for (const glm::vec3& p : corners) {
            worst = std::max(worst, to_.closestOn(face, p).squaredDistance);
            if (worst > bound_ * bound_) return kInfinity;
        }
        return std::sqrt(worst);
    }

    // The creases between the faces of each two corners: [k] of corners k and k + 1.
    struct Crease {
        bool same = false, neighbours = false;
        std::array<glm::vec3, 2> edge;
    };
    using Creases = std::array<Crease, 3>;

    [[nodiscard]] Creases creasesOf(const Piece3& piece) const {
        Creases creases;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = piece[k].face, b = piece[(k + 1) % 3].face;
            creases[k].same = a == b;
            creases[k].neighbours =
                a != b && sharedEdge(to_.triangles()[a], to_.triangles()[b], creases[k].edge);
        }
        return creases;
    }

    // The corners' closest points span a flat triangle, and no point of the piece is farther from it than the farthest
    // corner. Where a side of it leads over the crease between two neighbouring faces, bending it to a point of that
    // crease brings it into the faces and moves nothing by more than that. Two of three corners on one face: two sides
    // are bent. Three faces, one of them between the others: the side past it is bent twice.
    [[nodiscard]] float boundOf(const Piece3& piece, const Creases& creases) const {
        const float worst = std::max({piece[0].distance, piece[1].distance, piece[2].distance});
        const int same = int{creases[0].same} + int{creases[1].same} + int{creases[2].same};
        if (same == 3) return worst;
        float bend = kInfinity;
        if (same == 1) {
            const std::size_t k = creases[0].same ? 0 : (creases[1].same ? 1 : 2);  // corners k and k + 1 agree
            const Crease& crease = creases[(k + 1) % 3];
            const glm::vec3& alone = piece[(k + 2) % 3].on;
            if (!crease.neighbours) return kInfinity;
            bend = std::max(bendTo(piece[k].on, alone, crease.edge).by,
                            bendTo(piece[(k + 1) % 3].on, alone, crease.edge).by);
        } else {
            for (std::size_t middle = 0; middle < 3; ++middle) {
                const Crease &in = creases[(middle + 2) % 3], &out = creases[middle];
                if (!in.neighbours || !out.neighbours) continue;
                const glm::vec3 &a = piece[(middle + 2) % 3].on, &b = piece[middle].on, &c = piece[(middle + 1) % 3].on;
                const Bend first = bendTo(a, c, in.edge), second = bendTo(a, c, out.edge);
                if (first.at > second.at) continue;
                bend = std::min(bend, std::max({first.by, second.by, bendTo(a, b, in.edge).by,
                                                bendTo(b, c, out.edge).by}));
            }
        }
        return worst + bend;
    }

    // A corner that lies on a corner or edge of `to` belongs to several faces; to that of another corner, perhaps.
    [[nodiscard]] float boundWithOtherFaces(const Piece3& piece) const {
        float least = kInfinity;
        for (std::size_t k = 0; k < 3 && least > bound_; ++k) {
            if (piece[k].face != piece[(k + 1) % 3].face)
                least = std::min(least, boundOver(piece, piece[k].face, piece[(k + 1) % 3].face));
        }
        return least;
    }

    [[nodiscard]] float boundOver(const Piece3& piece, std::uint32_t a, std::uint32_t b) const {
        Piece3 moved = piece;
        for (Probe& probe : moved) {
            const ClosestPoint atA = to_.closestOn(a, probe.point), atB = to_.closestOn(b, probe.point);
            const ClosestPoint& at = atA.squaredDistance <= atB.squaredDistance ? atA : atB;
            if (at.squaredDistance > bound_ * bound_) return kInfinity;
            probe = probeOn(probe.point, at);
        }
        return boundOf(moved, creasesOf(moved));
    }

    void cover(const Piece3& piece, int depth) {
        const Creases creases = creasesOf(piece);
        float least = boundOf(piece, creases);
        if (least <= bound_) return;
        const float nearest = std::min({piece[0].distance, piece[1].distance, piece[2].distance});
        if (nearest <= kTouching) least = std::min(least, boundWithOtherFaces(piece));
        if (least <= bound_) return;
        const glm::vec3 centre = (piece[0].point + piece[1].point + piece[2].point) * (1.0f / 3.0f);
        // Cut the longest side; at first rather one that leads over more than one crease.
        float farthest = 0.0f, radius = 0.0f, longestSide = -1.0f;
        std::size_t longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float side = glm::distance(piece[k].point, piece[(k + 1) % 3].point);
            const bool far = depth < kFirstCuts && !creases[k].same && !creases[k].neighbours;
            const float weight = far ? kFarSide * side : side;
            if (weight > longestSide) longestSide = weight, longest = k;
            farthest = std::max(farthest, piece[k].distance);
            radius = std::max(radius, glm::distance(piece[k].point, centre));
        }
        least = std::min(least, farthest + radius);  // every point is within `radius` of a corner
        if (least <= bound_) return;
        if (least <= lower_ * kShare + static_cast<float>(kFarthestUnits) || depth >= kDeepest) {
            bound_ = least;
            return;
        }
        const Probe &from = piece[longest], &to = piece[(longest + 1) % 3], &apex = piece[(longest + 2) % 3];
        const Probe middle = probeBetween(from, to);
        cover({from, middle, apex}, depth + 1);
        cover({middle, to, apex}, depth + 1);
    }

    const TriangleTree& to_;
    const MeasuredSurface* from_ = nullptr;
    std::vector<Probe> probes_;  // by point of `from`
    float lower_, bound_;        // what is reached for certain; what is not exceeded so far
    std::uint32_t guess_ = ~std::uint32_t{0};  // a face close to what was looked at last
};

std::vector<TriangleCorners> cornersOf(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles) {
    std::vector<TriangleCorners> corners;
    corners.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) corners.push_back({points[t.x], points[t.y], points[t.z]});
    return corners;
}

}  // namespace

MeasuredSurface::MeasuredSurface(std::vector<glm::vec3> points, std::vector<glm::uvec3> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), tree_(cornersOf(points_, triangles_)) {}

double farthestFrom(const MeasuredSurface& from, const TriangleTree& to, double atLeast) {
    FB_CHECK(!from.triangles().empty());
    FB_CHECK(!to.triangles().empty());
    Farthest farthest(to, atLeast);
    farthest.coverSurface(from);
    return farthest.bound();
}

}  // namespace fb
