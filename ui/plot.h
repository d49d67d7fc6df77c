// Time plots over the frame history. A column of pixels shows the range of all values that fall into it, so that a spike
// of one frame is never lost; NaN leaves a gap. The same x range is used by every plot of a frame.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measure/history.h"

namespace fb {

struct PlotSeries {
    std::string_view label;
    glm::vec3 colour;
    double (*value)(const FrameRecord&);
};

struct PlotBand {
    double low, high;
    glm::vec3 colour;
};

struct PlotOptions {
    std::string_view unit;
    double shownSeconds = 20.0;
    bool logarithmic = false;
    std::optional<PlotBand> band;   // drawn behind the lines
    double atLeastHigh = 0.0;       // the y axis reaches at least this far
};

// Draws into the rest of the current child window. Hovering shows the values of the frame under the mouse.
void plotLines(const char* id, const History& history, std::span<const PlotSeries> series, const PlotOptions& options);

// Front nodes per level as a stacked area, coarse levels at the bottom.
void plotLevels(const char* id, const History& history, std::span<const glm::vec3> colours, int levels,
                double shownSeconds);

// Steps of 1, 2 or 5 times a power of ten, at most `count` of them in [low, high].
[[nodiscard]] double tickStep(double low, double high, int count);

}  // namespace fb
