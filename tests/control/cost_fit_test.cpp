// The cost model by least squares against devices whose times are known (algorithms 3.1).
#include "control/cost_fit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace fb {
namespace {

constexpr WorkVector kPrior = {0.21, 0.17, 0.010, 0.8, 2.0};
constexpr WorkVector kDevice = {0.30, 0.12, 0.020, 1.5, 3.0};
constexpr std::size_t kGate = 3;

double timeOf(const WorkVector& device, const WorkVector& work) {
    double ms = 0.0;
    for (int i = 0; i < kWorkKinds; ++i) ms += device[i] * work[i];
    return ms;
}

// Fronts as a walk draws them: much or little of each kind, in proportions that change.
WorkVector randomWork(Random& r) {
    WorkVector work{};
    work[0] = r.uniform(5.0, 120.0);
    work[1] = r.uniform(5.0, 60.0);
    work[2] = r.uniform(40.0, 300.0);
    work[3] = r.uniform(0.1, 0.92);
    work[4] = 1.0;
    return work;
}

double estimate(const CostFit& fit, const WorkVector& work) { return fit.factor * modelledMs(fit, work); }

TEST(CostFit, BeginsWithThePrior) {
    const CostFit fit = startCostFit(kPrior);
    EXPECT_DOUBLE_EQ(modelledMs(fit, {100, 50, 100, 1, 1}), 21.0 + 8.5 + 1.0 + 0.8 + 2.0);
    EXPECT_EQ(fit.factor, 1.0);
}

TEST(CostFit, LearnsADeviceOfOtherProportions) {
    CostFit fit = startCostFit(kPrior);
    Random r(3);
    for (int i = 0; i < 3000; ++i) {
        const WorkVector work = randomWork(r);
        learn(fit, work, timeOf(kDevice, work), kGate);
    }
    double worst = 0.0;
    for (int i = 0; i < 200; ++i) {
        const WorkVector work = randomWork(r);
        worst = std::max(worst, std::abs(estimate(fit, work) / timeOf(kDevice, work) - 1.0));
    }
    EXPECT_LT(worst, 0.02);
}

TEST(CostFit, TakesItsScaleFromTheFirstEightFrames) {
    for (const double speed : {0.25, 4.0}) {
        WorkVector device = kPrior;
        for (double& ms : device) ms *= speed;
        CostFit fit = startCostFit(kPrior);
        Random r(4);
        for (int i = 0; i < 8; ++i) {
            const WorkVector work = randomWork(r);
            learn(fit, work, timeOf(device, work), kGate);
        }
        for (int i = 0; i < kWorkKinds; ++i) EXPECT_NEAR(fit.theta[i], device[i], 1e-12 * device[i]);
    }
}

// A camera that stands still excites one combination of the weights alone. A device that gets slower and faster by turns must
// not push them apart: the fast factor takes it.
TEST(CostFit, DoesNotDivergeWhileNothingChangesButTheSpeed) {
    CostFit fit = startCostFit(kPrior);
    Random r(5);
    for (int i = 0; i < 500; ++i) {
        const WorkVector work = randomWork(r);
        learn(fit, work, timeOf(kDevice, work), kGate);
    }
    const WorkVector still = {80, 20, 140, 0.9, 1.0};
    double squares = 0.0;
    constexpr int kFrames = 20000;
    for (int i = 0; i < kFrames; ++i) {
        const double speed = 1.0 + 0.2 * std::sin(0.02 * i);
        const double actualMs = speed * timeOf(kDevice, still);
        const double error = estimate(fit, still) / actualMs - 1.0;
        squares += error * error;
        learn(fit, still, actualMs, kGate);
    }
    EXPECT_LT(std::sqrt(squares / kFrames), 0.02);
    // And what it knew of other fronts it still knows.
    double worst = 0.0;
    for (int i = 0; i < 200; ++i) {
        const WorkVector work = randomWork(r);
        worst = std::max(worst, std::abs(modelledMs(fit, work) / timeOf(kDevice, work) - 1.0));
    }
    EXPECT_LT(worst, 0.35);
}

TEST(CostFit, FollowsADeviceThatSuddenlyTakesTwiceAsLong) {
    CostFit fit = startCostFit(kPrior);
    const WorkVector work = {80, 20, 140, 0.9, 1.0};
    for (int i = 0; i < 100; ++i) learn(fit, work, timeOf(kPrior, work), kGate);
    int frames = 0;
    while (std::abs(estimate(fit, work) / (2.0 * timeOf(kPrior, work)) - 1.0) > 0.05) {
        learn(fit, work, 2.0 * timeOf(kPrior, work), kGate);
        ASSERT_LT(++frames, 20);
    }
    EXPECT_LE(frames, 10);
}

TEST(CostFit, LetsOneStallPass) {
    CostFit fit = startCostFit(kPrior);
    const WorkVector work = {80, 20, 140, 0.9, 1.0};
    for (int i = 0; i < 200; ++i) learn(fit, work, timeOf(kPrior, work), kGate);
    const double before = estimate(fit, work);
    learn(fit, work, 20.0 * timeOf(kPrior, work), kGate);
    EXPECT_NEAR(estimate(fit, work) / before, 1.0, 0.01);
}

RC_GTEST_PROP(CostFit, StaysFiniteAndAboveZeroWhateverIsMeasured, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    CostFit fit = startCostFit(kPrior);
    for (int i = 0; i < 400; ++i) {
        WorkVector work = randomWork(r);
        for (double& x : work) {
            if (r.index(6) == 0) x = r.index(2) == 0 ? 0.0 : std::pow(10.0, r.uniform(-9.0, 9.0));
        }
        learn(fit, work, std::pow(10.0, r.uniform(-6.0, 6.0)), 2 * r.index(7) + 1);
        RC_ASSERT(fit.factor >= 0.125 * (1.0 - 1e-12));
        RC_ASSERT(std::isfinite(fit.factor));
        for (int k = 0; k < kWorkKinds; ++k) {
            RC_ASSERT(std::isfinite(fit.theta[k]));
            RC_ASSERT(fit.theta[k] >= (k < 2 ? 0.25 * fit.prior[k] * (1.0 - 1e-9) : 0.0));
            RC_ASSERT(fit.covariance[k][k] <= fit.priorVariance[k] * (1.0 + 1e-9));
        }
        RC_ASSERT(std::isfinite(fit.noiseVariance));
    }
}

}  // namespace
}  // namespace fb
