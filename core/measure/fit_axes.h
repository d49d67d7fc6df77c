// The axes of a figure: a panel's data as drawn, the ends and ticks that fit it. Comes from figure.h; goes to
// the drawing of series and to the layout.
#pragma once

#include <algorithm>
#include <vector>

#include "measure/figure.h"

namespace fb {

struct AxisRange {
    double low = 0.0, high = 1.0;

    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

struct PlotAxis {
    AxisRange range;
    double from = 0.0, to = 1.0;  // pixels of range.low and range.high
    Ticks ticks;

    // Values beyond are at the edge.
    [[nodiscard]] double pixel(double v) const {
        return from +
               (std::clamp(v, range.low, range.high) - range.low) / (range.high - range.low) * (to - from);
    }
    // Whether the axis does not reach to the value; sums of parts may be off by a rounding error.
    [[nodiscard]] bool endsBelow(double v) const { return v > range.high + 1e-9 * (range.high - range.low); }
    [[nodiscard]] bool startsAbove(double v) const { return v < range.low - 1e-9 * (range.high - range.low); }
};

// The values as drawn, as many as there are places on the x axis: areas as the sums of those below and
// themselves.
struct PanelData {
    std::vector<std::vector<double>> values;  // by series
    AxisRange range{0.0, 0.0};
    bool empty = true;  // nothing finite
};

[[nodiscard]] const std::vector<double>& xOfSeries(const Figure& figure, const PlotSeries& series);
[[nodiscard]] PanelData gatherPanel(const Figure& figure, const PlotPanel& panel);

// From tick to tick around the data, or to the panel's own ends; `from` and `to` are left to the layout.
[[nodiscard]] PlotAxis fitYAxis(const PlotPanel& panel, const PanelData& data);
// From the first to the last place of all panels.
[[nodiscard]] PlotAxis fitXAxis(const Figure& figure, double from, double to);

}  // namespace fb
