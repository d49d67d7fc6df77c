#include "measure/replay_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/number_text.h"

namespace fb {
namespace {

constexpr std::size_t kAverageFrames = 35;  // the moving averages of thesis figures 6.4 and 6.6
constexpr double kMebibyte = 1024.0 * 1024.0;

template <class Value>
std::vector<double> collect(const ReplayReport& report, const Value& value) {
    std::vector<double> values;
    values.reserve(report.frames.size());
    for (const FrameRecord& frame : report.frames) values.push_back(static_cast<double>(value(frame)));
    return values;
}

Figure figureOf(const ReplayReport& report, std::string title) {
    Figure figure;
    figure.title = std::move(title);
    figure.subtitle = report.scene + ": policy " + report.policy + ", preset " + report.preset + ", path " +
                      report.path + ", clock " + report.clock;
    figure.xTitle = "time (s)";
    figure.x = collect(report, [](const FrameRecord& f) { return f.timeSeconds; });
    return figure;
}

std::string noted(const std::string& name, const Distribution& d, int decimals, const std::string& unit) {
    return name + " (p50 " + fixedText(d.p50, decimals) + ", p95 " + fixedText(d.p95, decimals) + ", p99 " +
           fixedText(d.p99, decimals) + unit + ")";
}

NamedFigure timeFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Frame time against the target");
    const std::vector<double> actual = collect(report, [](const FrameRecord& f) { return f.actualMs; });
    const std::vector<double> estimate = collect(report, [](const FrameRecord& f) { return f.estimateMs; });
    const std::vector<double> target = collect(report, [](const FrameRecord& f) { return f.targetMs; });
    PlotPanel panel;
    panel.yTitle = "frame time (ms)";
    panel.series = {
        {"estimate", kOrange, estimate, SeriesKind::line, 1.2, false, {}},
        {noted("actual", describe(actual), 1, " ms"), kBlue, actual, SeriesKind::line, 1.4, false, {}},
        {"target", kInk, target, SeriesKind::line, 1.6, true, {}}};
    const double end = std::max({axisEnd(actual), axisEnd(estimate), 1.15 * describe(target).max});
    if (end > 0.0 && describe(actual).max > end) panel.high = end;
    if (end > 0.0 && describe(estimate).max > end) panel.high = end;
    panel.heightPixels = 290.0;
    figure.panels = {panel};
    return {"time", figure};
}

NamedFigure levelsFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Levels of the front");
    PlotPanel counts, shares;
    counts.yTitle = "nodes drawn";
    counts.counts = true;
    counts.heightPixels = 220.0;
    shares.yTitle = "share (%)";
    shares.low = 0.0;
    shares.high = 100.0;
    shares.heightPixels = 150.0;
    for (int level = 0; level < std::clamp(report.levels, 1, kMaxLevels); ++level) {
        const auto nodes = [level](const FrameRecord& f) {
            return double(f.levels[static_cast<std::size_t>(level)]);
        };
        const auto share = [nodes](const FrameRecord& f) {
            return f.frontNodes ? 100.0 * nodes(f) / f.frontNodes : 0.0;
        };
        const std::string name = "level " + std::to_string(level) + (level == 0 ? " (coarsest)" : "");
        const Rgb colour = levelPlotColour(level);
        counts.series.push_back({name, colour, collect(report, nodes), SeriesKind::area, 1.0, false, {}});
        shares.series.push_back({"", colour, collect(report, share), SeriesKind::area, 1.0, false, {}});
    }
    figure.panels = {counts, shares};
    return {"levels", figure};
}

NamedFigure estimateFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Accuracy of the estimated time, and v_time");
    const std::vector<double> percent = collect(report, [](const FrameRecord& f) {
        return f.actualMs > 0.0 ? 100.0 * (f.actualMs - f.estimateMs) / f.actualMs
                                : std::numeric_limits<double>::quiet_NaN();
    });
    const Distribution d = describe(percent);
    std::vector<double> sizes = percent;
    for (double& v : sizes) v = std::abs(v);
    PlotPanel error, vTime;
    error.yTitle = "(actual - estimate) / actual (%)";
    error.heightPixels = 230.0;
    error.series = {{"per frame (mean " + fixedText(d.mean, 2) + " %, sd " + fixedText(d.sd, 2) + " %)",
                     lightened(kSky, 0.3),
                     percent,
                     SeriesKind::line,
                     1.0,
                     false,
                     {}},
                    {"mean of 35 frames",
                     kBlue,
                     movingAverage(percent, kAverageFrames),
                     SeriesKind::line,
                     1.8,
                     false,
                     {}}};
    if (const double end = axisEnd(sizes); describe(sizes).max > end) {
        error.low = -end;
        error.high = end;
    }
    vTime.yTitle = "v_time (ns)";
    vTime.heightPixels = 110.0;
    vTime.fromZero = false;
    vTime.series = {{"v_time: time per unit of cost",
                     kVermilion,
                     collect(report, [](const FrameRecord& f) { return f.vTimeMs * 1e6; }),
                     SeriesKind::line,
                     1.4,
                     false,
                     {}}};
    figure.panels = {error, vTime};
    return {"estimate", figure};
}

NamedFigure togglesFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Toggles: switches between a node and its children");
    const std::vector<double> up = collect(report, [](const FrameRecord& f) { return f.togglesUp; });
    const std::vector<double> down =
        collect(report, [](const FrameRecord& f) { return -double(f.togglesDown); });
    const std::vector<double> both =
        collect(report, [](const FrameRecord& f) { return f.togglesUp + f.togglesDown; });
    double ups = 0.0, downs = 0.0;
    for (double v : up) ups += v;
    for (double v : down) downs -= v;
    PlotPanel panel;
    panel.yTitle = "toggles per frame (down: negative)";
    panel.counts = true;
    panel.series = {
        {"up (" + fixedText(ups, 0) + ")", kGreen, up, SeriesKind::impulses, 1.4, false, {}},
        {"down (" + fixedText(downs, 0) + ")", kVermilion, down, SeriesKind::impulses, 1.4, false, {}},
        {"up and down, mean of 35 frames",
         kInk,
         movingAverage(both, kAverageFrames),
         SeriesKind::line,
         1.6,
         false,
         {}}};
    panel.heightPixels = 290.0;
    figure.panels = {panel};
    return {"toggles", figure};
}

NamedFigure memoryFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Memory against the budget");
    PlotPanel panel;
    panel.yTitle = "memory (MiB)";
    panel.series = {
        {"resident",
         kSky,
         collect(report, [](const FrameRecord& f) { return double(f.residentBytes) / kMebibyte; }),
         SeriesKind::area,
         1.0,
         false,
         {}},
        {"reserved for loads",
         kOrange,
         collect(report, [](const FrameRecord& f) { return double(f.reservedBytes) / kMebibyte; }),
         SeriesKind::area,
         1.0,
         false,
         {}},
        {"budget",
         kInk,
         collect(report, [](const FrameRecord& f) { return double(f.budgetBytes) / kMebibyte; }),
         SeriesKind::line,
         1.6,
         true,
         {}}};
    panel.heightPixels = 290.0;
    figure.panels = {panel};
    return {"memory", figure};
}

NamedFigure errorFigure(const ReplayReport& report) {
    Figure figure = figureOf(report, "Screen-space error of the front");
    const std::vector<double> means = collect(report, [](const FrameRecord& f) { return f.errorPixelsMean; });
    const std::vector<double> worst = collect(report, [](const FrameRecord& f) { return f.errorPixelsMax; });
    PlotPanel mean, max;
    mean.yTitle = "mean (pixels)";
    mean.series = {
        {noted("mean by area", describe(means), 2, " px"), kBlue, means, SeriesKind::line, 1.4, false, {}}};
    if (const double end = axisEnd(means); describe(means).max > end) mean.high = end;
    mean.heightPixels = 170.0;
    max.yTitle = "maximum (pixels)";
    if (const double end = axisEnd(worst); describe(worst).max > end) max.high = end;
    max.series = {{noted("worst node", describe(worst), 1, " px"),
                   kVermilion,
                   worst,
                   SeriesKind::line,
                   1.4,
                   false,
                   {}}};
    max.heightPixels = 170.0;
    figure.panels = {mean, max};
    return {"error", figure};
}

}  // namespace

std::vector<NamedFigure> replayFigures(const ReplayReport& report) {
    return {timeFigure(report),    levelsFigure(report), estimateFigure(report),
            togglesFigure(report), memoryFigure(report), errorFigure(report)};
}

}  // namespace fb
