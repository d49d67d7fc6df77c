// Constants of the cost model from timed fronts (calibration; thesis 3.2 and 4.2, algorithms 1). In: times of fronts of
// different size, drawn in rounds so that whatever else the machine does falls on all of them alike. Out: each constant
// with the uncertainty of repeating it.
// What a front adds to another of the same view is the time of triangles: both cover the same pixels, so the time of
// filling them cancels out. Of a front's times the tenth percentile counts: other programs only ever add to them. (Busy
// machine, four runs: v_time 9.0, 6.9, 6.6, 6.2e-4 ms by medians; 6.2, 6.3, 6.0, 6.0e-4 by tenth percentiles.)
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace fb {

// One front: what is in it and the times of drawing it, one a round. Every front has as many rounds.
struct FrontTimes {
    std::uint32_t view = 0;  // fronts of one view are held against each other
    std::uint64_t texturedTriangles = 0, untexturedTriangles = 0;
    double cost = 0.0;            // sum of nodeCost
    double megapixels = 0.0;      // of the view, in front of the roots
    std::vector<double> ms;       // as the scene is drawn
    std::vector<double> plainMs;  // the same triangles without their textures, in turn with `ms`; may be empty
};

// `plusMinus`: half of the interval that holds 95 % of the values from rounds drawn at random (bootstrap).
struct Estimate {
    double value = 0.0, plusMinus = 0.0;
};

// O: time of the front without triangles. None: there is no such front.
[[nodiscard]] std::optional<Estimate> fitOverhead(std::span<const FrontTimes> fronts);
// v_time in ms per unit of cost: slope of the times over cost, with a constant of its own for each view. None:
// no view has fronts of different cost, or time does not rise with it.
[[nodiscard]] std::optional<Estimate> fitVTime(std::span<const FrontTimes> fronts);
// Time of filling a megapixel, from what fronts of a view take beside O and their cost: least squares through 0 over the
// views. None: no v_time or no O can be fitted, no view covers anything, or it is below 0.
[[nodiscard]] std::optional<Estimate> fitFill(std::span<const FrontTimes> fronts);
// c_textured = t / (t + u), t and u the times that one textured and one untextured triangle add. u is the slope of
// plainMs over all triangles, t - u that of ms - plainMs over the textured ones. None: a slope cannot be fitted, or
// one of the two times is not above 0.
[[nodiscard]] std::optional<Estimate> fitCTextured(std::span<const FrontTimes> fronts);

// How much else the machine did: a front's median time over its tenth percentile, and of all fronts the median. 1 on a
// machine that does nothing else. What comes and goes within the rounds is in the uncertainties; what stays is not.
[[nodiscard]] double disturbance(std::span<const FrontTimes> fronts);

}  // namespace fb
