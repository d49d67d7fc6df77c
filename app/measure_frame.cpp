#include "app/measure_frame.h"

#include <chrono>
#include <thread>

#include "control/model_device.h"
#include "select/coverage.h"

namespace fb {
namespace {

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

}  // namespace

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

void waitForTimes(Workbench& w) {
    for (int attempt = 0; attempt < 100 && w.clock == ClockKind::real; ++attempt) {
        measureFrame(w);
        if (!w.history.size() || w.history.newest().frame == w.frame) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace fb
