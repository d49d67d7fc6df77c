// `frontbench compare`: every policy on every path at every target, each walk from the roots alone, in rounds.
#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/fault_log.h"
#include "app/headless.h"
#include "app/option_text.h"
#include "app/progress_display.h"
#include "app/walk_path.h"
#include "base/file_io.h"
#include "measure/comparison.h"
#include "settings/knob_table.h"

namespace fb {
namespace {

struct Comparison {
    std::unique_ptr<OffscreenContext> context;
    Workbench workbench;
    std::filesystem::path scene;
    glm::ivec2 size{1280, 720};
    FaultLog faults{[](const Error& fault) { std::fprintf(stderr, "frontbench: %s\n", fault.oneLine().c_str()); }};
    std::vector<ComparedWalk> walks;
};

std::vector<std::string> chosenPolicies(const CompareCommand& command) {
    if (!command.policies.empty()) return command.policies;
    std::vector<std::string> all;
    for (const Policy& policy : policies()) all.emplace_back(policy.name);
    return all;
}

Result<void> prepare(const CompareCommand& command, Comparison& comparison) {
    Workbench& w = comparison.workbench;
    Result<glm::ivec2> size = takeOptions(w, command.headless);
    if (!size) return passOn(size);
    comparison.size = *size;
    w.onFault = [&comparison](const Error& fault) { comparison.faults.hear(fault); };
    if (command.out.empty()) return usageFailure("--out", "must name a folder");
    if (Result<void> made = makeFolder(command.out); !made) return made;
    Settings tried = w.settings;  // every name and number is looked at before the first walk
    for (const std::string& policy : chosenPolicies(command)) {
        if (Result<void> taken = takePolicy(tried, policy); !taken) return taken;
    }
    std::vector<double> targets = command.targets;
    if (targets.empty()) targets.push_back(w.settings.control.targetMs);
    for (const double target : targets) {
        if (Result<void> taken = admit(tried, *findKnob("control.target_ms"), target, "--target"); !taken) {
            taken.error().kind = Error::Kind::usage;
            return taken;
        }
    }
    if (Result<void> opened = openHeadless(w, comparison.context, command.headless.scene, false); !opened) return opened;
    comparison.scene = w.scene->folder;
    w.knownConstants = w.control.measured;  // the same for all
    for (const std::string& path : command.paths) {
        if (Result<WalkPlan> plan = planWalk(w, path, comparison.size, command.frames, false); !plan) return passOn(plan);
        for (const double target : targets) {
            for (const std::string& policy : chosenPolicies(command)) comparison.walks.push_back({policy, path, target, {}});
        }
    }
    return {};
}

Result<void> walkOnce(const CompareCommand& command, Comparison& comparison, ComparedWalk& walk) {
    Workbench& w = comparison.workbench;
    if (Result<void> taken = takePolicy(w.settings, walk.policy); !taken) return taken;
    w.settings.control.targetMs = walk.targetMs;
    if (Result<void> opened = openScene(w, comparison.scene); !opened) return opened;
    Result<WalkPlan> plan = planWalk(w, walk.path, comparison.size, command.frames, command.settle);
    if (!plan) return passOn(plan);
    w.onRecord = [&walk](const FrameRecord& record) { walk.frames.push_back(record); };
    Result<void> walked = walkPath(w, *plan, {});
    w.onRecord = {};
    return walked;
}

}  // namespace

Result<void> runCompare(const CompareCommand& command) {
    Comparison comparison;
    if (Result<void> ready = prepare(command, comparison); !ready) return ready;
    const Progress progress = showProgress(ProgressStyle::automatic);
    const std::size_t count = comparison.walks.size(), all = count * command.rounds;
    for (std::size_t i = 0; i < all; ++i) {
        // There and back again: what drifts falls on all alike.
        const std::size_t at = (i / count) % 2 == 0 ? i % count : count - 1 - i % count;
        ComparedWalk& walk = comparison.walks[at];
        const std::string what = walk.policy + ", " + walk.path;
        if (!progress(what, static_cast<double>(i) / static_cast<double>(all))) return failure({}, what, "stopped");
        if (Result<void> walked = walkOnce(command, comparison, walk); !walked) return walked;
    }
    endProgress(ProgressStyle::automatic);
    comparison.faults.flush();
    const std::filesystem::path file = command.out / "compare.csv";
    if (Result<void> written = writeFileAtomically(file, comparisonCsv(comparison.walks)); !written) return written;
    std::printf("%s%s\n", comparisonTable(comparison.walks).c_str(), file.string().c_str());
    return {};
}

}  // namespace fb
