#include "app/workbench.h"

#include <algorithm>
#include <utility>

#include "app/frame.h"
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
    w.selectState.reset(w.scene->hierarchy, w.settings.select);
    w.inFront.assign(w.scene->hierarchy.size(), 0);
    w.selection.clear();
    w.plan.everythingLoaded = false;
    w.control = startControl(w.control.calibratedMs, w.control.overheadMs);
    w.history.clear();
    w.frame = 0;
    w.nowSeconds = 0.0;
    w.frontHash = 0;
    w.effectFrames = {};
    for (FrameRecord& record : w.pending) record.frame = 0;
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
    for (double waited = 0.0; waited < limitSeconds && quiet < 2; waited += input.dtSeconds) {
        runFrame(w, resting);
        quiet = w.residency.inFlight.empty() ? quiet + 1 : 0;
    }
    w.onRecord = heard;
    restartWalk(w);
}

}  // namespace fb
