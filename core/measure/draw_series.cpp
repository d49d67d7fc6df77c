#include "measure/draw_series.h"

#include <cmath>

#include "measure/reduce_series.h"

namespace fb {
namespace {

using Items = std::vector<DrawnItem>;
using Points = std::vector<glm::dvec2>;

constexpr double kDotWidth = 7.0, kDashPixels = 6.0, kGapPixels = 4.0;

void addLine(Items& items, Points points, Rgb colour, double width) {
    items.emplace_back(DrawnLine{std::move(points), colour, width});
}

void addRectangle(Items& items, double left, double top, double right, double bottom, Rgb colour) {
    items.emplace_back(DrawnShape{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}, colour});
}

void addDot(Items& items, const glm::dvec2& at, Rgb colour) {
    addLine(items, {at, at}, colour, kDotWidth);
}

void addDashes(Items& items, const Points& points, Rgb colour, double width) {
    double left = kDashPixels;  // of the dash or gap begun
    bool on = true;
    Points dash{points.front()};
    for (std::size_t i = 1; i < points.size(); ++i) {
        glm::dvec2 from = points[i - 1];
        double length = glm::length(points[i] - from);
        while (length > left) {
            from += (points[i] - from) * (left / length);
            length -= left;
            dash.push_back(from);
            if (on) addLine(items, dash, colour, width);
            on = !on;
            left = on ? kDashPixels : kGapPixels;
            dash = {from};
        }
        left -= length;
        dash.push_back(points[i]);
    }
    if (on && dash.size() > 1) addLine(items, dash, colour, width);
}

void addPolyline(Items& items, const Points& points, const PlotSeries& series) {
    if (series.dashed) {
        addDashes(items, points, series.colour, series.width);
    } else {
        addLine(items, points, series.colour, series.width);
    }
}

void addImpulses(Items& items, const Points& points, double zero, const PlotSeries& series) {
    for (const glm::dvec2& p : points) {
        if (std::abs(p.y - zero) > 1e-9) addLine(items, {{p.x, zero}, p}, series.colour, series.width);
    }
}

// A triangle where a value lies beyond the axis, one for each few columns.
void markBeyond(Items& items, const PlotSeries& series, const std::vector<double>& x,
                const std::vector<double>& values, const PlotAxis& y) {
    double lastUp = -1e9, lastDown = -1e9;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = x[i];
        if (y.endsBelow(values[i]) && at - lastUp > 3.0) {
            items.emplace_back(
                DrawnShape{{{at - 4.0, y.to + 7.0}, {at + 4.0, y.to + 7.0}, {at, y.to}}, series.colour});
            lastUp = at;
        }
        if (y.startsAbove(values[i]) && at - lastDown > 3.0) {
            items.emplace_back(DrawnShape{{{at - 4.0, y.from - 7.0}, {at, y.from}, {at + 4.0, y.from - 7.0}},
                                          series.colour});
            lastDown = at;
        }
    }
}

// The upper edge of an area. Sums are not told apart below a pixel: their mean is drawn there.
Points areaEdge(const std::vector<double>& x, const std::vector<double>& values, const PlotAxis& y,
                double columns) {
    Points edge;
    if (static_cast<double>(values.size()) <= 2.0 * columns) {
        for (std::size_t k = 0; k < values.size(); ++k) edge.emplace_back(x[k], y.pixel(values[k]));
    } else {
        forEachColumn(x, [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t k = begin; k < end; ++k) sum += values[k];
            edge.emplace_back(x[begin], y.pixel(sum / static_cast<double>(end - begin)));
        });
    }
    // One frame alone is a bar.
    if (edge.size() == 1) edge = {{edge[0].x - 4.0, edge[0].y}, {edge[0].x + 4.0, edge[0].y}};
    return edge;
}

void addArea(Items& items, const PlotSeries& series, Points edge, double bottom) {
    edge.emplace_back(edge.back().x, bottom);
    edge.emplace_back(edge.front().x, bottom);
    items.emplace_back(DrawnShape{std::move(edge), series.colour});
}

void addPoints(Items& items, const PlotSeries& series, const Points& points, double zero) {
    switch (series.kind) {
        case SeriesKind::impulses:
            addImpulses(items, points, zero, series);
            break;
        case SeriesKind::dots:
            for (const glm::dvec2& p : points) addDot(items, p, series.colour);
            break;
        default:
            if (points.size() == 1) addDot(items, points.front(), series.colour);
            if (points.size() > 1) addPolyline(items, points, series);
    }
}

}  // namespace

void drawSeries(const Figure& figure, const PlotPanel& panel, const PanelData& data, const PlotAxis& x,
                const PlotAxis& y, Items& items) {
    std::vector<std::vector<double>> places;
    for (const PlotSeries& series : panel.series) {
        places.emplace_back();
        for (double v : xOfSeries(figure, series)) places.back().push_back(x.pixel(v));
    }
    // From the highest sum down, each to the bottom: no seams between neighbours.
    for (std::size_t i = panel.series.size(); i-- > 0;) {
        if (panel.series[i].kind != SeriesKind::area || data.values[i].empty()) continue;
        addArea(items, panel.series[i], areaEdge(places[i], data.values[i], y, x.to - x.from), y.pixel(0.0));
    }
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        if (panel.series[i].kind == SeriesKind::area) continue;
        for (const Points& run : reduceLine(places[i], data.values[i])) {
            Points points;
            for (const glm::dvec2& p : run) points.emplace_back(p.x, y.pixel(p.y));
            addPoints(items, panel.series[i], points, y.pixel(0.0));
        }
        markBeyond(items, panel.series[i], places[i], data.values[i], y);
    }
}

double swatchWidth(const PlotSeries& series) {
    switch (series.kind) {
        case SeriesKind::line:
            return 20.0;
        case SeriesKind::dots:
            return kDotWidth;
        case SeriesKind::area:
            return 13.0;
        default:
            return 3.0;
    }
}

void drawSwatch(const PlotSeries& series, double left, double middle, Items& items) {
    const double width = swatchWidth(series);
    switch (series.kind) {
        case SeriesKind::line: {
            PlotSeries sample = series;
            sample.width += 0.6;
            addPolyline(items, {{left, middle}, {left + width, middle}}, sample);
            break;
        }
        case SeriesKind::dots:
            addDot(items, {left + width / 2.0, middle}, series.colour);
            break;
        default:
            addRectangle(items, left, middle - 6.0, left + width, middle + 6.0, series.colour);
    }
}

}  // namespace fb
