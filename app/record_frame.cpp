#include "app/record_frame.h"

#include <algorithm>

#include "select/screen_error.h"

namespace fb {

FrameRecord& beginRecord(Workbench& w, const FrameInput& input) {
    ++w.frame;
    const double dt = std::clamp(input.dtSeconds, 0.0, 0.1);
    w.nowSeconds += dt;
    FrameRecord& record = w.pending[w.frame % w.pending.size()];
    record = {};
    record.frame = w.frame;
    record.timeSeconds = w.nowSeconds;
    record.dtMs = 1000.0 * dt;
    record.eye = input.camera.eye;
    record.speedMetresPerSecond = glm::length(input.velocity);
    record.targetMs = w.settings.control.targetMs;
    record.uiMs = w.lastUiMs;
    return record;
}

void recordSelection(Workbench& w, const View& view, FrameRecord& record) {
    const Selection& s = w.selection;
    w.frontHash = chainFrontHash(w.frontHash, s.front);
    record.frontHash = w.frontHash;
    record.frontNodes = static_cast<std::uint32_t>(s.front.size());
    for (NodeId n : s.front) ++record.levels[std::min<std::size_t>(w.scene->hierarchy.level[n], kMaxLevels - 1)];
    record.triangles = s.triangles;
    record.visited = s.counters.visited;
    record.togglesUp = s.counters.togglesUp;
    record.togglesDown = s.counters.togglesDown;
    record.pingPongs = s.counters.pingPongs;
    std::copy(std::begin(s.counters.boundBy), std::end(s.counters.boundBy), record.boundBy.begin());
    const auto boundBy = [&](BoundBy reason) { return record.boundBy[static_cast<std::size_t>(reason)]; };
    record.moreDetailAvailable = boundBy(BoundBy::leaf) + boundBy(BoundBy::view) < record.frontNodes;
    record.refusedGroups = s.counters.refusedGroups;
    record.skippedRoots = s.counters.skippedRoots;
    w.seenFront.clear();
    for (const Reached& r : s.reached) {
        if (r.expanded) continue;
        record.refusedNeedMs += r.needMs;
        // A node whose children are all out of view shows nothing of itself but its box.
        if (r.boundBy != BoundBy::view) w.seenFront.push_back(r.node);
    }
    const FrontError error = frontError(w.scene->hierarchy, w.seenFront, view);
    record.errorPixelsMax = error.maxPixels;
    record.errorPixelsMean = error.meanPixels;
    record.overheadMs = w.control.overheadMs;
    record.vTimeMs = w.control.vTimeMs;
    record.shareMs = shareMs(w.control, w.settings.control);
    record.estimateMs = s.estimateMs;
}

void recordEffectWork(Workbench& w, const DrawCounters& drawn, FrameRecord& record) {
    record.effectWork[Effect::texturing] = drawn.texturedDraws;
    record.effectWork[Effect::lighting] = drawn.litDraws;
    if (w.effects[Effect::shareFeedback]) ++record.effectWork[Effect::shareFeedback];
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        record.effectWork.count[i] += w.selection.counters.effectWork.count[i] + w.plan.groups.effectWork.count[i];
        w.effectWork.count[i] += record.effectWork.count[i];
    }
}

}  // namespace fb
