#include "app/session.h"

#include <algorithm>
#include <cstdio>

#include "app/option_text.h"
#include "base/hash.h"
#include "base/program_folder.h"

namespace fb {
namespace {

void playPath(Session& s, const std::string& name) {
    s.path.reset();
    if (name.empty() || !s.workbench.scene) return;
    Result<CameraPath> path = loadPath(name, s.workbench.scene->info);
    if (!path) return complain(s, path.error());
    s.path = std::move(*path);
    s.pathSeconds = 0.0;
}

void showScene(Session& s, const std::filesystem::path& folder) {
    s.messageIsError = false;
    if (Result<void> opened = openScene(s.workbench, folder); !opened) return complain(s, opened.error());
    s.fly.up = s.workbench.scene->info.upVector();
    s.path.reset();
    s.records.clear();
    frameBounds(s.fly, s.workbench.scene->info.bounds);
    // A scene with streets is entered at the start of its walk.
    if (Result<CameraPath> still = loadPath("still", s.workbench.scene->info); still) s.fly.camera = still->at(0.0);
    const std::uint32_t errorsBefore = s.errors;
    playPath(s, s.firstPath);
    s.failed = s.failed || s.errors > errorsBefore;  // a path that the command line asked for
    if (!s.messageIsError) say(s, folder.filename().string());
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
    std::error_code unreadable;
    return std::filesystem::is_directory(path, unreadable) || path.extension() == ".fbscene";
}

void loadPresetInto(Session& s, const std::string& nameOrPath) {
    Result<Preset> preset = loadPreset(nameOrPath);
    if (!preset) return complain(s, preset.error());
    s.preset = std::move(*preset);
    s.workbench.settings = s.preset.settings;
    say(s, "preset " + s.preset.name + ": " + s.preset.about);
}

void savePresetAs(Session& s, const std::string& name) {
    const auto refuse = [&](const char* why) { complain(s, failure("preset " + name, {}, why, "choose another name").value()); };
    if (name.empty() || name.find('/') != std::string::npos || name.front() == '.') return refuse("is no name for a file");
    for (const PresetFile& file : s.presets) {
        if (file.shipped && file.name == name) return refuse("ships with the program");
    }
    Preset preset{name, s.preset.about, s.workbench.settings};
    const std::filesystem::path file = userPresetFolder() / (name + ".toml");
    if (Result<void> saved = savePreset(preset, file); !saved) return complain(s, saved.error());
    s.preset = std::move(preset);
    s.presets = listPresets();
    say(s, "saved " + file.string());
}

void saveWindow(Session& s, const std::filesystem::path& file) {
    if (Result<void> saved = s.window->saveScreenshot(file); !saved) return complain(s, saved.error());
    say(s, "saved " + file.string());
}

std::filesystem::path nextScreenshotName() {
    for (int i = 1;; ++i) {
        const std::filesystem::path file = "frontbench-" + std::to_string(i) + ".png";
        std::error_code unreadable;
        if (!std::filesystem::exists(file, unreadable)) return file;
    }
}

}  // namespace

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

void openInputs(Session& s, const std::vector<std::filesystem::path>& inputs) {
    if (inputs.empty()) {
        const std::filesystem::path city = builtInCityFolder();
        if (builtInCityIsThere()) return showScene(s, city);
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
    if (s.messageIsError) return;
    for (const std::string& note : s.child.notes()) say(s, note);
}

void carryOut(Session& s, const UiRequests& requests) {
    // Knobs bound by a common rule may have to pass through a forbidden pair: again once the others are set.
    for (const KnobEdit& edit : requests.edits) static_cast<void>(admit(s.workbench.settings, *edit.knob, edit.value, "Tuning"));
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

Result<void> openSession(const OpenCommand& command, Session& s) {
    Result<glm::ivec2> size = parseSize(command.size);
    if (!size) return passOn(size);
    Result<Preset> preset = loadPreset(command.preset);
    if (!preset) return passOn(preset);
    s.preset = std::move(*preset);
    s.workbench.settings = s.preset.settings;
    if (Result<void> taken = applySets(s.workbench.settings, command.sets); !taken) return taken;
    s.presets = listPresets();
    if (command.inputs.size() > 1 && std::ranges::any_of(command.inputs, isSceneFolder)) {
        return usageFailure("SCENE_OR_MESH", "takes one scene, or meshes", "several scenes cannot be open at once");
    }
    for (const auto& input : command.inputs) {
        std::error_code problem;
        if (!std::filesystem::exists(input, problem)) {
            return failure(input.string(), {}, problem ? problem.message() : "there is no such file or folder");
        }
    }
    Result<std::unique_ptr<Window>> window = Window::open(*size, "Frontbench");
    if (!window) return passOn(window);
    s.window = std::move(*window);
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(programFolder() / "shaders");
    if (!renderer) return passOn(renderer);
    s.workbench.renderer = std::move(*renderer);
    s.workbench.onFault = [&s](const Error& fault) { s.faults.hear(fault); };
    s.device = s.workbench.renderer->deviceName();
    if (!command.out.empty()) {
        if (Result<void> made = makeFolder(command.out); !made) return made;
        s.workbench.onRecord = [&s](const FrameRecord& record) { s.records.push_back(record); };
    }
    s.firstPath = command.path;
    openInputs(s, command.inputs);
    return {};
}

}  // namespace fb
