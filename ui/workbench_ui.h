// The workbench's panels: read the program's state, return what the user asked for. Nothing is changed here.
// Called once a frame between Dear ImGui's NewFrame and Render; the app carries the requests out afterwards.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/history.h"
#include "scenefile/scene.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {

struct WorkProgress {
    std::string title;   // "building legion.obj"
    std::string phase;
    double fraction = 0.0;
    double secondsLeft = -1.0;  // negative: not known yet
};

struct UiInput {
    const Settings& settings;
    const Settings& reference;  // what the dots and resets compare with: the loaded preset
    std::string_view presetName;
    std::span<const PresetFile> presets;
    std::span<const std::string_view> pathNames;
    std::string_view playingPath;  // empty: the user flies
    const History& history;
    const Scene* scene = nullptr;  // null while nothing is open
    std::optional<WorkProgress> work;
    std::string_view message;      // last notice or error; empty for none
    bool messageIsError = false;
    std::uint32_t errorCount = 0;
    unsigned pictureTexture = 0;   // GL name of the drawn scene
    double speedMetresPerSecond = 0.0;
    std::string_view device;
    std::array<glm::vec3, kMaxLevels> levelColours;
};

struct KnobEdit {
    const Knob* knob;
    double value;
};

struct UiRequests {
    std::vector<KnobEdit> edits;
    std::optional<std::string> loadPreset, savePreset;
    std::optional<std::string> playPath;  // empty text: stop and fly
    glm::ivec2 viewSize{0};               // pixels of the view panel
    bool viewHovered = false;             // the mouse is over the view: it belongs to the camera
    bool saveScreenshot = false;
    bool cancelWork = false;
};

// What the panels keep between frames.
struct UiState {
    float rightShare = 0.30f;   // of the window's width
    float bottomShare = 0.34f;  // of the window's height
    float timeShare = 0.5f;     // of the bottom row's width
    std::string knobSearch;
    std::string presetToSave;
    std::optional<KnobEdit> typed;  // a number that is being typed; asked for when the typing ends
    double shownSeconds = 20.0;  // length of the plots
    bool logTime = false;
    bool hidden = false;         // Tab: the view alone
    std::vector<double> scratch;
};

void drawWorkbenchUi(const UiInput& input, UiState& state, UiRequests& requests);

}  // namespace fb
