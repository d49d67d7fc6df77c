// The walk through the procedural city: around one block in the middle, along the centre lines of its
// streets, where nothing is parked.
#include <algorithm>

#include "import/city_plan.h"

namespace fb::city {
namespace {

constexpr double kTurnMetres = 5.0;  // a corner is cut this far before the crossing
constexpr double kStepMetres = 8.0;  // a spline through points this close stays on the street

// The pair of neighbouring streets around the middle block; inner ones where the city has them.
std::pair<std::size_t, std::size_t> middlePair(std::size_t blocks) {
    const std::size_t first = blocks >= 2 ? std::max<std::size_t>(1, (blocks - 1) / 2) : 0;
    return {first, first + 1};
}

void stepTo(std::vector<glm::dvec3>& points, const glm::dvec3& end) {
    const glm::dvec3 start = points.back();
    const double length = glm::length(end - start);
    const int steps = std::max(1, static_cast<int>(length / kStepMetres));
    for (int i = 1; i <= steps; ++i)
        points.push_back(start + (end - start) * (static_cast<double>(i) / steps));
}

}  // namespace

WalkHint planWalk(const CityPlan& plan) {
    const auto [west, east] = middlePair(plan.columns());
    const auto [north, south] = middlePair(plan.rows());
    const auto crossing = [&](std::size_t i, std::size_t j) {
        return glm::dvec3(plan.alongZ[i].centre, 0.0, plan.alongX[j].centre);
    };
    // From the middle of the next block to the south, or within this one where there is none.
    const glm::dvec3 start = south < plan.rows() ? (crossing(west, south) + crossing(west, south + 1)) * 0.5
                                                 : (crossing(west, south) + crossing(west, north)) * 0.5;
    const glm::dvec3 end = west > 0 ? (crossing(west, south) + crossing(west - 1, south)) * 0.5
                                    : (crossing(west, south) + crossing(east, south)) * 0.5;
    const std::array corners{start, crossing(west, north), crossing(east, north), crossing(east, south), end};

    WalkHint walk;
    walk.points.push_back(start);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::dvec3 in = glm::normalize(corners[i] - corners[i - 1]);
        const glm::dvec3 out = glm::normalize(corners[i + 1] - corners[i]);
        const glm::dvec3 from = corners[i] - in * kTurnMetres, to = corners[i] + out * kTurnMetres;
        stepTo(walk.points, from);
        for (int k = 1; k <= 4; ++k) {
            const double t = k / 4.0;
            walk.points.push_back(from * ((1.0 - t) * (1.0 - t)) + corners[i] * (2.0 * t * (1.0 - t)) +
                                  to * (t * t));
        }
    }
    stepTo(walk.points, end);
    return walk;
}

}  // namespace fb::city
