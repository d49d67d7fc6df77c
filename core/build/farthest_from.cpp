#include "build/farthest_from.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "build/convex_cell.h"
#include "build/highest_of_least.h"

namespace fb {
namespace {

// After so many halvings a part is 256 times smaller, and what it adds at most is taken for what it adds: work is
// bounded.
constexpr int kDeepest = 16;
constexpr float kEnough = 0.5f;  // of the bound: a face as close as this need not be the closest
constexpr auto kShare = static_cast<float>(1.0 + kFarthestRelative);
// Over the faces under one triangle: from one end to the other, and in all. What is left then is halved.
constexpr int kFarthestWalk = 48, kMostSteps = 400;
constexpr double kSteep = 1e-3;   // a face so close to upright, seen along the normal, has nothing above it
constexpr double kOnEdge = 0.25;  // grid units: beyond an edge by less is still over the face

// A point of `from`, and how far a close face of `to` lies.
struct Probe {
    glm::vec3 point{0.0f};
    std::uint32_t face = 0;
    float distance = 0.0f;
};
using Piece3 = std::array<Probe, 3>;

std::array<glm::dvec3, 8> cornersOf(const Box3f& box) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                      (i & 4) != 0 ? box.max.z : box.min.z};
    }
    return corners;
}

class Farthest {
  public:
    Farthest(const MeasuredSurface& from, const MeasuredSurface& to, double atLeast)
        : from_(from),
          to_(to),
          lower_(static_cast<float>(atLeast) / kShare),
          bound_(static_cast<float>(atLeast)) {}

    double measure() {
        probeAll();
        coverNode(0);
        return static_cast<double>(bound_);
    }

  private:
    static constexpr std::uint32_t kNone = MeasuredSurface::kNoTriangle;
    static constexpr auto kAny = [](std::uint32_t) { return true; };

    void reach(float distance) {
        lower_ = std::max(lower_, distance);
        bound_ = std::max(bound_, distance);
    }
    Probe probeAt(const glm::vec3& p, std::uint32_t near) {
        const ClosestPoint at = to_.tree().closest(p, to_.tree().closestOn(near, p), -1.0f, kAny);
        guess_ = at.triangle;
        const float distance = std::sqrt(at.squaredDistance);
        reach(distance);
        return {p, at.triangle, distance};
    }
    // Halfway; a face of the two will do where it is well within the bound.
    Probe probeBetween(const Probe& a, const Probe& b) {
        const glm::vec3 middle = 0.5f * (a.point + b.point);
        ClosestPoint at = to_.tree().closestOn(a.face, middle);
        if (b.face != a.face) {
            const ClosestPoint other = to_.tree().closestOn(b.face, middle);
            if (other.squaredDistance < at.squaredDistance) at = other;
        }
        const float enough = kEnough * bound_;
        if (at.squaredDistance > enough * enough) return probeAt(middle, at.triangle);
        return {middle, at.triangle, std::sqrt(at.squaredDistance)};
    }

    // Raises what is reached for certain before anything is refined: searches end at the first triangle not
    // farther.
    void probeAll() {
        near_.reserve(from_.points().size());
        for (const glm::vec3& p : from_.points()) {
            const ClosestPoint start = to_.tree().closestOn(guess_, p);
            if (start.squaredDistance > lower_ * lower_) {
                const ClosestPoint near = to_.tree().closest(p, start, lower_ * lower_, kAny);
                guess_ = near.triangle;
                reach(std::sqrt(near.squaredDistance));
            }
            near_.push_back(guess_);
        }
        bound_ = std::max(bound_, lower_ * kShare);
    }

    // The distance to a face is convex: what holds for all corners holds for all between.
    template <class Points>
    [[nodiscard]] bool areNear(const Points& points, std::uint32_t face) const {
        return std::ranges::all_of(points, [&](const glm::dvec3& p) {
            return to_.tree().closestOn(face, p).squaredDistance <= bound_ * bound_;
        });
    }

    void coverNode(std::uint32_t index) {
        const TriangleTree& from = from_.tree();
        const TriangleTree::Node& node = from.nodes()[index];
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                coverTriangle(from.order()[i]);
            return;
        }
        if (areNear(cornersOf(node.box), guess_)) return;
        coverNode(index + 1);
        coverNode(node.first);
    }

    void coverTriangle(std::uint32_t triangle) {
        const TriangleCorners& corners = from_.tree().triangles()[triangle];
        if (areNear(corners, guess_)) return;
        guess_ = near_[from_.triangles()[triangle].x];
        Cell cell;
        for (const glm::vec3& p : corners) cell.add(p);
        along_ = glm::cross(cell.corners[1] - cell.corners[0], cell.corners[2] - cell.corners[0]);
        steps_ = 0;
        walk(cell, guess_, kNone, 0);
    }

    // Covers the part of the cell that lies over `face`, seen along the normal of the triangle that it is
    // part of, and steps to the neighbours with the rest.
    void walk(const Cell& cell, std::uint32_t face, std::uint32_t before, int depth) {
        if (areNear(cell.points(), face)) return;
        if (depth == kFarthestWalk || ++steps_ > kMostSteps) return coverFan(cell, face);
        const TriangleCorners& corners = to_.tree().triangles()[face];
        const std::array<glm::dvec3, 3> p = {corners[0], corners[1], corners[2]};
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double facing = glm::dot(along_, normal);
        if (std::abs(facing) <= kSteep * std::sqrt(glm::dot(along_, along_) * glm::dot(normal, normal)))
            return leap(cell, face, before, depth);
        const glm::dvec3 side = facing < 0.0 ? -along_ : along_;
        std::array<Cell, 3> insides;
        const Cell* rest = &cell;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 &a = p[static_cast<std::size_t>(k)],
                             &b = p[static_cast<std::size_t>((k + 1) % 3)];
            const Cuts cuts(*rest, a, glm::cross(side, b - a), kOnEdge);
            if (cuts.isInside()) continue;
            const std::uint32_t next = to_.neighbour(face, k);
            const auto step = [&](const Cell& outside) {
                if (next == kNone || next == before)
                    leap(outside, face, before, depth);
                else
                    walk(outside, next, face, depth + 1);
            };
            if (cuts.isOutside()) return step(*rest);
            Cell outside;
            Cell& inside = insides[static_cast<std::size_t>(k)];
            cuts.split(*rest, inside, outside);
            step(outside);
            rest = &inside;
        }
        if (rest == &cell || !areNear(rest->points(), face)) leap(*rest, face, before, depth);
    }

    // To the face that is closest to the middle of the cell, where no neighbour leads on.
    void leap(const Cell& cell, std::uint32_t face, std::uint32_t before, int depth) {
        const Probe middle = probeAt(cell.centre(), face);
        if (middle.face == face || middle.face == before) return coverFan(cell, face);
        walk(cell, middle.face, kNone, depth + 1);
    }

    void coverFan(const Cell& cell, std::uint32_t face) {
        const Probe apex = probeAt(cell.corners[0], face);
        Probe last = probeAt(cell.corners[1], apex.face);
        for (std::size_t i = 2; i < cell.count; ++i) {
            const Probe next = probeAt(cell.corners[i], last.face);
            cover({apex, last, next}, 0);
            last = next;
        }
    }

    // The distance to each face is convex: over the piece it is nowhere above the plane through its values at
    // the corners.
    [[nodiscard]] float boundBetween(const Piece3& piece) const {
        std::array<glm::vec3, 3> d;  // by face: at the corners
        for (std::size_t f = 0; f < 3; ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                d[f][static_cast<int>(k)] =
                    f == k ? piece[k].distance
                           : std::sqrt(to_.tree().closestOn(piece[f].face, piece[k].point).squaredDistance);
            }
        }
        return highestOfLeast(d);
    }

    void cover(const Piece3& piece, int depth) {
        float least = boundBetween(piece);
        if (least <= bound_) return;
        const glm::vec3 centre = (piece[0].point + piece[1].point + piece[2].point) * (1.0f / 3.0f);
        float farthest = 0.0f, radius = 0.0f, longestSide = -1.0f;
        std::size_t longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float side = glm::distance(piece[k].point, piece[(k + 1) % 3].point);
            if (side > longestSide) longestSide = side, longest = k;
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

    const MeasuredSurface &from_, &to_;
    std::vector<std::uint32_t> near_;  // by point of `from_`: a face close to it
    float lower_, bound_;              // what is reached for certain; what is not exceeded so far
    std::uint32_t guess_ = 0;          // a face close to what was looked at last
    glm::dvec3 along_{0.0};            // the normal of the triangle that is being covered
    int steps_ = 0;                    // in covering it
};

}  // namespace

double farthestFrom(const MeasuredSurface& from, const MeasuredSurface& to, double atLeast) {
    FB_CHECK(!from.triangles().empty());
    FB_CHECK(!to.triangles().empty());
    return Farthest(from, to, atLeast).measure();
}

}  // namespace fb
