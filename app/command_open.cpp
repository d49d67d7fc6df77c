// The workbench's window: opens a scene, or builds meshes in a child process first, and runs frames until it is closed.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/program_folder.h"
#include "app/build_child.h"
#include "app/commands.h"
#include "app/frame.h"
#include "app/option_text.h"
#include "app/window.h"
#include "base/clock.h"
#include "base/hash.h"
#include "measure/camera_path.h"
#include "settings/preset.h"
#include "ui/workbench_ui.h"

namespace fb {
namespace {

// What the window keeps beside the workbench. The window's context must outlive the workbench's renderer.
struct Session {
    std::unique_ptr<Window> window;
    Workbench workbench;
    FlyCamera fly;
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
    std::string message;
    bool messageIsError = false;
    std::uint32_t errors = 0;
    std::string device;
};

void say(Session& s, std::string text) {
    s.message = std::move(text);
    s.messageIsError = false;
}

void complain(Session& s, const Error& error) {
    s.message = error.oneLine();
    s.messageIsError = true;
    ++s.errors;
    std::fprintf(stderr, "frontbench: %s\n", s.message.c_str());
}

void showScene(Session& s, const std::filesystem::path& folder) {
    if (Result<void> opened = openScene(s.workbench, folder); !opened) return complain(s, opened.error());
    s.fly.up = s.workbench.scene->info.upVector();
    s.path.reset();
    frameBounds(s.fly, s.workbench.scene->info.bounds);
    // A scene with streets is entered at the start of its walk.
    if (Result<CameraPath> still = loadPath("still", s.workbench.scene->info); still) s.fly.camera = still->at(0.0);
    say(s, folder.string());
}

void startChild(Session& s, std::vector<std::string> arguments, std::string title, std::filesystem::path output) {
    s.childTitle = std::move(title);
    s.childOutput = std::move(output);
    std::error_code ignored;
    std::filesystem::create_directories(s.childOutput.parent_path(), ignored);
    if (Result<void> started = s.child.start(arguments); !started) complain(s, started.error());
}

// The scene that the same meshes were built into before, or will be: named after them and where they lie.
std::filesystem::path cachedSceneOf(const std::vector<std::filesystem::path>& meshes) {
    Hasher hasher;
    for (const auto& mesh : meshes) {
        std::error_code missing;
        hasher.text(std::filesystem::absolute(mesh, missing).string());
    }
    return builtInCityFolder().parent_path() / (meshes.front().stem().string() + "-" + hashText(hasher.digest()) + ".fbscene");
}

bool isSceneFolder(const std::filesystem::path& path) {
    return std::filesystem::is_directory(path) || path.extension() == ".fbscene";
}

void openInputs(Session& s, const std::vector<std::filesystem::path>& inputs) {
    if (inputs.empty()) {
        const std::filesystem::path city = builtInCityFolder();
        if (Result<Scene> scene = openScene(city); scene) return showScene(s, city);
        return startChild(s, {"city", "-o", city.string()}, "Making the built-in city (once)", city);
    }
    if (isSceneFolder(inputs.front())) return showScene(s, inputs.front());
    const std::filesystem::path output = cachedSceneOf(inputs);
    std::vector<std::string> arguments = {"build"};
    for (const auto& input : inputs) arguments.push_back(input.string());
    arguments.insert(arguments.end(), {"-o", output.string()});
    startChild(s, std::move(arguments), "Building " + inputs.front().filename().string(), output);
}

void pollChild(Session& s) {
    const std::optional<Result<void>> ended = s.child.poll();
    if (!ended) return;
    if (!*ended) return complain(s, ended->error());
    showScene(s, s.childOutput);
    for (const std::string& note : s.child.notes()) say(s, note);
}

void loadPresetInto(Session& s, const std::string& nameOrPath) {
    Result<Preset> preset = loadPreset(nameOrPath);
    if (!preset) return complain(s, preset.error());
    s.preset = std::move(*preset);
    s.workbench.settings = s.preset.settings;
    say(s, "preset " + s.preset.name + ": " + s.preset.about);
}

void savePresetAs(Session& s, const std::string& name) {
    Preset preset{name, s.preset.about, s.workbench.settings};
    const std::filesystem::path file = userPresetFolder() / (name + ".toml");
    if (Result<void> saved = savePreset(preset, file); !saved) return complain(s, saved.error());
    s.preset = std::move(preset);
    s.presets = listPresets();
    say(s, "saved " + file.string());
}

void playPath(Session& s, const std::string& name) {
    s.path.reset();
    if (name.empty() || !s.workbench.scene) return;
    Result<CameraPath> path = loadPath(name, s.workbench.scene->info);
    if (!path) return complain(s, path.error());
    s.path = std::move(*path);
    s.pathSeconds = 0.0;
}

void saveWindow(Session& s, const std::filesystem::path& file) {
    if (Result<void> saved = s.window->saveScreenshot(file); !saved) return complain(s, saved.error());
    say(s, "saved " + file.string());
}

std::filesystem::path nextScreenshotName() {
    for (int i = 1;; ++i) {
        const std::filesystem::path file = "frontbench-" + std::to_string(i) + ".png";
        if (!std::filesystem::exists(file)) return file;
    }
}

void carryOut(Session& s, const UiRequests& requests) {
    for (const KnobEdit& edit : requests.edits) {
        Result<void> taken = admit(s.workbench.settings, *edit.knob, edit.value, "Tuning");
        if (!taken) complain(s, taken.error());
    }
    if (requests.loadPreset) loadPresetInto(s, *requests.loadPreset);
    if (requests.savePreset) savePresetAs(s, *requests.savePreset);
    if (requests.playPath) playPath(s, *requests.playPath);
    if (requests.cancelWork) s.child.cancel();
    if (requests.saveScreenshot) saveWindow(s, nextScreenshotName());
}

void pressKeys(Session& s) {
    if (ImGui::GetIO().WantTextInput) return;
    if (ImGui::IsKeyPressed(GLFW_KEY_TAB, false)) s.ui.hidden = !s.ui.hidden;
    if (ImGui::IsKeyPressed(GLFW_KEY_HOME, false) && s.workbench.scene) {
        s.path.reset();
        frameBounds(s.fly, s.workbench.scene->info.bounds);
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_F12, false)) s.requests.saveScreenshot = true;
}

void moveCamera(Session& s, double dtSeconds) {
    s.fly.camera.fovyRadians = glm::radians(s.workbench.settings.draw.fovyDegrees);
    s.fly.camera.nearMetres = s.workbench.settings.draw.nearMetres;
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

Result<void> openSession(const OpenCommand& command, Session& s) {
    Result<glm::ivec2> size = parseSize(command.size);
    if (!size) return passOn(size);
    Result<Preset> preset = loadPreset(command.preset);
    if (!preset) return passOn(preset);
    s.preset = std::move(*preset);
    s.workbench.settings = s.preset.settings;
    if (Result<void> taken = applySets(s.workbench.settings, command.sets); !taken) return taken;
    s.presets = listPresets();
    for (const auto& input : command.inputs) {
        if (!std::filesystem::exists(input)) return failure(input.string(), {}, "there is no such file or folder");
    }
    Result<std::unique_ptr<Window>> window = Window::open(*size, "Frontbench");
    if (!window) return passOn(window);
    s.window = std::move(*window);
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(programFolder() / "shaders");
    if (!renderer) return passOn(renderer);
    s.workbench.renderer = std::move(*renderer);
    s.workbench.onFault = [&s](const Error& fault) { complain(s, fault); };
    s.device = s.workbench.renderer->deviceName();
    openInputs(s, command.inputs);
    return {};
}

}  // namespace

Result<void> runWindow(const OpenCommand& command) {
    Session s;
    if (Result<void> opened = openSession(command, s); !opened) return opened;
    std::uint64_t shown = 0;  // frames with a scene
    while (!s.window->shouldClose()) {
        const double dt = s.window->beginFrame();
        pollChild(s);
        const std::vector<std::filesystem::path> dropped = s.window->takeDropped();
        if (!dropped.empty() && !s.child.running()) openInputs(s, dropped);
        moveCamera(s, dt);
        runSceneFrame(s, dt);
        runUi(s);
        s.window->endFrame();
        carryOut(s, s.requests);
        shown += s.workbench.scene && !s.child.running() ? 1 : 0;
        if (command.frames > 0 && shown >= command.frames) {
            if (!command.screenshot.empty()) return s.window->saveScreenshot(command.screenshot);
            return {};
        }
        if (command.frames > 0 && !s.workbench.scene && !s.child.running()) {
            return failure({}, {}, s.message);
        }
    }
    return {};
}

}  // namespace fb
