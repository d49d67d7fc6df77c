// A series as what its pixels need: of the values that fall into one pixel column the first, the minimum, the
// maximum and the last. A single-frame spike among a hundred thousand frames stays visible and in its place.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace fb {

// Calls use(begin, end) for each pixel column that holds points; `columns` is rising.
template <class Use>
void forEachColumn(std::span<const double> xPixels, const Use& use) {
    for (std::size_t begin = 0; begin < xPixels.size();) {
        std::size_t end = begin + 1;
        while (end < xPixels.size() && std::floor(xPixels[end]) == std::floor(xPixels[begin])) ++end;
        use(begin, end);
        begin = end;
    }
}

// Runs of points (x in pixels, value) without gaps.
[[nodiscard]] inline std::vector<std::vector<glm::dvec2>> reduceLine(std::span<const double> xPixels,
                                                                     std::span<const double> values) {
    std::vector<std::vector<glm::dvec2>> runs;
    bool open = false;
    const auto add = [&](std::size_t i) {
        if (!open) runs.emplace_back();
        open = true;
        runs.back().emplace_back(xPixels[i], values[i]);
    };
    forEachColumn(xPixels, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end;) {
            if (!std::isfinite(values[i])) {
                open = false;
                ++i;
                continue;
            }
            std::size_t stop = i, low = i, high = i;
            for (; stop < end && std::isfinite(values[stop]); ++stop) {
                if (values[stop] < values[low]) low = stop;
                if (values[stop] > values[high]) high = stop;
            }
            std::size_t kept[] = {i, std::min(low, high), std::max(low, high), stop - 1};
            for (int k = 0; k < 4; ++k) {
                if (k == 0 || kept[k] > kept[k - 1]) add(kept[k]);
            }
            i = stop;
        }
    });
    return runs;
}

}  // namespace fb
