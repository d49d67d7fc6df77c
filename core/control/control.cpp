#include "control/control.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

constexpr double kVTimeRange = 8.0;     // v_time stays within this factor of its calibrated value
constexpr double kSmallestScale = 0.1;  // of T - O
constexpr double kSmallestSpan = 0.05;  // T - O counts as at least this part of T

double median3(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// The measurement that v_time follows: the median of the last three, so that a stall of one frame passes by
// (case 9).
double gatedMarginal(ControlState& state, bool gate, double marginalMs) {
    state.recentMarginal[state.recentCount % 3] = marginalMs;
    ++state.recentCount;
    if (!gate || state.recentCount < 3) return marginalMs;
    return median3(state.recentMarginal[0], state.recentMarginal[1], state.recentMarginal[2]);
}

void feedBackVTime(ControlState& state, const ControlSettings& settings, double marginalMs) {
    state.vTimeMs += settings.vTimeGain * (marginalMs - state.vTimeMs);
    state.vTimeMs =
        std::clamp(state.vTimeMs, state.calibratedMs / kVTimeRange, state.calibratedMs * kVTimeRange);
}

void feedBackShare(ControlState& state, const ControlSettings& settings, const FrameFeatures& f,
                   double actualMs) {
    // The part of the target by which the frame missed it. Counters answer several frames late, and in steps
    // of one size, large enough to follow a camera that leaves a street, the share swings about the target
    // for ever (case 20).
    const double missed = std::min(1.0, std::abs(actualMs / settings.targetMs - 1.0));
    const double part = settings.shareProportional ? missed : 1.0;
    // Raised only if a fully loaded group was refused: otherwise it would wind up to its limit (case 18).
    if (actualMs < settings.shareLow * settings.targetMs && f.refusedGroups > 0) {
        state.shareScale *= 1.0 + settings.shareGain * part;
    } else if (actualMs > settings.shareHigh * settings.targetMs && !f.onlyRoots) {
        state.shareScale *= 1.0 - settings.shareDrop * part;
    }
    state.shareScale = std::clamp(state.shareScale, kSmallestScale, settings.shareLimit);
}

}  // namespace

double shareMs(const ControlState& state, const ControlSettings& settings) {
    return state.shareScale *
           std::max(settings.targetMs - state.overheadMs, kSmallestSpan * settings.targetMs);
}

ControlState startControl(double vTimeMs, double overheadMs) {
    ControlState state;
    state.vTimeMs = state.calibratedMs = vTimeMs;
    state.overheadMs = state.measuredOverheadMs = overheadMs;
    return state;
}

ControlState startControl(const ControlSettings& settings, double measuredVTimeMs, double measuredOverheadMs) {
    ControlState state = startControl(measuredVTimeMs, measuredOverheadMs);
    if (settings.vTimeStartMs > 0.0) {
        state.vTimeMs = std::clamp(settings.vTimeStartMs, measuredVTimeMs / kVTimeRange, measuredVTimeMs * kVTimeRange);
    }
    if (settings.overheadMs > 0.0) state.overheadMs = settings.overheadMs;
    return state;
}

void rescaleCost(ControlState& state, double ratio) {
    if (!(ratio > 0.0) || !std::isfinite(ratio)) return;
    state.vTimeMs /= ratio;
    state.calibratedMs /= ratio;
    for (double& marginalMs : state.recentMarginal) marginalMs /= ratio;
}

double estimateMs(const ControlState& state, double frontCost) {
    return state.overheadMs + state.vTimeMs * frontCost;
}

void feedBack(ControlState& state, const ControlSettings& settings, const FrameFeatures& features,
              double actualMs) {
    if (!std::isfinite(actualMs) || actualMs < 0.0) return;
    state.infeasible = features.onlyRoots && features.estimateMs > settings.targetMs;
    if (!(features.frontCost > 0.0)) return;  // empty front: neither loop moves (case 8)
    double steadyMs = actualMs;
    if (actualMs > state.overheadMs) {  // otherwise there is no marginal time in it (case 10)
        const double measured = (actualMs - state.overheadMs) / features.frontCost;
        const double gated = gatedMarginal(state, settings.medianGate, measured);
        feedBackVTime(state, settings, gated);
        // What this front takes when nothing stalls: a stall must not move the share time either (case 9).
        if (gated != measured) steadyMs = state.overheadMs + gated * features.frontCost;
    }
    if (features.shareFeedback) feedBackShare(state, settings, features, steadyMs);
}

void FeatureRing::push(const FrameFeatures& features) {
    ring_[features.frame % ring_.size()] = features;
}

const FrameFeatures* FeatureRing::find(std::uint64_t frame) const {
    const FrameFeatures& kept = ring_[frame % ring_.size()];
    return kept.frame == frame && frame != 0 ? &kept : nullptr;  // 0 marks a place that is still empty
}

}  // namespace fb
