#include "measure/fit_axes.h"

#include <cmath>
#include <limits>

namespace fb {

const std::vector<double>& xOfSeries(const Figure& figure, const PlotSeries& series) {
    return series.x.empty() ? figure.x : series.x;
}

PanelData gatherPanel(const Figure& figure, const PlotPanel& panel) {
    PanelData data;
    std::vector<double> stack;
    for (const PlotSeries& series : panel.series) {
        std::vector<double> values = series.values;
        values.resize(xOfSeries(figure, series).size(), std::numeric_limits<double>::quiet_NaN());
        if (series.kind == SeriesKind::area) {
            stack.resize(values.size(), 0.0);
            for (std::size_t i = 0; i < values.size(); ++i) {
                stack[i] += std::isfinite(values[i]) ? values[i] : 0.0;
                values[i] = stack[i];
            }
        }
        for (double v : values) {
            if (!std::isfinite(v)) continue;
            if (data.empty) data.range = {v, v};
            data.empty = false;
            data.range.add(v);
        }
        data.values.push_back(std::move(values));
    }
    return data;
}

PlotAxis fitYAxis(const PlotPanel& panel, const PanelData& data) {
    AxisRange range = data.empty ? AxisRange{0.0, 1.0} : data.range;
    if (panel.fromZero) range.add(0.0);
    if (panel.low) range.low = *panel.low;
    if (panel.high) range.high = *panel.high;
    if (!(range.high > range.low)) {
        const double pad = range.low == 0.0 ? 1.0 : std::abs(range.low) * 0.1;
        range = {panel.fromZero || panel.low ? range.low : range.low - pad, range.low + pad};
    }
    const int most = std::max(2, static_cast<int>(panel.heightPixels / 38.0));
    const double least = panel.counts ? 1.0 : 0.0;
    const double step = niceTicks(range.low, range.high, most, least).step;
    if (!panel.low) range.low = std::floor(range.low / step + 1e-9) * step;
    if (!panel.high) range.high = std::ceil(range.high / step - 1e-9) * step;
    return {range, 0.0, 1.0, niceTicks(range.low, range.high, most + 1, least)};
}

PlotAxis fitXAxis(const Figure& figure, double from, double to) {
    AxisRange range{0.0, 0.0};
    bool empty = true, dots = false;
    for (const PlotPanel& panel : figure.panels) {
        for (const PlotSeries& series : panel.series) {
            dots = dots || series.kind == SeriesKind::dots;
            for (double v : xOfSeries(figure, series)) {
                if (!std::isfinite(v)) continue;
                if (empty) range = {v, v};
                empty = false;
                range.add(v);
            }
        }
    }
    if (!(range.high > range.low)) range = {range.low - 0.5, range.low + 0.5};
    const double pad = dots ? 0.04 * (range.high - range.low) : 0.0;  // no dot on the frame
    range = {range.low - pad, range.high + pad};
    return {range, from, to,
            niceTicks(range.low, range.high, std::max(2, static_cast<int>((to - from) / 90.0)))};
}

}  // namespace fb
