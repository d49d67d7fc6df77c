#include "app/frame.h"

#include "app/measure_frame.h"
#include "app/record_frame.h"
#include "base/clock.h"
#include "select/coverage.h"

namespace fb {
namespace {

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
    const double limitMs = w.clock == ClockKind::real ? w.settings.load.uploadMs : 0.0;
    const UploadInput upload{w.scene->hierarchy, w.settings.load, w.nowSeconds, w.onFault, limitMs, &w.timeline};
    record.uploadBytes = takeFinishedLoads(upload, *w.loader, w.device(), w.residency);
}

// Before the selection: what is evicted here is gone from the snapshot that the selection reads.
void planFrameLoads(Workbench& w, const View& view, FrameRecord& record) {
    const ScopedMilliseconds timer(record.planMs);
    const PlanInput input{w.scene->hierarchy, view,      w.settings.select, w.settings.load,
                          w.effects,          w.inFront, w.nowSeconds};
    planLoads(input, w.residency, w.plan);
    for (NodeId node : w.plan.evicted) w.device().release(node);
    w.timeline.notePlan(w.plan, w.loader->nowSeconds());
    w.loader->publish(w.plan.wishes, w.settings.load);
    record.evictions = static_cast<std::uint32_t>(w.plan.evicted.size());
    record.pendingLoads = static_cast<std::uint32_t>(w.residency.inFlight.size());
    record.residentBytes = w.residency.residentBytes;
    record.reservedBytes = w.residency.reservedBytes;
    record.textureBytes = w.residency.residentTextureBytes;
    const double cTextured = w.settings.select.cTextured;
    record.estimateBytes = w.settings.load.cMemory * (cTextured * static_cast<double>(w.residency.texturedTriangles) +
                                                      (1.0 - cTextured) * static_cast<double>(w.residency.untexturedTriangles));
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

DrawCounters drawFront(Workbench& w, const View& view, FrameRecord& record) {
    if (!w.renderer) return {};
    const ScopedMilliseconds timer(record.drawCpuMs);
    const DrawInput input{w.scene->hierarchy,  w.selection.front, view,
                          w.settings.draw,     w.effects,         glm::vec3(w.scene->info.upVector())};
    const DrawCounters drawn = w.renderer->draw(input, w.frame);
    if (!w.renderer->fault().empty()) {
        record.frame = 0;  // not drawn: its time says nothing
        if (w.onFault) w.onFault({Error::Kind::failed, "drawing", {}, w.renderer->fault(), {}});
    }
    return drawn;
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
    w.timeline.noteSelection(w.selection, w.residency, w.loader->nowSeconds());
    recordSelection(w, view, record);
    recordEffectWork(w, drawFront(w, view, record), record);
    measureFrame(w);
}

}  // namespace fb
