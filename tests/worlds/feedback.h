// The feedback's state and measured frames as tests write them: v_time and O, no fill.
#pragma once

#include "control/control.h"

namespace fb {

inline ControlState startedAt(double vTimeMs, double overheadMs) {
    return startControl(ControlSettings{}, {vTimeMs, overheadMs, 0.0}, 0.5);
}
inline double estimateMs(const ControlState& state, double cost) {
    return timeModel(state, ControlSettings{}, 0.5, 0.0, nullptr).fixedMs + state.vTimeMs * cost;
}
// A frame of which the overhead is all that no front changes.
inline void feed(ControlState& state, const ControlSettings& settings, FrameFeatures features, double actualMs) {
    features.fixedMs = state.overheadMs;
    feedBack(state, settings, features, actualMs);
}

}  // namespace fb
