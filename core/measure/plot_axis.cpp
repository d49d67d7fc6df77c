// Numbers for axes: ticks, their labels, moving averages, ends.
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/figure.h"
#include "measure/number_text.h"
#include "measure/report.h"

namespace fb {

Ticks niceTicks(double low, double high, int most, double leastStep) {
    Ticks ticks;
    const double range = high - low;
    if (!(range > 0.0) || !std::isfinite(range) || most < 1) return ticks;
    const double power = std::pow(10.0, std::floor(std::log10(std::max(range / most, leastStep)) + 1e-9));
    for (double factor : {1.0, 2.0, 5.0, 10.0}) {
        ticks.step = factor * power;
        if (range / ticks.step <= most + 1e-9 && ticks.step >= leastStep) break;
    }
    const double first = std::ceil(low / ticks.step - 1e-9), last = std::floor(high / ticks.step + 1e-9);
    for (double k = first; k <= last; ++k) ticks.at.push_back(k * ticks.step + 0.0);  // no -0
    return ticks;
}

std::string tickLabel(double value, double step) {
    const double size = std::max(std::abs(value), step);
    std::string text;
    if (step >= 1e-4 && size < 1e7) {
        const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
        return fixedText(value, decimals);
    }
    // As many digits as tell one step from the next.
    const double digits = std::floor(std::log10(size)) - std::floor(std::log10(step) + 1e-9);
    return exponentText(value, static_cast<int>(std::clamp(digits, 0.0, 15.0)));
}

std::vector<double> movingAverage(const std::vector<double>& values, std::size_t count) {
    std::vector<double> means;
    means.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        double sum = 0.0;
        int finite = 0;
        for (std::size_t k = i + 1 - std::min(count, i + 1); k <= i; ++k) {
            if (!std::isfinite(values[k])) continue;
            sum += values[k];
            ++finite;
        }
        means.push_back(finite > 0 ? sum / finite : std::numeric_limits<double>::quiet_NaN());
    }
    return means;
}

double axisEnd(const std::vector<double>& values) {
    const Distribution d = describe(values);
    return d.p99 > 0.0 && d.max > 3.0 * d.p99 ? 1.5 * d.p99 : d.max;
}

}  // namespace fb
