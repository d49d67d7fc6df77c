#include "app/frame.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/clock.h"
#include "control/model_device.h"
#include "select/coverage.h"
#include "select/screen_error.h"

namespace fb {
namespace {

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

void decideFrameEffects(Workbench& w, const FrameInput& input, FrameRecord& record) {
    FrameFacts facts;
    facts.speedMetresPerSecond = record.speedMetresPerSecond;
    facts.everythingLoaded = w.plan.everythingLoaded;
    facts.policyUsesShareTime = policyOf(w.settings.select.policy).usesShareTime;
    facts.policyHasCounters = policyOf(w.settings.select.policy).hasCounters;
    facts.slicesUnused = w.selection.counters.boundBy[static_cast<std::size_t>(BoundBy::leaf)] > 0;
    facts.fillShare = w.control.fillMsPerMegapixel * 1e-6 * input.width * input.height / w.settings.control.targetMs;
    facts.residentTextureBytes = w.residency.residentTextureBytes;
    facts.textureBudgetBytes = textureBudgetBytes(w.settings.load);
    w.effects = decideEffects(w.settings.effects, w.sceneFacts, facts);
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        if (!w.effects.on[i]) continue;
        record.effectsOn |= std::uint64_t{1} << i;
        ++w.effectFrames[i];
    }
}

void takeLoads(Workbench& w, FrameRecord& record) {
    const ScopedMilliseconds timer(record.uploadMs);
    w.loader->advance(record.dtMs / 1000.0);
    const UploadInput upload{w.scene->hierarchy, w.settings.load, w.nowSeconds, w.onFault};
    record.uploadBytes = takeFinishedLoads(upload, *w.loader, w.device(), w.residency);
}

// Before the selection: what is evicted here is gone from the snapshot that the selection reads.
void planFrameLoads(Workbench& w, const View& view, FrameRecord& record) {
    const ScopedMilliseconds timer(record.planMs);
    const PlanInput input{w.scene->hierarchy, view,      w.settings.select, w.settings.load,
                          w.effects,          w.inFront, w.nowSeconds};
    planLoads(input, w.residency, w.plan);
    for (NodeId node : w.plan.evicted) w.device().release(node);
    w.loader->publish(w.plan.wishes, w.settings.load);
    record.evictions = static_cast<std::uint32_t>(w.plan.evicted.size());
    record.pendingLoads = static_cast<std::uint32_t>(w.residency.inFlight.size());
    record.residentBytes = w.residency.residentBytes;
    record.reservedBytes = w.residency.reservedBytes;
    record.budgetBytes = budgetBytes(w.settings.load);
}

// What this frame's selection estimates with.
TimeModel timesOfFrame(Workbench& w, const View& view, FrameRecord& record) {
    passTime(w.control, w.settings.control, record.dtMs / 1000.0, w.selectState.patience);
    if (w.effects[Effect::fillRate]) {
        record.effectWork[Effect::fillRate] += w.scene->hierarchy.rootCount;
        record.megapixels = megapixelsOfRoots(w.scene->hierarchy, view);
    }
    const TexturePressure pressure{w.residency.residentTextureBytes, textureBudgetBytes(w.settings.load)};
    return timeModel(w.control, w.settings.control, w.settings.select.cTextured, record.megapixels,
                     w.effects[Effect::texturePressure] ? &pressure : nullptr);
}

void chooseFront(Workbench& w, const View& view, FrameRecord& record) {
    const SteadyClock::time_point start = SteadyClock::now();
    for (NodeId node : w.selection.front) w.inFront[node] = 0;
    const SelectInput input{w.scene->hierarchy,
                            w.residency.loaded,
                            w.residency.memoryRefused,
                            view,
                            w.settings.select,
                            w.effects,
                            timesOfFrame(w, view, record),
                            shareMs(w.control, w.settings.control),
                            w.settings.control.targetMs,
                            record.dtMs / 1000.0,
                            w.frame,
                            w.measured};
    record.fixedMs = input.time.fixedMs;
    selectFront(input, w.selectState, w.selection);
    w.features.push(featuresOf(input, w.selection, record.megapixels));
    for (NodeId node : w.selection.front) w.inFront[node] = 1;
    record.selectUs = 1000.0 * millisecondsSince(start);
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
    for (std::size_t i = 0; i < kEffectCount; ++i)
        record.effectWork.count[i] += s.counters.effectWork.count[i] + w.plan.groups.effectWork.count[i];
    if (w.effects[Effect::shareFeedback]) ++record.effectWork[Effect::shareFeedback];
    for (std::size_t i = 0; i < kEffectCount; ++i) w.effectWork.count[i] += record.effectWork.count[i];
}

void drawFront(Workbench& w, const View& view, FrameRecord& record) {
    if (!w.renderer) return;
    const ScopedMilliseconds timer(record.drawCpuMs);
    const DrawInput input{w.scene->hierarchy,  w.selection.front, view,
                          w.settings.draw,     w.effects,         glm::vec3(w.scene->info.upVector())};
    w.renderer->draw(input, w.frame);
    if (!w.renderer->fault().empty()) {
        record.frame = 0;  // not drawn: its time says nothing
        if (w.onFault) w.onFault({Error::Kind::failed, "drawing", {}, w.renderer->fault(), {}});
    }
}

void feedBackTime(Workbench& w, std::uint64_t frame, double actualMs) {
    const FrameFeatures* features = w.features.find(frame);
    FrameRecord& record = w.pending[frame % w.pending.size()];
    if (!features || record.frame != frame) return;  // too late to be of use
    record.actualMs = actualMs;
    feedBack(w.control, w.settings.control, *features, actualMs);
    w.measured = {features->triangles, actualMs};
    record.infeasible = w.control.infeasible;
    w.history.push(record);
    if (w.onRecord) w.onRecord(record);
    record.frame = 0;  // a second time for it would be another's
}

void measureFrame(Workbench& w) {
    DrawTime time;
    if (w.clock == ClockKind::real) {
        while (w.renderer->takeTime(time)) feedBackTime(w, time.frame, time.milliseconds);
        return;
    }
    while (w.renderer && w.renderer->takeTime(time)) continue;  // model time counts, not the pictures'
    const Selection& s = w.selection;
    const ModelSettings& model = w.settings.model;
    const FrameRecord& record = w.pending[w.frame % w.pending.size()];
    const double megapixels = model.fillMsPerMegapixel > 0.0 ? coveredMegapixels(w.scene->hierarchy, s.front, w.view) : 0.0;
    const FrameWork work = modelWork(model, w.scene->hierarchy, s.front, megapixels, record.uploadBytes, w.modelCounts);
    feedBackTime(w, w.frame, modelFrameMs(model, work, w.frame, w.modelCounts));
}

}  // namespace

void runFrame(Workbench& w, const FrameInput& input) {
    followSettings(w);
    FrameRecord& record = beginRecord(w, input);
    const View& view = w.view = makeView(input.camera, input.velocity, input.width, input.height);
    decideFrameEffects(w, input, record);
    takeLoads(w, record);
    planFrameLoads(w, view, record);
    chooseFront(w, view, record);
    recordSelection(w, view, record);
    drawFront(w, view, record);
    measureFrame(w);
}

void waitForTimes(Workbench& w) {
    for (int attempt = 0; attempt < 100 && w.clock == ClockKind::real; ++attempt) {
        measureFrame(w);
        if (!w.history.size() || w.history.newest().frame == w.frame) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace fb
