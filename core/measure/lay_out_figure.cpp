// Figure -> Drawing: head, legends, grids, axes and their words. All lengths are pixels.
#include <algorithm>
#include <cmath>

#include "measure/draw_series.h"
#include "measure/figure.h"
#include "measure/fit_axes.h"

namespace fb {
namespace {

constexpr double kTextSize = 12.0, kTitleSize = 15.0, kLegendRow = 19.0, kRight = 22.0, kBetweenPanels = 14.0;

struct LegendItem {
    const PlotSeries* series;  // null: words alone
    std::string text;
    double x = 0.0;
    int row = 0;

    [[nodiscard]] double sampleWidth() const { return series ? swatchWidth(*series) + 6.0 : 0.0; }
};

// "3 beyond the axis, up to 310", nothing where the axis reaches everything.
std::string beyondText(const PanelData& data, const PlotAxis& y) {
    std::size_t beyond = 0;
    AxisRange reach = y.range;
    for (const std::vector<double>& values : data.values) {
        for (double v : values) {
            if (!std::isfinite(v) || (!y.endsBelow(v) && !y.startsAbove(v))) continue;
            ++beyond;
            reach.add(v);
        }
    }
    if (beyond == 0) return {};
    std::string text = std::to_string(beyond) + " beyond the axis";
    if (reach.low < y.range.low) text += ", down to " + tickLabel(reach.low, y.ticks.step / 10.0);
    if (reach.high > y.range.high) text += ", up to " + tickLabel(reach.high, y.ticks.step / 10.0);
    return text;
}

std::vector<LegendItem> legendOf(const PlotPanel& panel, const PanelData& data, const PlotAxis& y,
                                 double left, double right) {
    std::vector<LegendItem> items;
    for (const PlotSeries& series : panel.series) {
        if (!series.name.empty()) items.push_back({&series, series.name});
    }
    if (std::string text = beyondText(data, y); !text.empty()) items.push_back({nullptr, std::move(text)});
    double x = left;
    int row = 0;
    for (LegendItem& item : items) {
        const double width = item.sampleWidth() + textWidth(item.text, kTextSize);
        if (x > left && x + width > right) {
            x = left;
            ++row;
        }
        item.x = x;
        item.row = row;
        x += width + 20.0;
    }
    return items;
}

class Layout {
  public:
    explicit Layout(const Figure& figure) : figure_(figure) { drawing_.width = figure.widthPixels; }

    Drawing run() {
        std::vector<PanelData> data;
        std::vector<PlotAxis> axes;
        double labels = 0.0;
        for (const PlotPanel& panel : figure_.panels) {
            data.push_back(gatherPanel(figure_, panel));
            axes.push_back(fitYAxis(panel, data.back()));
            const Ticks& ticks = axes.back().ticks;
            for (double v : ticks.at)
                labels = std::max(labels, textWidth(tickLabel(v, ticks.step), kTextSize));
        }
        left_ = 46.0 + std::ceil(labels);
        right_ = figure_.widthPixels - kRight;
        x_ = fitXAxis(figure_, left_, right_);

        double top = addHead();
        for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
            const PlotPanel& panel = figure_.panels[i];
            top = addLegend(legendOf(panel, data[i], axes[i], left_, right_), top);
            axes[i].from = top + panel.heightPixels;
            axes[i].to = top;
            addGrid(axes[i]);
            drawSeries(figure_, panel, data[i], x_, axes[i], drawing_.items);
            const glm::dvec2 middle((left_ + right_) / 2.0, (axes[i].from + axes[i].to) / 2.0);
            if (data[i].empty) addText(middle, "no data", TextAnchor::middle, kGrey);
            addAxes(panel, axes[i], i + 1 == figure_.panels.size());
            top += panel.heightPixels + kBetweenPanels;
        }
        drawing_.height = static_cast<int>(std::ceil(top + 36.0));
        return std::move(drawing_);
    }

  private:
    void addLine(std::vector<glm::dvec2> points, Rgb colour) {
        drawing_.items.emplace_back(DrawnLine{std::move(points), colour, 1.0});
    }
    void addText(const glm::dvec2& at, std::string words, TextAnchor anchor, Rgb colour = kInk) {
        drawing_.items.emplace_back(DrawnText{at, std::move(words), kTextSize, anchor, colour, false, false});
    }
    // The middle of a pixel: a line one pixel wide is sharp there.
    static double sharp(double pixel) { return std::floor(pixel) + 0.5; }

    double addHead() {
        drawing_.items.emplace_back(
            DrawnText{{14.0, 25.0}, figure_.title, kTitleSize, TextAnchor::start, kInk, true, false});
        if (figure_.subtitle.empty()) return 40.0;
        addText({14.0, 44.0}, figure_.subtitle, TextAnchor::start, kGrey);
        return 58.0;
    }

    double addLegend(const std::vector<LegendItem>& items, double top) {
        for (const LegendItem& item : items) {
            const double middle = top + item.row * kLegendRow + 7.0;
            if (item.series) drawSwatch(*item.series, item.x, middle, drawing_.items);
            addText({item.x + item.sampleWidth(), middle + 4.5}, item.text, TextAnchor::start,
                    item.series ? kInk : kGrey);
        }
        return items.empty() ? top + 4.0 : top + (items.back().row + 1) * kLegendRow + 5.0;
    }

    void addGrid(const PlotAxis& y) {
        for (double v : y.ticks.at)
            addLine({{left_, sharp(y.pixel(v))}, {right_, sharp(y.pixel(v))}}, kGridGrey);
        for (double v : x_.ticks.at)
            addLine({{sharp(x_.pixel(v)), y.to}, {sharp(x_.pixel(v)), y.from}}, kGridGrey);
    }

    void addAxes(const PlotPanel& panel, const PlotAxis& y, bool last) {
        const double bottom = sharp(y.from), edge = sharp(left_) - 1.0;
        addLine({{edge, y.to}, {edge, bottom}, {right_, bottom}}, kInk);
        if (y.range.low < 0.0 && y.range.high > 0.0) {
            addLine({{left_, sharp(y.pixel(0.0))}, {right_, sharp(y.pixel(0.0))}}, kGrey);
        }
        for (double v : y.ticks.at) {
            const double at = y.pixel(v);
            addLine({{edge - 4.0, sharp(at)}, {edge, sharp(at)}}, kInk);
            addText({left_ - 9.0, at + 4.5}, tickLabel(v, y.ticks.step), TextAnchor::end);
        }
        drawing_.items.emplace_back(DrawnText{
            {22.0, (y.from + y.to) / 2.0}, panel.yTitle, kTextSize, TextAnchor::middle, kInk, false, true});
        for (double v : x_.ticks.at) {
            const double at = sharp(x_.pixel(v));
            addLine({{at, bottom}, {at, bottom + 4.0}}, kInk);
            if (last) addText({at, bottom + 18.0}, tickLabel(v, x_.ticks.step), TextAnchor::middle);
        }
        if (last) addText({(left_ + right_) / 2.0, bottom + 38.0}, figure_.xTitle, TextAnchor::middle);
    }

    const Figure& figure_;
    Drawing drawing_;
    PlotAxis x_;
    double left_ = 0.0, right_ = 0.0;
};

}  // namespace

Drawing layOut(const Figure& figure) {
    return Layout(figure).run();
}

}  // namespace fb
