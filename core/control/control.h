// Feedback: the measured time of a frame moves v_time, and the share time of the roots (thesis 4.2, Feedback Loop;
// algorithms section 2 items 7 to 9). Timings may come late: a frame's features are kept by frame number and paired.
#pragma once

#include <array>
#include <cstdint>

#include "settings/settings.h"

namespace fb {

struct ControlState {
    double vTimeMs = 1e-4;        // ms per unit of cost
    double calibratedMs = 1e-4;   // start value; v_time stays within [1/8, 8] times this
    double overheadMs = 0.0;      // O: frame with an empty front
    double measuredOverheadMs = 0.0;  // what O is where no knob sets it
    double shareScale = 1.0;      // share time of the roots as a multiple of T - O, moved by the second loop
    bool infeasible = false;      // the roots alone take longer than the target (algorithms 5, case 17)
    std::array<double, 3> recentMarginal{};  // last measurements of (actual - O) / cost, for the median gate
    std::uint64_t recentCount = 0;
};

// What must be remembered of a frame until its time is known.
struct FrameFeatures {
    std::uint64_t frame = 0;
    double frontCost = 0.0;
    double estimateMs = 0.0;     // O + v_time * frontCost
    std::uint32_t refusedGroups = 0;
    bool onlyRoots = false;      // the front holds nothing but roots
    bool shareFeedback = false;  // the effect shareFeedback was on
};

// Share time of the roots: shareScale * (T - O), so that a new target acts at once; T - O counts as at least T/20, or
// slices would turn negative under a heavy overhead (algorithms 5, case 11).
[[nodiscard]] double shareMs(const ControlState& state, const ControlSettings& settings);

// Start: v_time calibrated, share = T - O.
[[nodiscard]] ControlState startControl(double vTimeMs, double overheadMs);
// The same, but for what the knobs v_time_start and overhead set. v_time keeps to [1/8, 8] times what was measured: a
// start value from another machine must not hold it where the feedback cannot follow.
[[nodiscard]] ControlState startControl(const ControlSettings& settings, double measuredVTimeMs, double measuredOverheadMs);
[[nodiscard]] double estimateMs(const ControlState& state, double frontCost);

// Another unit of cost: what was one is now `ratio` of them.
void rescaleCost(ControlState& state, double ratio);

// Takes in one measured frame. Skips v_time where the measurement says nothing (empty front, actual <= O, not finite).
// With the median gate on, the share loop sees the gated time too.
void feedBack(ControlState& state, const ControlSettings& settings, const FrameFeatures& features, double actualMs);

// Features of the last 16 frames, for timings that arrive late (GPU queries). Frames count from 1.
class FeatureRing {
  public:
    void push(const FrameFeatures& features);
    [[nodiscard]] const FrameFeatures* find(std::uint64_t frame) const;  // null when it is too old

  private:
    std::array<FrameFeatures, 16> ring_{};
};

}  // namespace fb
