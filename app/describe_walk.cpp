#include "app/describe_walk.h"

#include <limits>

#include "measure/loads_csv.h"
#include "settings/knob_table.h"

namespace fb {
namespace {

std::string_view modeName(EffectMode mode) {
    static constexpr std::string_view names[] = {"off", "on", "auto"};
    return names[static_cast<std::size_t>(mode)];
}

}  // namespace

ReplayReport describeWalk(const Workbench& w, const WalkNames& names, std::vector<FrameRecord> records) {
    ReplayReport report;
    report.version = FB_VERSION;
    report.scene = w.scene->info.name;
    report.preset = names.preset;
    report.policy = policyOf(w.settings.select.policy).name;
    report.path = names.path;
    report.clock = w.clock == ClockKind::model ? "model" : "real";
    report.device = w.clock == ClockKind::model ? "simulated" : w.renderer->deviceName();
    report.sceneHash = w.scene->sceneHash;
    report.settingsHash = settingsHash(w.settings);
    report.targetMs = w.settings.control.targetMs;
    report.levels = w.scene->hierarchy.maxLevel() + 1;
    report.frames = std::move(records);
    report.loads = w.residency.counters;
    const LoaderCounters loader = w.loader->counters();
    report.loads.suspended = loader.suspended - w.loaderBefore.suspended;
    report.loads.bytes = loader.bytesRead - w.loaderBefore.bytesRead;
    report.loads.seeks = loader.seeks - w.loaderBefore.seeks;
    report.prefetch = w.timeline.score();
    report.loadsCsv = loadsCsv(w.scene->hierarchy, w.timeline.records(), w.walkBeganSeconds);
    report.pinnedBytes = pinnedBytes(w.scene->hierarchy);
    report.budgetBytes = budgetBytes(w.settings.load);
    report.peakBytes = w.residency.peakBytes;
    for (const EffectRow& row : effectTable()) {
        // Their time is not measured one by one: null in the report.
        report.effects.push_back({std::string(row.name), std::string(modeName(row.mode(w.settings.effects))),
                                  w.effectFrames[static_cast<std::size_t>(row.effect)],
                                  std::numeric_limits<double>::quiet_NaN(), w.effectWork[row.effect]});
    }
    return report;
}

}  // namespace fb
