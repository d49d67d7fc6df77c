// Constants of the cost model from fronts whose times are known: overhead 2 ms, 3 ms to fill the half megapixel of view 0 and
// 9 ms for the one and a half of view 1, 0.25 ms an untextured and 0.75 ms a textured triangle. Then c_textured = 0.75, v_time = 1 ms.
#include "control/fit_costs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace fb {
namespace {

constexpr std::size_t kRounds = 20;

FrontTimes front(std::uint32_t view, std::uint64_t textured, std::uint64_t untextured) {
    FrontTimes times;
    times.view = view;
    times.texturedTriangles = textured;
    times.untexturedTriangles = untextured;
    times.cost = 0.75 * double(textured) + 0.25 * double(untextured);
    times.megapixels = view == 0 ? 0.5 : 1.5;
    const double fillMs = textured + untextured == 0 ? 0.0 : view == 0 ? 3.0 : 9.0;
    times.ms.assign(kRounds, 2.0 + fillMs + 0.75 * double(textured) + 0.25 * double(untextured));
    times.plainMs.assign(kRounds, 2.0 + fillMs + 0.25 * double(textured + untextured));
    return times;
}

// Textured and untextured triangles in proportions that differ from front to front.
std::vector<FrontTimes> knownFronts() {
    return {front(0, 0, 0), front(0, 16, 4), front(0, 32, 64), front(1, 8, 8), front(1, 64, 32)};
}

// What other programs do: most rounds are slower, some by far.
void disturb(std::vector<FrontTimes>& fronts, double mostMs) {
    Random random(7);
    for (FrontTimes& f : fronts) {
        for (std::size_t r = 0; r < kRounds; ++r) {
            if (r % 4 == 0) continue;
            f.ms[r] += random.uniform(0.0, mostMs);
            f.plainMs[r] += random.uniform(0.0, mostMs);
        }
    }
}

TEST(FitCosts, GivesBackTheConstantsOfExactTimes) {
    const std::vector<FrontTimes> fronts = knownFronts();
    EXPECT_DOUBLE_EQ(fitOverhead(fronts)->value, 2.0);
    EXPECT_DOUBLE_EQ(fitCTextured(fronts)->value, 0.75);
    EXPECT_DOUBLE_EQ(fitVTime(fronts)->value, 1.0);
    EXPECT_DOUBLE_EQ(fitFill(fronts)->value, 6.0);
    EXPECT_EQ(fitOverhead(fronts)->plusMinus, 0.0);
    EXPECT_NEAR(fitCTextured(fronts)->plusMinus, 0.0, 1e-12);
    EXPECT_NEAR(fitVTime(fronts)->plusMinus, 0.0, 1e-12);
}

// Filling the picture must not be charged to triangles: the empty front, which fills nothing, is no point of the slope.
TEST(FitCosts, TakesNoTimeOfFillingForTimeOfTriangles) {
    const std::vector<FrontTimes> fronts = {front(0, 0, 0), front(0, 10, 0), front(0, 20, 0)};
    EXPECT_DOUBLE_EQ(fitVTime(fronts)->value, 1.0);
}

TEST(FitCosts, IsNotMovedByWhatOtherProgramsAdd) {
    std::vector<FrontTimes> fronts = knownFronts();
    disturb(fronts, 40.0);
    EXPECT_NEAR(fitOverhead(fronts)->value, 2.0, 1e-9);
    EXPECT_NEAR(fitCTextured(fronts)->value, 0.75, 1e-9);
    EXPECT_NEAR(fitVTime(fronts)->value, 1.0, 1e-9);
}

TEST(FitCosts, UncertaintyCoversWhatRepeatingGives) {
    int covered = 0;
    constexpr int kRepetitions = 40;
    for (int i = 0; i < kRepetitions; ++i) {
        std::vector<FrontTimes> fronts = knownFronts();
        Random random(static_cast<std::uint64_t>(i));
        for (FrontTimes& f : fronts) {
            for (double& ms : f.ms) ms += random.uniform(0.0, 4.0);
            for (double& ms : f.plainMs) ms += random.uniform(0.0, 4.0);
        }
        const Estimate estimate = *fitCTextured(fronts);
        EXPECT_GT(estimate.plusMinus, 0.0);
        EXPECT_LT(estimate.plusMinus, 0.2);
        covered += std::abs(estimate.value - 0.75) <= estimate.plusMinus ? 1 : 0;
    }
    EXPECT_GE(covered, kRepetitions * 8 / 10);
}

TEST(FitCosts, SameTimesGiveTheSameUncertainty) {
    std::vector<FrontTimes> fronts = knownFronts();
    disturb(fronts, 4.0);
    EXPECT_EQ(fitVTime(fronts)->plusMinus, fitVTime(fronts)->plusMinus);
}

TEST(FitCosts, TellsABusyMachineFromAnIdleOne) {
    EXPECT_EQ(disturbance({}), 1.0);
    std::vector<FrontTimes> fronts = knownFronts();
    EXPECT_EQ(disturbance(fronts), 1.0);
    for (FrontTimes& f : fronts) {
        for (std::size_t r = 0; r < kRounds; ++r) f.ms[r] *= r % 4 == 0 ? 1.0 : 2.0;
    }
    EXPECT_EQ(disturbance(fronts), 2.0);
}

TEST(FitCosts, SaysNothingWhereNothingCanBeTold) {
    EXPECT_FALSE(fitOverhead({}));
    EXPECT_FALSE(fitVTime({}));
    EXPECT_FALSE(fitCTextured({}));
    EXPECT_FALSE(fitFill({}));
    std::vector<FrontTimes> nothingCovered = knownFronts();
    for (FrontTimes& f : nothingCovered) f.megapixels = 0.0;
    EXPECT_FALSE(fitFill(nothingCovered));
    const std::vector<FrontTimes> noEmptyFront = {front(0, 16, 4)};
    EXPECT_FALSE(fitOverhead(noEmptyFront));
    EXPECT_FALSE(fitVTime(noEmptyFront)) << "one front has no slope";
    const std::vector<FrontTimes> oneAView = {front(0, 16, 4), front(1, 32, 8)};
    EXPECT_FALSE(fitVTime(oneAView)) << "two views have nothing in common";
    const std::vector<FrontTimes> untextured = {front(0, 0, 4), front(0, 0, 8)};
    EXPECT_TRUE(fitVTime(untextured));
    EXPECT_FALSE(fitCTextured(untextured));
    std::vector<FrontTimes> onlyAsDrawn = knownFronts();
    for (FrontTimes& f : onlyAsDrawn) f.plainMs.clear();
    EXPECT_TRUE(fitVTime(onlyAsDrawn));
    EXPECT_FALSE(fitCTextured(onlyAsDrawn));
    std::vector<FrontTimes> flat = knownFronts();
    for (FrontTimes& f : flat) {
        f.ms.assign(kRounds, 5.0);
        f.plainMs.assign(kRounds, 5.0);
    }
    EXPECT_FALSE(fitVTime(flat)) << "time does not rise";
    EXPECT_FALSE(fitCTextured(flat));
}

}  // namespace
}  // namespace fb
