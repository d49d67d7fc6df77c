// A figure: panels over one x axis with their data, and its layout into a drawing. Series of any length come
// in (minimum and maximum of each pixel column are kept, so no single-frame spike is lost); axes get ticks at
// 1, 2 or 5 times a power of ten; values that are not finite leave gaps; legends stand above the panels,
// never over data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/drawing.h"

namespace fb {

enum class SeriesKind : std::uint8_t {
    line,
    dots,
    area,     // the areas of a panel are stacked in their order
    impulses  // a thin bar from 0 for each value
};

struct PlotSeries {
    std::string name;  // in the legend, unless empty
    Rgb colour;
    std::vector<double> values;
    SeriesKind kind = SeriesKind::line;
    double width = 1.4;
    bool dashed = false;
    std::vector<double> x;  // rising; empty: the figure's
};

struct PlotPanel {
    std::string yTitle;  // with its unit
    std::vector<PlotSeries> series;
    bool fromZero = true;  // the y axis holds 0
    bool counts = false;   // whole numbers: ticks at whole numbers
    // Ends of the y axis in place of those of the data. Values beyond are drawn at the edge, marked with a
    // triangle, and the legend says how many there are and how far they go.
    std::optional<double> low, high;
    double heightPixels = 280.0;
};

struct Figure {
    std::string title, subtitle, xTitle;
    std::vector<double> x;  // rising
    std::vector<PlotPanel> panels;
    int widthPixels = 1000;
};

[[nodiscard]] Drawing layOut(const Figure& figure);

// Ticks within [low, high], at most `most` + 1 of them.
struct Ticks {
    double step = 1.0;
    std::vector<double> at;
};
[[nodiscard]] Ticks niceTicks(double low, double high, int most, double leastStep = 0.0);
[[nodiscard]] std::string tickLabel(double value, double step);

// At each place the mean of the last `count` values up to it, of fewer at the start; what is not finite is
// left out.
[[nodiscard]] std::vector<double> movingAverage(const std::vector<double>& values, std::size_t count);

// An end for the y axis that a few outliers do not stretch: the maximum, or, where that is more than three
// times the 99th percentile, one and a half of the latter.
[[nodiscard]] double axisEnd(const std::vector<double>& values);

}  // namespace fb
