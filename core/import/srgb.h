// Linear light in [0, 1] as sRGB (IEC 61966-2-1). For files that store light or linear factors.
#pragma once

#include <cmath>

namespace fb {

[[nodiscard]] inline double encodeSrgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace fb
