// A convex polygon within a triangle, and cutting it at planes. Goes to farthest_from, which covers triangles
// of one surface with the faces of another.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <span>

#include "base/check.h"

namespace fb {

inline constexpr std::size_t kMostCellCorners = 12;

struct Cell {
    std::size_t count = 0;
    std::array<glm::dvec3, kMostCellCorners> corners;

    Cell() {}  // corners from `count` on stay unset
    void add(const glm::dvec3& p) {
        FB_CHECK(count < kMostCellCorners);
        corners[count++] = p;
    }
    [[nodiscard]] std::span<const glm::dvec3> points() const { return {corners.data(), count}; }
    [[nodiscard]] glm::dvec3 centre() const {
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& p : points()) sum += p;
        return sum / static_cast<double>(count);
    }
};

// How a cell lies to the plane through `origin` that points `inwards`; by less than `margin` beyond it is on
// it.
class Cuts {
  public:
    Cuts(const Cell& cell, const glm::dvec3& origin, const glm::dvec3& inwards, double margin)
        : margin_(margin * glm::length(inwards)) {
        for (std::size_t i = 0; i < cell.count; ++i) {
            distances_[i] = glm::dot(cell.corners[i] - origin, inwards);
            least_ = std::min(least_, distances_[i]);
            most_ = std::max(most_, distances_[i]);
        }
        // Rounding lets a sliver change sides more often than a convex polygon can.
        int crossings = 0;
        for (std::size_t i = 0; i < cell.count; ++i) {
            const double next = distances_[(i + 1) % cell.count];
            crossings += (distances_[i] > 0.0 && next < 0.0) || (distances_[i] < 0.0 && next > 0.0) ? 1 : 0;
        }
        canSplit_ = cell.count < kMostCellCorners && crossings <= 2;
    }

    [[nodiscard]] bool isInside() const { return least_ >= -margin_; }
    // Or cannot be cut: it has too many corners, or is too thin.
    [[nodiscard]] bool isOutside() const { return most_ <= margin_ || !canSplit_; }
    // Where it is neither: both parts, with the corners between them the same.
    void split(const Cell& cell, Cell& inside, Cell& outside) const {
        for (std::size_t i = 0; i < cell.count; ++i) {
            const std::size_t j = (i + 1) % cell.count;
            const double here = distances_[i], next = distances_[j];
            if (here >= 0.0) inside.add(cell.corners[i]);
            if (here <= 0.0) outside.add(cell.corners[i]);
            if ((here > 0.0 && next < 0.0) || (here < 0.0 && next > 0.0)) {
                const glm::dvec3 on = glm::mix(cell.corners[i], cell.corners[j], here / (here - next));
                inside.add(on);
                outside.add(on);
            }
        }
    }

  private:
    std::array<double, kMostCellCorners> distances_;
    double margin_, least_ = 0.0, most_ = 0.0;
    bool canSplit_ = true;
};

}  // namespace fb
