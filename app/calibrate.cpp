// The start of the feedback: fixed overhead O from drawing nothing, v_time from what more triangles add (thesis 4.2,
// footnote on the fixed overhead; algorithms 1, units). Only roots are in memory then, so they are drawn repeatedly;
// `frontbench calibrate` holds fronts of different levels against each other.
#include "app/time_fronts.h"
#include "control/model_device.h"

namespace fb {
namespace {

constexpr double kFallbackVTimeMs = 1e-4;
constexpr glm::ivec2 kPicture(1280, 720);

void calibrateByDrawing(Workbench& w, const View& view) {
    std::vector<NodeId> roots(w.scene->hierarchy.rootCount);
    for (NodeId n = 0; n < roots.size(); ++n) roots[n] = n;
    const TimedFronts fronts{{view}, {{0, {}}, {0, roots}, {0, repeated(w.scene->hierarchy, roots)}}};
    const Result<std::vector<FrontTimes>> times = timeFronts(w, fronts, {});
    const std::vector<FrontTimes> none;
    const std::optional<Estimate> overhead = fitOverhead(times ? *times : none);
    const std::optional<Estimate> vTime = fitVTime(times ? *times : none);
    const std::optional<Estimate> fill = fitFill(times ? *times : none);
    w.control.measured = {vTime ? vTime->value : kFallbackVTimeMs, overhead ? overhead->value : 0.0,
                          fill ? fill->value : 0.0};
}

}  // namespace

void calibrateByModel(Workbench& w) {
    const Hierarchy& hierarchy = w.scene->hierarchy;
    FrameWork roots;
    double cost = 0.0;
    for (NodeId n = 0; n < hierarchy.rootCount; ++n) {
        roots.texturedTriangles += hierarchy.texturedTriangles[n];
        roots.untexturedTriangles += hierarchy.untexturedTriangles[n];
        cost += nodeCost(hierarchy, n, w.settings.select.cTextured);
        ++roots.nodes;
    }
    const double vTimeMs = modelDrawMs(w.settings.model, roots) / cost;
    w.control.measured = {vTimeMs > 0.0 ? vTimeMs : kFallbackVTimeMs, w.settings.model.overheadMs,
                          w.settings.model.fillMsPerMegapixel};
}

void calibrate(Workbench& w) {
    w.effects = decideEffects(w.settings.effects, w.sceneFacts, FrameFacts{});
    if (w.knownConstants) {
        w.control.measured = *w.knownConstants;
        return;
    }
    const Result<CameraPath> still = loadPath("still", w.scene->info);
    if (w.clock == ClockKind::model || !still) return calibrateByModel(w);
    calibrateByDrawing(w, viewAlong(w, *still, 0.0, kPicture));
}

}  // namespace fb
