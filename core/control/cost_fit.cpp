#include "control/cost_fit.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

// Standard deviations of the prior, as parts of it.
constexpr WorkVector kPriorSpread = {0.143, 0.176, 0.6, 0.625, 0.25};
constexpr double kForgetting = 0.999, kNoiseGain = 0.01, kFastGain = 0.3, kBackToOne = 0.002;
constexpr double kFactorRange = 8.0, kLeastOfPrior = 0.25;
constexpr double kFirstNoiseShare = 0.03;  // of what the first frames took

// The first frames: the median of actual over prior becomes the scale of everything.
void findScale(CostFit& fit, double ratio, double actualMs) {
    fit.startRatios[fit.measured] = ratio;
    if (fit.measured + 1 < fit.startRatios.size()) return;
    std::array<double, 8> sorted = fit.startRatios;
    std::ranges::sort(sorted);
    const double scale = 0.5 * (sorted[3] + sorted[4]);
    for (int i = 0; i < kWorkKinds; ++i) {
        fit.theta[i] *= scale;
        fit.prior[i] *= scale;
        fit.priorVariance[i] *= scale * scale;
        for (double& c : fit.covariance[i]) c *= scale * scale;
    }
    fit.ratios.scale(1.0 / scale);
    fit.factor = std::clamp(fit.factor / scale, 1.0 / kFactorRange, kFactorRange);
    fit.noiseVariance = kFirstNoiseShare * actualMs * kFirstNoiseShare * actualMs;
}

// A direction that nothing excites must not become more uncertain than it was at the start.
void capVariance(CostFit& fit) {
    for (int i = 0; i < kWorkKinds; ++i) {
        if (!(fit.covariance[i][i] > fit.priorVariance[i])) continue;
        const double scale = std::sqrt(fit.priorVariance[i] / fit.covariance[i][i]);
        for (int j = 0; j < kWorkKinds; ++j) {
            fit.covariance[i][j] *= scale;
            fit.covariance[j][i] *= scale;
        }
    }
}

void correct(CostFit& fit, const WorkVector& x, double actualMs) {
    const double error = actualMs - modelledMs(fit, x);
    const double s = std::sqrt(fit.noiseVariance);
    const double weight = std::abs(error) <= 2.0 * s ? 1.0 : 2.0 * s / std::abs(error);  // Huber
    WorkVector px{};
    for (int i = 0; i < kWorkKinds; ++i) {
        for (int j = 0; j < kWorkKinds; ++j) px[i] += fit.covariance[i][j] * x[j];
    }
    double spread = fit.noiseVariance / std::max(weight, 1e-12);
    for (int i = 0; i < kWorkKinds; ++i) spread += x[i] * px[i];
    if (!(spread > 0.0) || !std::isfinite(spread)) return;
    for (int i = 0; i < kWorkKinds; ++i) {
        const double gain = px[i] / spread;
        fit.theta[i] = std::max(fit.theta[i] + gain * error, i < 2 ? kLeastOfPrior * fit.prior[i] : 0.0);
        for (int j = 0; j < kWorkKinds; ++j)
            fit.covariance[i][j] = (fit.covariance[i][j] - gain * px[j]) / kForgetting;
    }
    capVariance(fit);
    const double squared = std::min(error * error, 9.0 * fit.noiseVariance);
    fit.noiseVariance = (1.0 - kNoiseGain) * fit.noiseVariance + kNoiseGain * squared;
}

}  // namespace

CostFit startCostFit(const WorkVector& prior) {
    CostFit fit;
    fit.theta = fit.prior = prior;
    for (int i = 0; i < kWorkKinds; ++i) {
        const double deviation = kPriorSpread[i] * prior[i];
        fit.covariance[i][i] = fit.priorVariance[i] = deviation * deviation;
    }
    return fit;
}

double modelledMs(const CostFit& fit, const WorkVector& work) {
    double ms = 0.0;
    for (int i = 0; i < kWorkKinds; ++i) ms += fit.theta[i] * work[i];
    return ms;
}

void learn(CostFit& fit, const WorkVector& work, double actualMs, std::size_t gateFrames) {
    const double modelled = modelledMs(fit, work);
    if (!(modelled > 0.0) || !std::isfinite(modelled)) return;
    const double ratio = actualMs / modelled;
    const double now = fit.ratios.pass(ratio, gateFrames);
    fit.factor += kFastGain * (now - fit.factor) + kBackToOne * (1.0 - fit.factor);
    fit.factor = std::clamp(fit.factor, 1.0 / kFactorRange, kFactorRange);
    if (fit.measured < fit.startRatios.size()) {
        findScale(fit, ratio, actualMs);
    } else {
        correct(fit, work, actualMs);
    }
    ++fit.measured;
}

}  // namespace fb
