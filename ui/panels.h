// The panels, one file each; workbench_ui.cpp lays them out.
#pragma once

#include <algorithm>

#include "ui/workbench_ui.h"

namespace fb {

// Levels that records and colours tell apart.
[[nodiscard]] inline int shownLevels(const Scene& scene) {
    return std::min(scene.hierarchy.maxLevel() + 1, kMaxLevels);
}

void drawViewPanel(const UiInput& input, UiState& state, UiRequests& requests);
void drawTuningPanel(const UiInput& input, UiState& state, UiRequests& requests);
void drawTimePanel(const UiInput& input, UiState& state);
void drawLevelsPanel(const UiInput& input, UiState& state);
void drawPresetsPanel(const UiInput& input, UiState& state, UiRequests& requests);
void drawStatusBar(const UiInput& input);

}  // namespace fb
