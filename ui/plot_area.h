// The frame of a plot: axes with ticks and units, the mapping from seconds and values to pixels, the hovered frame.
#pragma once

#include <imgui.h>

#include <string_view>

#include "measure/history.h"

namespace fb {

struct PlotArea {
    ImVec2 low, high;           // pixels: top left and bottom right of the drawing area
    double firstSecond = 0.0, lastSecond = 1.0;
    double lowValue = 0.0, highValue = 1.0;
    bool logarithmic = false;
    std::size_t firstFrame = 0;  // index into the history of the first shown frame
    std::size_t hoveredFrame = 0;
    bool hovered = false;

    [[nodiscard]] float x(double seconds) const;
    [[nodiscard]] float y(double value) const;
};

// Takes the rest of the child window, finds the shown frames and the hovered one. False when there is no room or no data.
[[nodiscard]] bool beginPlot(const char* id, const History& history, double shownSeconds, PlotArea& area);
// Axes, grid lines and labels; call once lowValue and highValue are set, before drawing the data.
void drawAxes(const PlotArea& area, std::string_view unit);
void drawHoverLine(const PlotArea& area, const History& history);

}  // namespace fb
