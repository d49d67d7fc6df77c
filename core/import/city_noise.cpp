#include "import/city_noise.h"

#include <cmath>

#include "base/check.h"

namespace fb::city {
namespace {

double smoothStep(double t) {
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

double smoothNoise(std::uint32_t seed, double x, double y, double period) {
    const double fx = std::floor(x / period), fy = std::floor(y / period);
    const auto ix = static_cast<std::int32_t>(fx), iy = static_cast<std::int32_t>(fy);
    const double wx = smoothStep(x / period - fx), wy = smoothStep(y / period - fy);
    const double a = signedUnit(latticeHash(seed, ix, iy)), b = signedUnit(latticeHash(seed, ix + 1, iy));
    const double c = signedUnit(latticeHash(seed, ix, iy + 1));
    const double d = signedUnit(latticeHash(seed, ix + 1, iy + 1));
    const double low = a + (b - a) * wx, high = c + (d - c) * wx;
    return low + (high - low) * wy;
}

NoiseOctave::NoiseOctave(std::span<const float> columns, double period, std::uint32_t seed)
    : period_(period), seed_(seed) {
    cell_.reserve(columns.size());
    weight_.reserve(columns.size());
    if (columns.empty()) return;
    std::int32_t last = firstX_ = static_cast<std::int32_t>(std::floor(columns.front() / period));
    for (const float column : columns) {
        const double at = column / period;
        const double cell = std::floor(at);
        const auto x = static_cast<std::int32_t>(cell);
        FB_CHECK(x >= firstX_);
        last = x > last ? x : last;
        cell_.push_back(static_cast<std::uint32_t>(x - firstX_));
        weight_.push_back(static_cast<float>(smoothStep(at - cell)));
    }
    const auto count = static_cast<std::size_t>(last - firstX_) + 2;
    lower_.resize(count);
    upper_.resize(count);
    line_.resize(count);
}

void NoiseOctave::hashRow(std::int32_t latticeY, std::vector<float>& values) const {
    std::int32_t x = firstX_;
    for (float& value : values) value = signedUnit(latticeHash(seed_, x++, latticeY));
}

void NoiseOctave::addRow(double y, float amplitude, std::span<float> out) {
    FB_CHECK(out.size() == cell_.size());
    const double at = y / period_;
    const double cell = std::floor(at);
    const auto rowY = static_cast<std::int32_t>(cell);
    if (!filled_ || rowY != lowerY_) {
        if (filled_ && rowY == lowerY_ + 1) {
            lower_.swap(upper_);
            hashRow(rowY + 1, upper_);
        } else if (filled_ && rowY == lowerY_ - 1) {
            upper_.swap(lower_);
            hashRow(rowY, lower_);
        } else {
            hashRow(rowY, lower_);
            hashRow(rowY + 1, upper_);
        }
        lowerY_ = rowY;
        filled_ = true;
    }
    const auto w = static_cast<float>(smoothStep(at - cell));
    for (std::size_t i = 0; i < line_.size(); ++i)
        line_[i] = amplitude * (lower_[i] + (upper_[i] - lower_[i]) * w);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float a = line_[cell_[i]], b = line_[cell_[i] + 1];
        out[i] += a + (b - a) * weight_[i];
    }
}

}  // namespace fb::city
