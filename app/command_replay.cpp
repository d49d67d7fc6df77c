// `frontbench replay`: walks a path without a window and writes what was measured (design section 7).
#include <cstdio>
#include <thread>

#include "app/commands.h"
#include "app/describe_walk.h"
#include "app/fault_log.h"
#include "app/frame.h"
#include "app/guarded_child.h"
#include "app/headless.h"
#include "app/option_text.h"
#include "app/save_picture.h"
#include "base/clock.h"
#include "measure/camera_path.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {
namespace {

constexpr double kSettleSeconds = 60.0;

// What a replay needs beside the workbench; the context must be declared before the workbench that draws with it.
struct Replay {
    std::unique_ptr<OffscreenContext> context;
    Workbench workbench;
    CameraPath path;
    FaultLog faults{[](const Error& fault) { std::fprintf(stderr, "frontbench: %s\n", fault.oneLine().c_str()); }};
    glm::ivec2 size{1280, 720};
    std::uint64_t frames = 0;
};

Result<void> readSettings(const ReplayCommand& command, Settings& settings) {
    Result<Preset> preset = loadPreset(command.preset);
    if (!preset) return passOn(preset);
    settings = preset->settings;
    const std::vector<std::string>& sets = command.sets;
    if (Result<void> taken = applySets(settings, sets); !taken || command.policy.empty()) return taken;
    Result<void> taken = setFromText(settings, "select.policy", command.policy, "--policy");
    if (!taken) taken.error().kind = Error::Kind::usage;
    return taken;
}

Result<void> prepare(const ReplayCommand& command, Replay& replay) {
    Workbench& w = replay.workbench;
    if (Result<void> read = readSettings(command, w.settings); !read) return read;
    Result<ClockKind> clock = parseClock(command.clock);
    if (!clock) return passOn(clock);
    w.clock = *clock;
    w.onFault = [&replay](const Error& fault) { replay.faults.hear(fault); };
    Result<glm::ivec2> size = parseSize(command.size);
    if (!size) return passOn(size);
    replay.size = *size;
    if (command.out.empty()) return usageFailure("--out", "must name a folder");
    if (Result<void> made = makeFolder(command.out); !made) return made;
    Result<void> opened = openHeadless(w, replay.context, command.scene, command.screenshots > 0);
    if (!opened) return opened;
    Result<CameraPath> path = loadPath(command.path, w.scene->info);
    if (!path) return passOn(path);
    replay.path = std::move(*path);
    const auto whole = static_cast<std::uint64_t>(replay.path.durationSeconds() * w.settings.model.rateHz);
    replay.frames = command.frames > 0 ? command.frames : std::max<std::uint64_t>(whole, 1);
    return {};
}

FrameInput inputAt(const Replay& replay, double seconds) {
    const Workbench& w = replay.workbench;
    FrameInput input;
    input.camera = replay.path.at(seconds);
    input.camera.fovyRadians = glm::radians(w.settings.draw.fovyDegrees);
    input.camera.nearMetres = nearMetres(w);
    input.velocity = replay.path.velocityAt(seconds);
    input.dtSeconds = 1.0 / w.settings.model.rateHz;
    input.width = replay.size.x;
    input.height = replay.size.y;
    return input;
}

// Whether frame i of n is one of the `pictures` frames spread over the walk; the last frame always is.
bool isPictured(std::uint64_t i, std::uint64_t frames, std::uint64_t pictures) {
    if (pictures == 0) return false;
    return (i + 1) * pictures / frames != i * pictures / frames;
}

Result<void> walk(const ReplayCommand& command, Replay& replay) {
    Workbench& w = replay.workbench;
    const double stepSeconds = 1.0 / w.settings.model.rateHz;
    watchForStop();
    if (command.settle) settle(w, inputAt(replay, 0.0), kSettleSeconds);
    const SteadyClock::time_point start = SteadyClock::now();
    for (std::uint64_t i = 0; i < replay.frames; ++i) {
        if (stopWanted()) return failure({}, "frame " + std::to_string(i), "stopped");
        runFrame(w, inputAt(replay, static_cast<double>(i) * stepSeconds));
        if (isPictured(i, replay.frames, command.screenshots)) {
            char name[32];
            std::snprintf(name, sizeof name, "frame%06llu.png", static_cast<unsigned long long>(i));
            if (Result<void> saved = savePicture(w.renderer->readPicture(), command.out / name); !saved) return saved;
        }
        // The loader lives in real time: the walk must not outrun it.
        if (w.clock == ClockKind::real) sleepUntil(start, static_cast<double>(i + 1) * stepSeconds);
    }
    waitForTimes(w);
    replay.faults.flush();
    return {};
}

}  // namespace

Result<void> runReplay(const ReplayCommand& command) {
    Replay replay;
    if (Result<void> ready = prepare(command, replay); !ready) return ready;
    std::vector<FrameRecord> records;
    records.reserve(std::min<std::uint64_t>(replay.frames, 100000));
    replay.workbench.onRecord = [&records](const FrameRecord& record) { records.push_back(record); };
    if (Result<void> walked = walk(command, replay); !walked) return walked;
    const ReplayReport report = describeWalk(replay.workbench, {command.preset, command.path}, std::move(records));
    if (Result<void> written = writeReport(report, command.out); !written) return written;
    std::printf("%s\n", (command.out / "summary.json").string().c_str());
    return {};
}

}  // namespace fb
