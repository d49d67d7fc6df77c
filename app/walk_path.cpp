#include "app/walk_path.h"

#include <algorithm>

#include "app/guarded_child.h"
#include "app/measure_frame.h"
#include "base/clock.h"

namespace fb {
namespace {

constexpr double kSettleSeconds = 60.0;

FrameInput inputAt(const Workbench& w, const WalkPlan& plan, double seconds) {
    FrameInput input;
    input.camera = plan.path.at(seconds);
    input.camera.fovyRadians = glm::radians(w.settings.draw.fovyDegrees);
    input.camera.nearMetres = nearMetres(w);
    input.velocity = plan.path.velocityAt(seconds);
    input.dtSeconds = 1.0 / w.settings.model.rateHz;
    input.width = plan.size.x;
    input.height = plan.size.y;
    return input;
}

}  // namespace

Result<WalkPlan> planWalk(const Workbench& w, const std::string& name, glm::ivec2 size, std::uint64_t frames, bool settle) {
    Result<CameraPath> path = loadPath(name, w.scene->info);
    if (!path) return passOn(path);
    WalkPlan plan{std::move(*path), size, frames, settle};
    const auto whole = static_cast<std::uint64_t>(plan.path.durationSeconds() * w.settings.model.rateHz);
    if (frames == 0) plan.frames = std::max<std::uint64_t>(whole, 1);
    return plan;
}

Result<void> walkPath(Workbench& w, const WalkPlan& plan, const std::function<Result<void>(std::uint64_t)>& afterFrame) {
    const double stepSeconds = 1.0 / w.settings.model.rateHz;
    watchForStop();
    if (plan.settle) settle(w, inputAt(w, plan, 0.0), kSettleSeconds);
    const SteadyClock::time_point start = SteadyClock::now();
    for (std::uint64_t i = 0; i < plan.frames; ++i) {
        if (stopWanted()) return failure({}, "frame " + std::to_string(i), "stopped");
        runFrame(w, inputAt(w, plan, static_cast<double>(i) * stepSeconds));
        if (afterFrame) {
            if (Result<void> heard = afterFrame(i); !heard) return heard;
        }
        // The loader lives in real time: the walk must not outrun it.
        if (w.clock == ClockKind::real) sleepUntil(start, static_cast<double>(i + 1) * stepSeconds);
    }
    waitForTimes(w);
    return {};
}

}  // namespace fb
