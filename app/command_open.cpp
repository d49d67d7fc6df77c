// The workbench's window: opens a scene, or builds meshes in a child process first, and runs frames until it is closed.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include "app/describe_walk.h"
#include "app/frame.h"
#include "app/guarded_child.h"
#include "app/measure_frame.h"
#include "app/session.h"
#include "base/clock.h"

namespace fb {
namespace {

void pressKeys(Session& s) {
    const std::vector<Window::KeyPress> keys = s.window->takeKeys();
    if (ImGui::GetIO().WantTextInput) return;
    for (const Window::KeyPress& press : keys) {
        if (press.key == GLFW_KEY_TAB) s.ui.hidden = !s.ui.hidden;
        if (press.key == GLFW_KEY_HOME && s.workbench.scene) {
            s.path.reset();
            frameBounds(s.fly, s.workbench.scene->info.bounds);
        }
        if (press.key == GLFW_KEY_F12) s.requests.saveScreenshot = true;
        if (press.key == GLFW_KEY_Q && (press.modifiers & GLFW_MOD_CONTROL)) s.quit = true;
    }
}

void moveCamera(Session& s, double dtSeconds) {
    s.fly.camera.fovyRadians = glm::radians(s.workbench.settings.draw.fovyDegrees);
    s.fly.camera.nearMetres = nearMetres(s.workbench);
    if (fly(s.fly, s.window->readFlyInput(s.requests.viewHovered, dtSeconds), dtSeconds)) s.path.reset();
    if (!s.path) return;
    s.pathSeconds += dtSeconds;
    if (s.pathSeconds > s.path->durationSeconds()) s.pathSeconds = 0.0;
    const Camera played = s.path->at(s.pathSeconds);
    s.fly.camera.eye = played.eye;
    s.fly.camera.orientation = played.orientation;
    s.fly.velocity = s.path->velocityAt(s.pathSeconds);
}

void runSceneFrame(Session& s, double dtSeconds) {
    if (!s.workbench.scene || s.child.running()) return;
    FrameInput input;
    input.camera = s.fly.camera;
    input.velocity = s.fly.velocity;
    input.dtSeconds = dtSeconds;
    input.width = std::clamp(s.requests.viewSize.x, 1, 16384);
    input.height = std::clamp(s.requests.viewSize.y, 1, 16384);
    runFrame(s.workbench, input);
}

void runUi(Session& s) {
    const SteadyClock::time_point start = SteadyClock::now();
    std::optional<WorkProgress> work;
    if (s.child.running()) work = WorkProgress{s.childTitle, s.child.phase(), s.child.fraction(), s.child.secondsLeft()};
    UiInput input{s.workbench.settings,
                  s.preset.settings,
                  s.preset.name,
                  s.presets,
                  s.pathNames,
                  s.path ? std::string_view(s.path->name) : std::string_view(),
                  s.workbench.history,
                  s.workbench.scene.get(),
                  work,
                  s.message,
                  s.messageIsError,
                  s.errors,
                  s.workbench.renderer->pictureTexture(),
                  s.path ? glm::length(s.fly.velocity) : s.fly.speedMetresPerSecond,
                  s.device,
                  {}};
    for (int level = 0; level < kMaxLevels; ++level) input.levelColours[static_cast<std::size_t>(level)] = levelColour(level);
    s.requests = {};
    drawWorkbenchUi(input, s.ui, s.requests);
    pressKeys(s);
    s.workbench.lastUiMs = millisecondsSince(start);
}

// With --frames the window ends by itself: once so many frames have shown the scene, or when nothing could be opened.
bool isOver(const OpenCommand& command, const Session& s, std::uint64_t shown) {
    if (s.window->shouldClose() || s.quit || s.failed || stopWanted()) return true;
    if (command.frames == 0) return false;
    return shown >= command.frames || (!s.workbench.scene && !s.child.running());
}

Result<void> finish(const OpenCommand& command, Session& s) {
    s.faults.flush();
    // Complaints were told when they came.
    if (s.failed || (!s.workbench.scene && command.frames > 0)) return failure({}, {}, {});
    if (!s.workbench.scene) return {};
    if (!command.screenshot.empty()) {
        if (Result<void> saved = s.window->saveScreenshot(command.screenshot); !saved) return saved;
    }
    if (command.out.empty()) return {};
    waitForTimes(s.workbench);
    const WalkNames names{s.preset.name, command.path.empty() ? "free flight" : command.path};
    return writeReport(describeWalk(s.workbench, names, std::move(s.records)), command.out);
}

}  // namespace

Result<void> runWindow(const OpenCommand& command) {
    Session s;
    if (Result<void> opened = openSession(command, s); !opened) return opened;
    watchForStop();
    std::uint64_t shown = 0;  // frames with a scene
    while (!isOver(command, s, shown)) {
        const double dt = s.window->beginFrame();
        pollChild(s);
        const std::vector<std::filesystem::path> dropped = s.window->takeDropped();
        if (!dropped.empty() && s.child.running()) say(s, "a build is running: drop the files again when it has ended");
        if (!dropped.empty() && !s.child.running()) openInputs(s, dropped);
        moveCamera(s, dt);
        runSceneFrame(s, dt);
        runUi(s);
        s.window->endFrame();
        carryOut(s, s.requests);
        shown += s.workbench.scene && !s.child.running() ? 1 : 0;
    }
    return finish(command, s);
}

}  // namespace fb
