// The median of the last few measurements: a stall of fewer than half as many frames passes by without a trace (algorithms 5,
// case 9).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace fb {

struct MedianGate {
    static constexpr std::size_t kMost = 15;
    std::array<double, kMost> recent{};
    std::uint64_t count = 0;

    // Takes in a measurement and gives the median of the last `frames` (odd, at most kMost); the measurement itself while
    // there are not as many yet.
    double pass(double value, std::size_t frames) {
        recent[count % kMost] = value;
        ++count;
        if (count < frames) return value;
        std::array<double, kMost> last{};
        for (std::size_t i = 0; i < frames; ++i) last[i] = recent[(count - 1 - i) % kMost];
        const auto middle = last.begin() + static_cast<std::ptrdiff_t>(frames / 2);
        std::nth_element(last.begin(), middle, last.begin() + static_cast<std::ptrdiff_t>(frames));
        return *middle;
    }
    void scale(double factor) {
        for (double& value : recent) value *= factor;
    }
};

}  // namespace fb
