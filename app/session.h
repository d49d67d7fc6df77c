// What the window keeps beside the workbench: the camera's path, presets, a build in the child process, the notice for
// the status bar; and what the panels may ask for. Main thread only.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/build_child.h"
#include "app/commands.h"
#include "app/fault_log.h"
#include "app/fly_camera.h"
#include "app/window.h"
#include "app/workbench.h"
#include "measure/camera_path.h"
#include "settings/preset.h"
#include "ui/workbench_ui.h"

namespace fb {

struct Session;
void say(Session& session, std::string text);
void complain(Session& session, const Error& error);

// The window's context must outlive the workbench's renderer: it stands first.
struct Session {
    std::unique_ptr<Window> window;
    Workbench workbench;
    FlyCamera fly;
    std::string firstPath;  // plays when a scene is shown; empty: none
    std::optional<CameraPath> path;
    double pathSeconds = 0.0;
    Preset preset;
    std::vector<PresetFile> presets;
    std::vector<std::string_view> pathNames = builtInPathNames();
    BuildChild child;
    std::string childTitle;
    std::filesystem::path childOutput;
    UiState ui;
    UiRequests requests;  // of the frame before: the view's size and whether the mouse is over it
    FaultLog faults{[this](const Error& fault) { complain(*this, fault); }};
    std::string message;
    bool messageIsError = false;
    std::uint32_t errors = 0;
    std::string device;
    bool quit = false;
    bool failed = false;  // what the command line asked for could not be done
    std::vector<FrameRecord> records;  // of the open scene, when a report was asked for
};

// Opens window, renderer and what the command names. Errors: no window, a wrong option, an input that is missing.
[[nodiscard]] Result<void> openSession(const OpenCommand& command, Session& session);

// A scene, or meshes which a child process builds first; the built-in city when there are none.
void openInputs(Session& session, const std::vector<std::filesystem::path>& inputs);
// Shows the scene of a child that has ended.
void pollChild(Session& session);

// Carries out what the panels asked for in this frame.
void carryOut(Session& session, const UiRequests& requests);

}  // namespace fb
