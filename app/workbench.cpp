#include "app/workbench.h"

#include <algorithm>
#include <utility>

#include "app/frame.h"
#include "app/measure_frame.h"
#include "base/clock.h"
#include "control/model_device.h"

namespace fb {

Workbench::~Workbench() { closeScene(*this); }

void closeScene(Workbench& w) {
    w.loader.reset();
    if (w.scene) {
        for (NodeId node : w.residency.resident) w.device().release(node);
    }
    w.residency = {};
    w.plan = {};
    w.selection.clear();
    w.scene.reset();
}

namespace {

AppliedSettings settingsToFollow(const Settings& settings) {
    return {settings.select.cTextured, settings.select.hystStart, settings.control.vTimeStartMs,
            settings.control.overheadMs, settings.control.fillMsPerMegapixel};
}

// From what opening the scene measured and what the knobs say instead.
void restartControl(Workbench& w) {
    w.control = startControl(w.settings.control, w.control.measured, w.settings.select.cTextured);
}

}  // namespace

Result<void> openScene(Workbench& w, const std::filesystem::path& folder) {
    closeScene(w);
    Result<Scene> opened = openScene(folder);
    if (!opened) return passOn(opened);
    if (Result<void> fits = checkBudget(opened->hierarchy, w.settings.load); !fits) return fits;
    w.scene = std::make_unique<Scene>(std::move(*opened));
    w.sceneFacts = gatherSceneFacts(w.scene->hierarchy);
    w.residency.reset(w.scene->hierarchy);
    const bool content = w.renderer != nullptr;
    if (Result<void> loaded = loadRoots(*w.scene, w.device(), w.residency, content); !loaded) {
        closeScene(w);
        return loaded;
    }
    w.loader = w.clock == ClockKind::real ? startLoaderThread(*w.scene)
                                          : makeModelLoader(*w.scene, w.settings.model, content);
    calibrate(w);
    restartWalk(w);
    return {};
}

void restartWalk(Workbench& w) {
    if (w.renderer && w.frame > 0) waitForTimes(w);  // or they would be taken for the new walk's
    w.selectState.reset(w.scene->hierarchy, w.settings.select);
    w.applied = settingsToFollow(w.settings);
    w.inFront.assign(w.scene->hierarchy.size(), 0);
    w.selection.clear();
    w.plan.everythingLoaded = false;
    restartControl(w);
    w.history.clear();
    w.frame = 0;
    w.nowSeconds = 0.0;
    w.frontHash = 0;
    w.effectFrames = {};
    w.features = {};
    w.measured = {};
    w.effectWork = {};
    w.modelCounts = {};
    w.residency.counters = {};
    w.residency.peakBytes = w.residency.residentBytes;
    w.loaderBefore = w.loader->counters();
    w.timeline.start(w.scene->hierarchy);
    w.walkBeganSeconds = w.loader->nowSeconds();
    for (FrameRecord& record : w.pending) record.frame = 0;
}

void followSettings(Workbench& w) {
    const SelectSettings& now = w.settings.select;
    if (now.cTextured != w.applied.cTextured) {
        double before = 0.0, after = 0.0;
        for (NodeId n = 0; n < w.scene->hierarchy.rootCount; ++n) {
            before += nodeCost(w.scene->hierarchy, n, w.applied.cTextured);
            after += nodeCost(w.scene->hierarchy, n, now.cTextured);
        }
        rescaleCost(w.control, after / before);
    }
    if (now.hystStart != w.applied.hystStart) w.selectState.reset(w.scene->hierarchy, now);
    const AppliedSettings follow = settingsToFollow(w.settings);
    const AppliedSettings& before = w.applied;
    if (follow.vTimeStartMs != before.vTimeStartMs || follow.overheadMs != before.overheadMs ||
        follow.fillMsPerMegapixel != before.fillMsPerMegapixel) {
        restartControl(w);
    }
    followCostModel(w.control, w.settings.control.costModel, now.cTextured);
    w.applied = follow;
}

double nearMetres(const Workbench& w) {
    const double knob = w.settings.draw.nearMetres;
    return w.scene ? std::min(knob, w.scene->info.bounds.diagonal() / 2048.0) : knob;
}

void settle(Workbench& w, const FrameInput& input, double limitSeconds) {
    FrameInput resting = input;
    resting.velocity = glm::dvec3(0.0);
    // Two quiet frames in a row: a plan may wish for more as soon as a group has arrived.
    int quiet = 0;
    const auto heard = std::exchange(w.onRecord, nullptr);
    const SteadyClock::time_point start = SteadyClock::now();
    for (double waited = 0.0; waited < limitSeconds && quiet < 2; waited += input.dtSeconds) {
        runFrame(w, resting);
        // The loader lives in real time.
        if (w.clock == ClockKind::real) sleepUntil(start, waited + input.dtSeconds);
        quiet = w.residency.inFlight.empty() ? quiet + 1 : 0;
    }
    if (w.renderer) waitForTimes(w);
    const ControlState learnt = w.control;  // a walk that begins settled begins with what the device has shown
    restartWalk(w);
    w.control = learnt;
    w.onRecord = heard;
}

}  // namespace fb
