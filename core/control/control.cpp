#include "control/control.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace fb {
namespace {

constexpr double kVTimeRange = 8.0;     // v_time stays within this factor of its calibrated value
constexpr double kSmallestScale = 0.1;  // of T - O
constexpr double kSmallestSpan = 0.05;  // T - O counts as at least this part of T
// Of the residual, in parts of T; 1.2533 is the deviation of a normal error over its mean size.
constexpr double kFirstResidual = 0.03, kLeastResidual = 0.005, kMostResidual = 0.1;
constexpr double kResidualGain = 0.02, kDeviationOfMean = 1.2533, kOutlierResiduals = 4.0;
// Of the prior where nothing has measured them: a node and a megapixel against a thousand triangles.
constexpr double kNodePrior = 0.05, kFillPrior = 4.0;

// Frames that the gate looks at: an odd number.
std::size_t gateFrames(const ControlSettings& settings) {
    return settings.medianGate ? static_cast<std::size_t>(settings.medianFrames / 2 * 2 + 1) : 1;
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

// The device's time now over what it was calibrated to take.
double speedNow(const ControlState& state) {
    return state.model == CostModel::leastSquares ? state.fit.factor : state.vTimeMs / state.calibratedMs;
}

WorkVector priorOf(const ControlState& state, double cTextured) {
    const double thousand = 1000.0 * state.vTimeMs;
    const double fill = state.fillMsPerMegapixel > 0.0 ? state.fillMsPerMegapixel : kFillPrior * thousand;
    return {thousand * cTextured, thousand * (1.0 - cTextured), kNodePrior * thousand, fill,
            std::max(state.overheadMs, kNodePrior * thousand)};
}

void feedBackResidual(ControlState& state, double targetMs, double errorMs) {
    const double before = state.residualMs > 0.0 ? state.residualMs : kFirstResidual * targetMs;
    const double size = kDeviationOfMean * std::min(std::abs(errorMs), kOutlierResiduals * before);
    state.residualMs =
        std::clamp(before + kResidualGain * (size - before), kLeastResidual * targetMs, kMostResidual * targetMs);
}

}  // namespace

double shareMs(const ControlState& state, const ControlSettings& settings) {
    return state.shareScale *
           std::max(settings.targetMs - state.overheadMs, kSmallestSpan * settings.targetMs);
}

ControlState startControl(const ControlSettings& settings, const MeasuredConstants& measured, double cTextured) {
    ControlState state;
    state.measured = measured;
    state.vTimeMs = state.calibratedMs = measured.vTimeMs;
    state.overheadMs = settings.overheadMs > 0.0 ? settings.overheadMs : measured.overheadMs;
    state.fillMsPerMegapixel =
        settings.fillMsPerMegapixel > 0.0 ? settings.fillMsPerMegapixel : measured.fillMsPerMegapixel;
    if (settings.vTimeStartMs > 0.0) {
        state.vTimeMs = std::clamp(settings.vTimeStartMs, measured.vTimeMs / kVTimeRange, measured.vTimeMs * kVTimeRange);
    }
    followCostModel(state, settings.costModel, cTextured);
    state.slowSpeed = speedNow(state);
    return state;
}

TimeModel timeModel(const ControlState& state, const ControlSettings& settings, double cTextured, double megapixels,
                    const TexturePressure* pressure) {
    TimeModel model = timesByCost(state.vTimeMs, cTextured, state.overheadMs + state.fillMsPerMegapixel * megapixels);
    if (state.model == CostModel::leastSquares) {
        const WorkVector& theta = state.fit.theta;
        const double m = state.fit.factor;
        model.texturedMs = m * theta[0] / 1000.0;
        model.untexturedMs = m * theta[1] / 1000.0;
        model.nodeMs = m * theta[2];
        model.leastMs = 0.0;
        model.fixedMs = m * (theta[3] * megapixels + theta[4]);
    }
    if (pressure != nullptr && pressure->residentBytes > pressure->budgetBytes) {
        const double missing = 1.0 - static_cast<double>(pressure->budgetBytes) / static_cast<double>(pressure->residentBytes);
        model.textureMsPerByte = settings.texturePressure / kBytesPerMiB * missing;
    }
    model.slowRatio = state.slowSpeed / speedNow(state);
    model.residualMs = state.residualMs > 0.0 ? state.residualMs : kFirstResidual * settings.targetMs;
    return model;
}

void rescaleCost(ControlState& state, double ratio) {
    if (!(ratio > 0.0) || !std::isfinite(ratio)) return;
    state.vTimeMs /= ratio;
    state.calibratedMs /= ratio;
    state.measured.vTimeMs /= ratio;
    state.marginal.scale(1.0 / ratio);
}

void followCostModel(ControlState& state, CostModel wanted, double cTextured) {
    if (wanted == CostModel::leastSquares && (state.model != wanted || state.fit.measured == 0))
        state.fit = startCostFit(priorOf(state, cTextured));
    if (state.model == wanted) return;
    state.model = wanted;
    state.slowSpeed = speedNow(state);
}

void passTime(ControlState& state, const ControlSettings& settings, double dtSeconds, double patience) {
    state.slowSpeed += (speedNow(state) - state.slowSpeed) * dtSeconds / (patience * settings.slowSeconds + dtSeconds);
}

void feedBack(ControlState& state, const ControlSettings& settings, const FrameFeatures& features,
              double actualMs) {
    if (!std::isfinite(actualMs) || actualMs < 0.0) return;
    state.infeasible = features.onlyRoots && features.estimateMs > settings.targetMs;
    if (!(features.frontCost > 0.0)) return;  // empty front: no loop moves (case 8)
    feedBackResidual(state, settings.targetMs, actualMs - features.estimateMs);
    double steadyMs = actualMs;
    if (actualMs > features.fixedMs) {  // otherwise there is no marginal time in it (case 10)
        const double measured = (actualMs - features.fixedMs) / features.frontCost;
        const double gated = state.marginal.pass(measured, gateFrames(settings));
        feedBackVTime(state, settings, gated);
        // What this front takes when nothing stalls: a stall must not move the share time either (case 9).
        if (gated != measured) steadyMs = features.fixedMs + gated * features.frontCost;
    }
    if (state.model == CostModel::leastSquares && actualMs > 0.0)
        learn(state.fit, features.work, actualMs, gateFrames(settings));
    if (features.shareFeedback) feedBackShare(state, settings, features, steadyMs);
}

}  // namespace fb
