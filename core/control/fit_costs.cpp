#include "control/fit_costs.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/random.h"

namespace fb {
namespace {

constexpr int kResamples = 400;
constexpr std::uint64_t kSeed = 2004;

using Rounds = std::vector<std::uint32_t>;  // which rounds count; one may stand there several times
using Fit = std::function<double(const Rounds&)>;  // not finite where it cannot be made

struct Point {
    std::uint32_t view;
    double x, y;
};

// The value below which `part` of them lie, between the two next to it.
double quantile(std::vector<double> values, double part) {
    std::ranges::sort(values);
    const double place = part * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

double quickest(const std::vector<double>& times, const Rounds& rounds) {
    std::vector<double> chosen;
    chosen.reserve(rounds.size());
    for (std::uint32_t round : rounds) chosen.push_back(times[round]);
    return quantile(std::move(chosen), 0.1);
}

// Least squares with one slope for all views and a constant for each.
double slopeWithinViews(const std::vector<Point>& points) {
    double xy = 0.0, xx = 0.0;
    for (const Point& p : points) {
        double x = 0.0, y = 0.0, count = 0.0;
        for (const Point& q : points) {
            if (q.view != p.view) continue;
            x += q.x;
            y += q.y;
            ++count;
        }
        xy += (p.x - x / count) * (p.y - y / count);
        xx += (p.x - x / count) * (p.x - x / count);
    }
    return xx > 0.0 ? xy / xx : std::nan("");
}

bool drawsSomething(const FrontTimes& front) { return front.texturedTriangles + front.untexturedTriangles > 0; }

template <class X, class Y>
double slope(std::span<const FrontTimes> fronts, const X& x, const Y& y) {
    std::vector<Point> points;
    for (const FrontTimes& front : fronts) {
        if (drawsSomething(front)) points.push_back({front.view, x(front), y(front)});
    }
    return slopeWithinViews(points);
}

std::optional<Estimate> estimate(std::size_t roundCount, const Fit& fit) {
    if (roundCount == 0) return std::nullopt;
    Rounds rounds(roundCount);
    for (std::size_t i = 0; i < roundCount; ++i) rounds[i] = static_cast<std::uint32_t>(i);
    const double value = fit(rounds);
    if (!std::isfinite(value)) return std::nullopt;
    Random random(kSeed);
    std::vector<double> resampled;
    for (int i = 0; i < kResamples; ++i) {
        for (std::uint32_t& round : rounds) round = static_cast<std::uint32_t>(random.index(roundCount));
        if (const double again = fit(rounds); std::isfinite(again)) resampled.push_back(again);
    }
    if (resampled.empty()) return std::nullopt;
    std::ranges::sort(resampled);
    const std::size_t outside = resampled.size() / 40;  // 2.5 % on either side
    return Estimate{value, 0.5 * (resampled[resampled.size() - 1 - outside] - resampled[outside])};
}

double fittedCTextured(std::span<const FrontTimes> fronts, const Rounds& rounds) {
    const double untextured = slope(
        fronts, [](const FrontTimes& f) { return static_cast<double>(f.texturedTriangles + f.untexturedTriangles); },
        [&](const FrontTimes& f) { return quickest(f.plainMs, rounds); });
    const double more = slope(
        fronts, [](const FrontTimes& f) { return static_cast<double>(f.texturedTriangles); },
        [&](const FrontTimes& f) { return quickest(f.ms, rounds) - quickest(f.plainMs, rounds); });
    const double textured = untextured + more;
    return untextured > 0.0 && textured > 0.0 ? textured / (textured + untextured) : std::nan("");
}

double vTimeOf(std::span<const FrontTimes> fronts, const Rounds& rounds) {
    const double ms = slope(
        fronts, [](const FrontTimes& f) { return f.cost; },
        [&](const FrontTimes& f) { return quickest(f.ms, rounds); });
    return ms > 0.0 ? ms : std::nan("");
}

}  // namespace

std::optional<Estimate> fitOverhead(std::span<const FrontTimes> fronts) {
    const auto empty = std::ranges::find_if(fronts, [](const FrontTimes& f) { return !drawsSomething(f); });
    if (empty == fronts.end()) return std::nullopt;
    return estimate(empty->ms.size(), [&](const Rounds& rounds) { return quickest(empty->ms, rounds); });
}

std::optional<Estimate> fitVTime(std::span<const FrontTimes> fronts) {
    if (fronts.empty()) return std::nullopt;
    return estimate(fronts[0].ms.size(), [&](const Rounds& rounds) { return vTimeOf(fronts, rounds); });
}

std::optional<Estimate> fitFill(std::span<const FrontTimes> fronts) {
    const auto empty = std::ranges::find_if(fronts, [](const FrontTimes& f) { return !drawsSomething(f); });
    if (empty == fronts.end()) return std::nullopt;
    return estimate(empty->ms.size(), [&](const Rounds& rounds) {
        const double overheadMs = quickest(empty->ms, rounds);
        const double vTimeMs = vTimeOf(fronts, rounds);
        double xy = 0.0, xx = 0.0;
        for (const FrontTimes& front : fronts) {
            if (!drawsSomething(front)) continue;
            xy += front.megapixels * (quickest(front.ms, rounds) - overheadMs - vTimeMs * front.cost);
            xx += front.megapixels * front.megapixels;
        }
        return xx > 0.0 && xy >= 0.0 ? xy / xx : std::nan("");
    });
}

std::optional<Estimate> fitCTextured(std::span<const FrontTimes> fronts) {
    if (fronts.empty() || fronts[0].plainMs.empty()) return std::nullopt;
    return estimate(fronts[0].ms.size(), [&](const Rounds& rounds) { return fittedCTextured(fronts, rounds); });
}

double disturbance(std::span<const FrontTimes> fronts) {
    std::vector<double> ratios;
    for (const FrontTimes& front : fronts) {
        if (!front.ms.empty()) ratios.push_back(quantile(front.ms, 0.5) / std::max(quantile(front.ms, 0.1), 1e-9));
    }
    return ratios.empty() ? 1.0 : quantile(std::move(ratios), 0.5);
}

}  // namespace fb
