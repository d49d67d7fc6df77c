// `frontbench replay`: walks a path without a window and writes what was measured (design section 7).
#include <cstdio>

#include "app/commands.h"
#include "app/describe_walk.h"
#include "app/fault_log.h"
#include "app/headless.h"
#include "app/option_text.h"
#include "app/save_picture.h"
#include "app/walk_path.h"
#include "base/file_io.h"
#include "measure/front_csv.h"

namespace fb {
namespace {

// What a replay needs beside the workbench; the context must be declared before the workbench that draws with it.
struct Replay {
    std::unique_ptr<OffscreenContext> context;
    Workbench workbench;
    WalkPlan plan;
    FaultLog faults{[](const Error& fault) { std::fprintf(stderr, "frontbench: %s\n", fault.oneLine().c_str()); }};
};

Result<void> prepare(const ReplayCommand& command, Replay& replay) {
    Workbench& w = replay.workbench;
    Result<glm::ivec2> size = takeOptions(w, command.headless);
    if (!size) return passOn(size);
    if (!command.policy.empty()) {
        if (Result<void> taken = takePolicy(w.settings, command.policy); !taken) return taken;
    }
    w.onFault = [&replay](const Error& fault) { replay.faults.hear(fault); };
    if (command.out.empty()) return usageFailure("--out", "must name a folder");
    if (Result<void> made = makeFolder(command.out); !made) return made;
    Result<void> opened = openHeadless(w, replay.context, command.headless.scene, command.screenshots > 0);
    if (!opened) return opened;
    Result<WalkPlan> plan = planWalk(w, command.path, *size, command.frames, command.settle);
    if (!plan) return passOn(plan);
    replay.plan = std::move(*plan);
    return {};
}

// Whether frame i of n is one of the `pictures` frames spread over the walk; the last frame always is.
bool isPictured(std::uint64_t i, std::uint64_t frames, std::uint64_t pictures) {
    if (pictures == 0) return false;
    return (i + 1) * pictures / frames != i * pictures / frames;
}

Result<void> walk(const ReplayCommand& command, Replay& replay) {
    Result<void> walked = walkPath(replay.workbench, replay.plan, [&](std::uint64_t i) -> Result<void> {
        if (!isPictured(i, replay.plan.frames, command.screenshots)) return {};
        char name[32];
        std::snprintf(name, sizeof name, "frame%06llu.png", static_cast<unsigned long long>(i));
        return savePicture(replay.workbench.renderer->readPicture(), command.out / name);
    });
    replay.faults.flush();
    return walked;
}

}  // namespace

Result<void> runReplay(const ReplayCommand& command) {
    Replay replay;
    if (Result<void> ready = prepare(command, replay); !ready) return ready;
    std::vector<FrameRecord> records;
    records.reserve(std::min<std::uint64_t>(replay.plan.frames, 100000));
    replay.workbench.onRecord = [&records](const FrameRecord& record) { records.push_back(record); };
    if (Result<void> walked = walk(command, replay); !walked) return walked;
    const ReplayReport report = describeWalk(replay.workbench, {command.headless.preset, command.path}, std::move(records));
    if (Result<void> written = writeReport(report, command.out); !written) return written;
    const Workbench& w = replay.workbench;
    const std::string front = frontCsv(w.scene->hierarchy, w.selection.reached, w.residency.loaded, w.view);
    if (Result<void> written = writeFileAtomically(command.out / "front.csv", front); !written) return written;
    std::printf("%s\n", (command.out / "summary.json").string().c_str());
    return {};
}

}  // namespace fb
