// Feedback: the measured time of a frame moves the cost model, and the share time of the roots (thesis 4.2, Feedback Loop;
// algorithms section 2 items 7 to 9 and 3.1). Timings may come late: a frame's features are kept by number and paired.
#pragma once

#include <array>
#include <cstdint>

#include "control/cost_fit.h"
#include "control/frame_features.h"
#include "control/median_gate.h"
#include "select/time_model.h"
#include "settings/settings.h"

namespace fb {

// What opening a scene, or `frontbench calibrate`, measured.
struct MeasuredConstants {
    double vTimeMs = 1e-4;            // ms per unit of cost
    double overheadMs = 0.0;          // O: frame with an empty front
    double fillMsPerMegapixel = 0.0;  // of the picture in front of the roots
};

struct ControlState {
    double vTimeMs = 1e-4;        // ms per unit of cost
    double calibratedMs = 1e-4;   // start value; v_time stays within [1/8, 8] times this
    double overheadMs = 0.0;      // O
    double fillMsPerMegapixel = 0.0;
    MeasuredConstants measured;   // what counts where no knob says otherwise
    double shareScale = 1.0;      // share time of the roots as a multiple of T - O, moved by the second loop
    bool infeasible = false;      // the roots alone take longer than the target (algorithms 5, case 17)
    MedianGate marginal;          // of (actual - fixed) / cost
    CostModel model = CostModel::vTime;
    CostFit fit;                  // of the model by least squares
    double slowSpeed = 1.0;       // m_slow: the fast factor of either model, averaged over seconds
    double residualMs = 0.0;      // rs: usual error of the estimate; 0: none measured yet
};

// Texture that is drawn while more is in memory than the device holds (effect texture_pressure).
struct TexturePressure {
    std::uint64_t residentBytes = 0, budgetBytes = 0;
};

// Start: v_time and share = T - O as measured, but for what the knobs v_time_start, overhead and fill set. v_time keeps to
// [1/8, 8] times what was measured: a start value from another machine must not hold it where feedback cannot follow.
[[nodiscard]] ControlState startControl(const ControlSettings& settings, const MeasuredConstants& measured,
                                        double cTextured);

// Share time of the roots: shareScale * (T - O), so that a new target acts at once; T - O counts as at least T/20, or
// slices would turn negative under a heavy overhead (algorithms 5, case 11).
[[nodiscard]] double shareMs(const ControlState& state, const ControlSettings& settings);

// The model that this frame's selection estimates with. Megapixels in front of the roots: 0 where fill is not counted.
// `pressure`: only where the effect is on.
[[nodiscard]] TimeModel timeModel(const ControlState& state, const ControlSettings& settings, double cTextured,
                                  double megapixels, const TexturePressure* pressure);

// Another unit of cost: what was one is now `ratio` of them.
void rescaleCost(ControlState& state, double ratio);
// The other cost model begins with what v_time has learnt.
void followCostModel(ControlState& state, CostModel wanted, double cTextured);

// Time goes by: the slow speed follows the fast one, `patience` times as slowly as the knob says. dtSeconds in [0, 0.1].
void passTime(ControlState& state, const ControlSettings& settings, double dtSeconds, double patience = 1.0);

// Takes in one measured frame. Skips v_time where the measurement says nothing (empty front, actual below what is fixed,
// not finite). With the median gate on, the share loop sees the gated time too.
void feedBack(ControlState& state, const ControlSettings& settings, const FrameFeatures& features, double actualMs);

}  // namespace fb
