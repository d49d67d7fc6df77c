#include "load/bytes_per_cost.h"

#include <algorithm>

#include "base/check.h"

namespace fb {

BytesPerCost bytesPerCost(const Hierarchy& hierarchy, double cTextured) {
    FB_CHECK(hierarchy.size() > 0u);
    std::vector<double> ratios;
    ratios.reserve(hierarchy.size());
    double bytes = 0.0, cost = 0.0;
    for (NodeId n = 0; n < hierarchy.size(); ++n) {
        const double nodesCost = nodeCost(hierarchy, n, cTextured);
        ratios.push_back(hierarchy.residentBytes[n] / nodesCost);
        bytes += hierarchy.residentBytes[n];
        cost += nodesCost;
    }
    std::ranges::sort(ratios);
    // Nearest rank in whole numbers: 0.95 * 20 need not be 19 in floating point.
    const auto percentile = [&](std::size_t percent) { return ratios[(percent * ratios.size() + 99) / 100 - 1]; };
    return {bytes / cost, percentile(5), percentile(95)};
}

}  // namespace fb
