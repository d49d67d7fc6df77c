// Axis-aligned boxes in metres. An empty box has min > max; growing it by a point makes it that point.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace fb {

template <class T>
struct Box3 {
    using Vec = glm::vec<3, T>;
    Vec min{std::numeric_limits<T>::max()};
    Vec max{std::numeric_limits<T>::lowest()};

    [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    [[nodiscard]] Vec size() const { return empty() ? Vec(T(0)) : max - min; }
    [[nodiscard]] Vec centre() const { return (min + max) * T(0.5); }
    [[nodiscard]] T diagonal() const { return glm::length(size()); }
    [[nodiscard]] bool contains(const Vec& p) const {
        return glm::all(glm::greaterThanEqual(p, min)) && glm::all(glm::lessThanEqual(p, max));
    }
    [[nodiscard]] bool contains(const Box3& b) const { return b.empty() || (contains(b.min) && contains(b.max)); }
    void grow(const Vec& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void grow(const Box3& b) {
        if (b.empty()) return;
        grow(b.min);
        grow(b.max);
    }
    // 0 inside the box.
    [[nodiscard]] T distance(const Vec& p) const {
        return glm::length(glm::max(glm::max(min - p, p - max), Vec(T(0))));
    }
    // Index of the longest axis, the first one of equals.
    [[nodiscard]] int longestAxis() const {
        const Vec s = size();
        if (s.x >= s.y && s.x >= s.z) return 0;
        return s.y >= s.z ? 1 : 2;
    }
};

using Box3f = Box3<float>;
using Box3d = Box3<double>;

}  // namespace fb
