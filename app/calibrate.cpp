// The start of the feedback: fixed overhead O from drawing nothing, v_time from what more triangles add (thesis 4.2,
// footnote on the fixed overhead; algorithms 1, units).
#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "app/frame.h"
#include "control/model_device.h"
#include "measure/camera_path.h"

namespace fb {
namespace {

constexpr std::uint64_t kMostDraws = 1000;  // of nodes, in one picture
constexpr std::uint64_t kTrianglesToTime = 60000;  // enough to rise above the overhead, about 5 ms on two cores
constexpr double kFallbackVTimeMs = 1e-4;

Result<View> startView(const Workbench& w) {
    Result<CameraPath> still = loadPath("still", w.scene->info);
    if (!still) return passOn(still);
    return makeView(still->at(0.0), glm::dvec3(0.0), 1280, 720);
}

// Draws the front and waits for its time; negative when none arrives.
double timeOnce(Workbench& w, const View& view, std::span<const NodeId> front) {
    const DrawInput input{w.scene->hierarchy, front,     view, w.settings.draw,
                          w.effects,          glm::vec3(w.scene->info.upVector())};
    w.renderer->draw(input, 0);
    DrawTime time;
    for (int attempt = 0; attempt < 200; ++attempt) {
        if (w.renderer->takeTime(time) && time.frame == 0) return time.milliseconds;  // others are of a walk before
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return -1.0;
}

double timeMedian(Workbench& w, const View& view, std::span<const NodeId> front) {
    std::array<double, 5> times{};
    for (double& time : times) time = timeOnce(w, view, front);
    std::ranges::sort(times);
    return times[times.size() / 2];
}

double sumOfCosts(const Workbench& w, std::span<const NodeId> front) {
    double cost = 0.0;
    for (NodeId node : front) cost += nodeCost(w.scene->hierarchy, node, w.settings.select.cTextured);
    return cost;
}

// All roots, over and over until there are enough triangles: the repetitions cover the same pixels, so what they add is
// the time of triangles and not of filling the picture.
void calibrateByDrawing(Workbench& w, const View& view) {
    std::vector<NodeId> once;
    std::uint64_t triangles = 0;
    for (NodeId n = 0; n < w.scene->hierarchy.rootCount; ++n) {
        once.push_back(n);
        triangles += w.scene->hierarchy.triangles(n);
    }
    std::vector<NodeId> often;
    const std::uint64_t repetitions = 1 + std::min(kTrianglesToTime / std::max<std::uint64_t>(triangles, 1),
                                                   kMostDraws / std::max<std::uint64_t>(once.size(), 1));
    for (std::uint64_t i = 0; i <= repetitions; ++i) often.insert(often.end(), once.begin(), once.end());

    timeOnce(w, view, often);  // the first frame pays for compiling and paging in
    const double emptyMs = timeMedian(w, view, {});
    const double onceMs = timeMedian(w, view, once);
    const double oftenMs = timeMedian(w, view, often);
    w.control.overheadMs = std::max(0.0, emptyMs);
    const double marginal = (oftenMs - onceMs) / (sumOfCosts(w, often) - sumOfCosts(w, once));
    w.control.calibratedMs = marginal > 0.0 ? marginal : kFallbackVTimeMs;
}

void calibrateByModel(Workbench& w) {
    ModelSettings silent = w.settings.model;
    silent.noisePct = 0.0;
    FrameWork roots;
    double cost = 0.0;
    for (NodeId n = 0; n < w.scene->hierarchy.rootCount; ++n) {
        roots.texturedTriangles += w.scene->hierarchy.texturedTriangles[n];
        roots.untexturedTriangles += w.scene->hierarchy.untexturedTriangles[n];
        cost += nodeCost(w.scene->hierarchy, n, w.settings.select.cTextured);
        ++roots.nodes;
    }
    w.control.overheadMs = modelFrameMs(silent, {}, 0);
    const double marginal = (modelFrameMs(silent, roots, 0) - w.control.overheadMs) / cost;
    w.control.calibratedMs = marginal > 0.0 ? marginal : kFallbackVTimeMs;
}

}  // namespace

void calibrate(Workbench& w) {
    w.effects = decideEffects(w.settings.effects, w.sceneFacts, FrameFacts{});
    const Result<View> view = startView(w);
    if (w.clock == ClockKind::model || !view) {
        calibrateByModel(w);
    } else {
        calibrateByDrawing(w, *view);
    }
    w.control = startControl(w.control.calibratedMs, w.control.overheadMs);
}

}  // namespace fb
