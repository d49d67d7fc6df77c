#include "select/frontbench_marks.h"

#include <algorithm>

namespace fb {
namespace {

constexpr double kEmergencyMargins = 3.0, kMostHighMark = 1.05;
// Time above the target is late now and then; time below it lacks in every frame. At rest nothing lacks as much as calm.
constexpr double kMiddleLess = 0.75;

}  // namespace

// Over seconds the device is as fast as it was over seconds; in an emergency, as it was just now.
FrontbenchMarks frontbenchMarks(const SelectInput& input, double nowMs, double patience) {
    const SelectSettings& s = input.settings;
    const double target = input.targetMs;
    // What the estimate cannot tell from noise must switch nothing.
    const double marginMs = patience * s.margin * input.time.residualMs;
    const auto mark = [&](double of) { return target * (1.0 + patience * (of - 1.0)); };
    FrontbenchMarks marks;
    marks.totalMs = nowMs * input.time.slowRatio;
    marks.middleMs = target - (patience - kMiddleLess) * s.margin * input.time.residualMs;
    const double emergencyMs = std::max(mark(s.emergencyMark), target + kEmergencyMargins * marginMs);
    if (nowMs > emergencyMs) marks.totalMs = std::max(marks.totalMs, nowMs);
    const double limitMs = std::clamp(target + marginMs, mark(s.highMark), mark(std::max(kMostHighMark, s.highMark)));
    marks.tooMuch = marks.totalMs > limitMs;
    // Time is spent only where it is there over seconds and right now.
    if (!marks.tooMuch) marks.totalMs = std::max(marks.totalMs, nowMs);
    marks.scale = nowMs > 0.0 ? marks.totalMs / nowMs : 1.0;
    return marks;
}

}  // namespace fb
