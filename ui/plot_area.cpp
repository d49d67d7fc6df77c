#include "ui/plot_area.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/plot.h"

namespace fb {
namespace {

constexpr int kTicksX = 6;
constexpr int kTicksY = 5;

// Index of the first frame at or after `seconds`; the history is sorted by time.
std::size_t firstFrameAt(const History& history, double seconds) {
    std::size_t low = 0;
    std::size_t high = history.size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (history[middle].timeSeconds < seconds) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

void label(float x, float y, double value, double step) {
    char text[32];
    const int digits = step >= 1.0 ? 0 : std::min(6, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    std::snprintf(text, sizeof text, "%.*f", digits, value + 0.0);  // never -0
    ImGui::GetWindowDrawList()->AddText(ImVec2(x, y), ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
}

void drawTicksY(const PlotArea& area, ImU32 grid) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float left = ImGui::GetWindowPos().x + 4.0f;
    const float half = 0.5f * ImGui::GetFontSize();
    const auto tick = [&](double value, double step) {
        const float y = area.y(value);
        draw->AddLine(ImVec2(area.low.x, y), ImVec2(area.high.x, y), grid);
        label(left, y - half, value, step);
    };
    if (area.logarithmic) {
        for (double value = std::pow(10.0, std::ceil(std::log10(area.lowValue))); value <= area.highValue; value *= 10.0) {
            tick(value, value);
        }
        return;
    }
    const double step = tickStep(area.lowValue, area.highValue, kTicksY);
    for (double i = std::ceil(area.lowValue / step - 1e-9) + 0.0; i * step <= area.highValue * (1.0 + 1e-9); i += 1.0) {
        tick(i * step, step);
    }
}

}  // namespace

double tickStep(double low, double high, int count) {
    const double raw = std::max(high - low, 1e-9) / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
    }
    return 10.0 * power;
}

float PlotArea::x(double seconds) const {
    const double part = (seconds - firstSecond) / std::max(lastSecond - firstSecond, 1e-9);
    return low.x + static_cast<float>(part) * (high.x - low.x);
}

float PlotArea::y(double value) const {
    double part = 0.0;
    if (logarithmic) {
        part = std::log(std::max(value, lowValue) / lowValue) / std::log(highValue / lowValue);
    } else {
        part = (value - lowValue) / std::max(highValue - lowValue, 1e-12);
    }
    return high.y - static_cast<float>(std::clamp(part, -1.0, 2.0)) * (high.y - low.y);
}

bool beginPlot(const char* id, const History& history, double shownSeconds, PlotArea& area) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float font = ImGui::GetFontSize();
    const ImVec2 start = ImGui::GetCursorScreenPos();
    area.low = ImVec2(start.x + 3.2f * font, start.y + 0.5f * font);
    area.high = ImVec2(start.x + room.x - 0.5f * font, start.y + room.y - 1.4f * font);
    if (area.high.x - area.low.x < 40.0f || area.high.y - area.low.y < 20.0f) return false;
    if (history.size() < 2) {
        ImGui::TextDisabled("no frames yet");
        return false;
    }
    ImGui::InvisibleButton(id, room);
    area.lastSecond = history.newest().timeSeconds;
    area.firstSecond = area.lastSecond - shownSeconds;
    area.firstFrame = firstFrameAt(history, area.firstSecond);
    area.hovered = ImGui::IsItemHovered();
    if (area.hovered) {
        const double part = (ImGui::GetIO().MousePos.x - area.low.x) / (area.high.x - area.low.x);
        const double seconds = area.firstSecond + part * (area.lastSecond - area.firstSecond);
        area.hoveredFrame = std::min(firstFrameAt(history, seconds), history.size() - 1);
    }
    return true;
}

void drawAxes(const PlotArea& area, std::string_view unit) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    ImVec4 faint = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    faint.w = 0.12f;
    const ImU32 grid = ImGui::ColorConvertFloat4ToU32(faint);
    drawTicksY(area, grid);
    const double step = tickStep(area.firstSecond, area.lastSecond, kTicksX);
    const float textWidth = 2.5f * ImGui::GetFontSize();
    for (double i = std::ceil(area.firstSecond / step); i * step <= area.lastSecond; i += 1.0) {
        if (i * step < 0.0) continue;  // before the walk began
        const float x = area.x(i * step);
        draw->AddLine(ImVec2(x, area.low.y), ImVec2(x, area.high.y), grid);
        if (x + textWidth < area.high.x) label(x + 2.0f, area.high.y + 2.0f, i * step, step);
    }
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    draw->AddText(ImVec2(area.low.x + 4.0f, area.low.y - 2.0f), text, unit.data(), unit.data() + unit.size());
    draw->AddText(ImVec2(area.high.x - ImGui::GetFontSize(), area.high.y + 2.0f), text, "s");
    draw->AddRect(area.low, area.high, grid);
}

void drawHoverLine(const PlotArea& area, const History& history) {
    if (!area.hovered) return;
    const float x = area.x(history[area.hoveredFrame].timeSeconds);
    ImGui::GetWindowDrawList()->AddLine(ImVec2(x, area.low.y), ImVec2(x, area.high.y),
                                        ImGui::GetColorU32(ImGuiCol_TextDisabled));
}

}  // namespace fb
