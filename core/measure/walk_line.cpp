#include "measure/walk_line.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "measure/sin_cos_turns.h"

namespace fb {
namespace {

double distanceBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::sqrt(glm::dot(b - a, b - a));
}

double lengthOf(const std::vector<glm::dvec3>& points) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distanceBetween(points[i - 1], points[i]);
    return sum;
}

// Points closer than a millionth of the way are one: they would make legs without a direction.
std::vector<glm::dvec3> distinctPoints(const std::vector<glm::dvec3>& points, double lengthMetres) {
    std::vector<glm::dvec3> kept;
    for (const glm::dvec3& p : points) {
        if (kept.empty() || distanceBetween(kept.back(), p) > 1e-6 * lengthMetres) kept.push_back(p);
    }
    return kept;
}

}  // namespace

bool isWalkable(const std::vector<glm::dvec3>& points, double minimumMetres) {
    const double length = lengthOf(points);
    return std::isfinite(length) && length >= minimumMetres;
}

WalkLine::WalkLine(const std::vector<glm::dvec3>& points, const GroundAxes& axes, double reachMetres,
                   double roundingMetres, double turningMetres)
    : lengthMetres_(lengthOf(points)),
      roundingMetres_(std::min(roundingMetres, lengthMetres_ / 2.0)),
      turningMetres_(std::min(turningMetres, lengthMetres_ / 2.0)) {
    std::vector<glm::dvec3> line = distinctPoints(points, lengthMetres_);
    FB_CHECK(line.size() >= 2u);
    const bool closed = line.size() > 3 && distanceBetween(line.front(), line.back()) < 1e-3 * lengthMetres_;
    if (closed) line.back() = line.front();

    double walked = 0.0;
    const double end = reachMetres + std::max(roundingMetres_, turningMetres_);
    while (walked < end) {
        for (std::size_t i = 1; i < line.size() && walked < end; ++i) {
            const glm::dvec3 way = line[i] - line[i - 1];
            const glm::dvec2 level(glm::dot(way, axes.along), glm::dot(way, axes.across));
            const double before = legs_.empty() ? 0.0 : legs_.back().headingTurns;
            double heading = before;  // straight up or down: as before
            if (glm::dot(level, level) > 1e-12 * glm::dot(way, way)) {
                heading = turnsOf(level);
                // The short way round; a way exactly back turns one way, not to and fro.
                if (!legs_.empty()) heading += std::floor(before - heading + 0.5);
            }
            const double metres = distanceBetween(line[i - 1], line[i]);
            legs_.push_back({line[i - 1], line[i], walked, walked + metres, heading});
            walked += metres;
        }
        if (!closed) std::reverse(line.begin(), line.end());
    }
}

// The exact mean over [s - window/2, s + window/2] of a value that is linear along each leg. The first leg
// goes on straight before the start, so that the mean at 0 is the start itself.
template <class T, class Value>
T WalkLine::meanAround(double s, double windowMetres, T sum, const Value& valueOf) const {
    const double low = s - windowMetres / 2.0, high = s + windowMetres / 2.0;
    auto leg = std::upper_bound(legs_.begin(), legs_.end(), low,
                                [](double metres, const Leg& l) { return metres < l.endMetres; });
    for (; leg != legs_.end() && leg->startMetres < high; ++leg) {
        const double from = leg == legs_.begin() ? low : std::max(low, leg->startMetres);
        const double to = std::min(high, leg->endMetres);
        sum += valueOf(*leg, (from + to) / 2.0) * ((to - from) / windowMetres);
    }
    return sum;
}

glm::dvec3 WalkLine::placeAt(double s) const {
    return meanAround(s, roundingMetres_, glm::dvec3(0.0), [](const Leg& leg, double metres) {
        return leg.start +
               (leg.end - leg.start) * ((metres - leg.startMetres) / (leg.endMetres - leg.startMetres));
    });
}

double WalkLine::headingAt(double s) const {
    return meanAround(s, turningMetres_, 0.0, [](const Leg& leg, double) { return leg.headingTurns; });
}

}  // namespace fb
