// Which texels a triangle of a chart covers. Used by grow_charts, which keeps the triangles of a chart apart, and by
// bake_charts, which colours them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace fb {

using Corners2 = std::array<glm::vec2, 3>;

// How deep inside a triangle a point lies, in texels (negative outside: distance to the worst edge's line).
inline float insideness(const Corners2& t, const glm::vec2& p) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 a = t[k], along = t[(k + 1) % 3] - a;
        const float length = glm::length(along);
        if (length > 0.0f) least = std::min(least, (along.x * (p.y - a.y) - along.y * (p.x - a.x)) / length);
    }
    return least;
}

// Calls visit(x, y, inside) for the texels whose centres lie in the triangle or up to `margin` outside.
template <class Visit>
void visitTexels(const Corners2& t, float margin, Visit&& visit) {
    const float low = std::min(t[0].y, std::min(t[1].y, t[2].y)),
                high = std::max(t[0].y, std::max(t[1].y, t[2].y));
    for (int y = static_cast<int>(std::floor(low - margin)); y < static_cast<int>(std::ceil(high + margin));
         ++y) {
        const float centre = static_cast<float>(y) + 0.5f;
        const float top = centre - margin, bottom = centre + margin;
        float left = std::numeric_limits<float>::max(), right = std::numeric_limits<float>::lowest();
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 a = t[k], b = t[(k + 1) % 3];
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
            const float rise = b.y - a.y;
            const float t0 = rise == 0.0f ? 0.0f : glm::clamp((top - a.y) / rise, 0.0f, 1.0f);
            const float t1 = rise == 0.0f ? 1.0f : glm::clamp((bottom - a.y) / rise, 0.0f, 1.0f);
            for (const float at : {t0, t1}) {
                left = std::min(left, a.x + at * (b.x - a.x));
                right = std::max(right, a.x + at * (b.x - a.x));
            }
        }
        if (left > right) continue;
        for (int x = static_cast<int>(std::floor(left - margin));
             x < static_cast<int>(std::ceil(right + margin)); ++x) {
            const float inside = insideness(t, {static_cast<float>(x) + 0.5f, centre});
            if (inside >= -margin) visit(x, y, inside);
        }
    }
}

}  // namespace fb
