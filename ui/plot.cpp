#include "ui/plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/plot_area.h"

namespace fb {
namespace {

ImU32 colourOf(const glm::vec3& c, float alpha = 1.0f) { return ImGui::ColorConvertFloat4ToU32(ImVec4(c.x, c.y, c.z, alpha)); }

struct Column {
    double low = 0.0, high = 0.0, last = 0.0;
    bool filled = false;
};

// Calls draw(columnX, Column) for each column of pixels that holds a value, from left to right.
template <class Draw>
void forEachColumn(const PlotArea& area, const History& history, double (*value)(const FrameRecord&), const Draw& draw) {
    Column column;
    float columnX = -1.0f;
    for (std::size_t i = area.firstFrame; i < history.size(); ++i) {
        const double v = value(history[i]);
        const float x = std::floor(area.x(history[i].timeSeconds));
        if (x != columnX) {
            if (columnX >= 0.0f) draw(columnX, column);
            columnX = x;
            column = {};
        }
        if (!std::isfinite(v)) continue;
        column.low = column.filled ? std::min(column.low, v) : v;
        column.high = column.filled ? std::max(column.high, v) : v;
        column.last = v;
        column.filled = true;
    }
    if (columnX >= 0.0f) draw(columnX, column);
}

void drawSeries(const PlotArea& area, const History& history, const PlotSeries& series) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 colour = colourOf(series.colour);
    bool connected = false;
    ImVec2 before;
    forEachColumn(area, history, series.value, [&](float x, const Column& column) {
        if (!column.filled) {
            connected = false;
            return;
        }
        const float low = area.y(column.low);
        const float high = area.y(column.high);
        if (connected) list->AddLine(before, ImVec2(x, 0.5f * (low + high)), colour, 1.5f);
        if (low - high > 1.0f) list->AddLine(ImVec2(x, low), ImVec2(x, high), colour, 1.0f);
        before = ImVec2(x, area.y(column.last));
        connected = true;
    });
}

void fitValues(PlotArea& area, const History& history, std::span<const PlotSeries> series, const PlotOptions& options) {
    double low = std::numeric_limits<double>::max();
    double high = options.atLeastHigh;
    for (std::size_t i = area.firstFrame; i < history.size(); ++i) {
        for (const PlotSeries& s : series) {
            const double v = s.value(history[i]);
            if (!std::isfinite(v) || (options.logarithmic && v <= 0.0)) continue;
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    area.logarithmic = options.logarithmic;
    if (options.logarithmic) {
        area.lowValue = std::min(low, high) > 0.0 && low < high ? low / 1.2 : 0.1;
        area.highValue = std::max(high * 1.2, area.lowValue * 10.0);
    } else {
        area.lowValue = std::min(0.0, low);
        area.highValue = high > area.lowValue ? high * 1.08 : area.lowValue + 1.0;
    }
}

// To the right of the unit, which drawAxes writes into the same line.
void drawLegend(const PlotArea& area, std::span<const PlotSeries> series, std::string_view unit) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    float x = area.low.x + ImGui::CalcTextSize(unit.data(), unit.data() + unit.size()).x + ImGui::GetFontSize();
    for (const PlotSeries& s : series) {
        const ImVec2 size = ImGui::CalcTextSize(s.label.data(), s.label.data() + s.label.size());
        list->AddRectFilled(ImVec2(x, area.low.y + 4.0f), ImVec2(x + 10.0f, area.low.y + 8.0f), colourOf(s.colour));
        list->AddText(ImVec2(x + 14.0f, area.low.y - 2.0f), ImGui::GetColorU32(ImGuiCol_Text), s.label.data(),
                      s.label.data() + s.label.size());
        x += size.x + 30.0f;
    }
}

void tooltip(const FrameRecord& record, std::span<const PlotSeries> series, std::string_view unit) {
    ImGui::BeginTooltip();
    ImGui::Text("frame %llu, %.2f s", static_cast<unsigned long long>(record.frame), record.timeSeconds);
    for (const PlotSeries& s : series) {
        const ImVec4 colour(s.colour.x, s.colour.y, s.colour.z, 1.0f);
        ImGui::TextColored(colour, "%.*s %.4g %.*s", static_cast<int>(s.label.size()), s.label.data(), s.value(record),
                           static_cast<int>(unit.size()), unit.data());
    }
    ImGui::EndTooltip();
}

}  // namespace

void plotLines(const char* id, const History& history, std::span<const PlotSeries> series, const PlotOptions& options) {
    PlotArea area;
    if (!beginPlot(id, history, options.shownSeconds, area)) return;
    fitValues(area, history, series, options);
    drawAxes(area, options.unit);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(area.low, area.high, true);
    if (options.band) {
        list->AddRectFilled(ImVec2(area.low.x, area.y(options.band->high)), ImVec2(area.high.x, area.y(options.band->low)),
                            colourOf(options.band->colour, 0.18f));
    }
    for (const PlotSeries& s : series) drawSeries(area, history, s);
    list->PopClipRect();
    drawHoverLine(area, history);
    drawLegend(area, series, options.unit);
    if (area.hovered) tooltip(history[area.hoveredFrame], series, options.unit);
}

void plotLevels(const char* id, const History& history, std::span<const glm::vec3> colours, int levels,
                double shownSeconds) {
    PlotArea area;
    if (!beginPlot(id, history, shownSeconds, area)) return;
    std::uint32_t most = 1;
    for (std::size_t i = area.firstFrame; i < history.size(); ++i) most = std::max(most, history[i].frontNodes);
    area.highValue = 1.08 * most;
    drawAxes(area, "nodes");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(area.low, area.high, true);
    // One column of pixels shows the newest frame that falls into it, as wide as the way to the next one.
    float right = area.high.x;
    for (std::size_t i = history.size(); i-- > area.firstFrame;) {
        const float left = std::floor(area.x(history[i].timeSeconds));
        if (left >= right) continue;
        double sum = 0.0;
        for (int level = 0; level < levels; ++level) {
            const double next = sum + history[i].levels[static_cast<std::size_t>(level)];
            list->AddRectFilled(ImVec2(left, area.y(next)), ImVec2(right, area.y(sum)),
                                colourOf(colours[static_cast<std::size_t>(level)]));
            sum = next;
        }
        right = left;
    }
    list->PopClipRect();
    drawHoverLine(area, history);
    if (!area.hovered) return;
    const FrameRecord& record = history[area.hoveredFrame];
    ImGui::BeginTooltip();
    ImGui::Text("frame %llu, %.2f s: %u nodes", static_cast<unsigned long long>(record.frame), record.timeSeconds,
                record.frontNodes);
    for (int level = 0; level < levels; ++level) {
        ImGui::Text("level %d: %u", level, record.levels[static_cast<std::size_t>(level)]);
    }
    ImGui::EndTooltip();
}

}  // namespace fb
