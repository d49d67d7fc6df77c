#include "build/cover_texels.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

std::int64_t firstTexel(double low) {
    return static_cast<std::int64_t>(std::floor(low + kTexelTolerance));
}

// One beyond the last; at least one texel is taken.
std::int64_t endTexel(double high, std::int64_t first) {
    return std::max(first + 1, static_cast<std::int64_t>(std::ceil(high - kTexelTolerance)));
}

void visitSpan(std::int64_t first, std::int64_t end, std::int64_t row, int width, int height,
               const TexelSpanVisitor& visit) {
    const auto wrap = [](std::int64_t at, int size) {
        return static_cast<int>(((at % size) + size) % size);
    };
    const int line = wrap(row, height);
    if (end - first >= width) {
        visit(line, 0, width);
        return;
    }
    const int from = wrap(first, width);
    const std::int64_t to = from + (end - first);
    visit(line, from, static_cast<int>(std::min<std::int64_t>(to, width)));
    if (to > width) visit(line, 0, static_cast<int>(to - width));
}

}  // namespace

void coverTexels(const std::array<glm::dvec2, 3>& corners, int width, int height,
                 const TexelSpanVisitor& visit) {
    const glm::dvec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    // Repeats many times: shows all of it.
    if (high.x - low.x > 16.0 * width || high.y - low.y > 16.0 * height) {
        for (int row = 0; row < height; ++row) visit(row, 0, width);
        return;
    }
    const std::int64_t firstRow = firstTexel(low.y);
    const std::int64_t endRow = endTexel(high.y, firstRow);
    for (std::int64_t row = firstRow; row < endRow; ++row) {
        // Extent in x of the part of the triangle between the lines y = row and y = row + 1.
        const double top = static_cast<double>(row), bottom = top + 1.0;
        double left = high.x, right = low.x;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2& a = corners[k];
            const glm::dvec2& b = corners[(k + 1) % 3];
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
            double t0 = 0.0, t1 = 1.0;
            if (a.y != b.y) {
                const double ta = (top - a.y) / (b.y - a.y), tb = (bottom - a.y) / (b.y - a.y);
                t0 = std::max(0.0, std::min(ta, tb));
                t1 = std::min(1.0, std::max(ta, tb));
            }
            for (const double t : {t0, t1}) {
                const double x = a.x + t * (b.x - a.x);
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
        if (left > right) continue;
        const std::int64_t first = firstTexel(left);
        visitSpan(first, endTexel(right, first), row, width, height, visit);
    }
}

}  // namespace fb
