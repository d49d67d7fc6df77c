#include <algorithm>
#include <cmath>

#include "measure/report.h"

namespace fb {
namespace {

constexpr double kDeviationOfMedian = 1.4826;  // sd of normal values over their median distance from the median

}  // namespace

Distribution describe(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    Distribution result;
    if (values.empty()) return result;
    std::ranges::sort(values);

    const double count = static_cast<double>(values.size());
    double sum = 0.0;
    for (double v : values) sum += v;
    result.mean = sum / count;
    double squares = 0.0;
    for (double v : values) squares += (v - result.mean) * (v - result.mean);
    result.sd = std::sqrt(squares / count);

    // Whole numbers: 0.95 * 20 need not be 19 in floating point.
    const auto percentile = [&](std::size_t percent) {
        return values[(percent * values.size() + 99) / 100 - 1];
    };
    result.p50 = percentile(50);
    result.p95 = percentile(95);
    result.p99 = percentile(99);
    result.max = values.back();
    for (double& v : values) v = std::abs(v - result.p50);
    std::ranges::sort(values);
    result.robustSd = kDeviationOfMedian * percentile(50);
    return result;
}

}  // namespace fb
