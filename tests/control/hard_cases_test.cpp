// The table of hard cases (core/algorithms.md section 5), as far as it is about the feedback: one test a row,
// named by its number. Those with `street` close the loop: selection, simulated device, feedback.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "worlds/closed_loop.h"
#include "worlds/feedback.h"

namespace fb {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Settings streetSettings(PolicyId policy) {
    Settings settings;
    settings.select.policy = policy;
    settings.control.targetMs = 15.0;
    settings.model.noisePct = 0.0;
    return settings;
}

ClosedLoop street(PolicyId policy, int view, double noisePct = 0.0) {
    Settings settings = streetSettings(policy);
    settings.model.noisePct = noisePct;
    ClosedLoop loop(streetWorld(), settings);
    loop.walk.view = streetView(view);
    return loop;
}

struct Held {
    double vTimeMs, shareScale;
    std::uint64_t measurements;
    bool operator==(const Held&) const = default;
};
Held held(const ControlState& s) {
    return {s.vTimeMs, s.shareScale, s.marginal.count};
}

TEST(HardCase, Nr08TheSkyMovesNeitherVTimeNorShare) {
    ControlState state = startedAt(0.25, 2.0);
    const Held before = held(state);
    for (double actualMs : {0.5, 2.0, 500.0}) {
        feed(state, {}, {.frame = 1, .estimateMs = 2.0, .refusedGroups = 1, .shareFeedback = true},
                 actualMs);
        EXPECT_EQ(held(state), before);
    }
}

TEST(HardCase, Nr09AStallOf500MsPassesTheMedianGateByAFactorOfOne) {
    const FrameFeatures front{.frame = 1, .frontCost = 100.0};
    ControlState state = startedAt(0.25, 0.0);
    for (int i = 0; i < 5; ++i) feed(state, {}, front, 25.0);
    feed(state, {}, front, 500.0);
    EXPECT_EQ(state.vTimeMs, 0.25);
    feed(state, {}, front, 25.0);
    EXPECT_EQ(state.vTimeMs, 0.25);
    // Without the gate: 0.25 + 0.3 * (5 - 0.25), 6.7 times as much.
    ControlSettings ungated;
    ungated.medianGate = false;
    ungated.vTimeGain = 0.3;
    feed(state, ungated, front, 500.0);
    EXPECT_DOUBLE_EQ(state.vTimeMs, 1.675);
}

TEST(HardCase, Nr09AStallSwitchesNothingInTheStreet) {
    for (PolicyId policy : {PolicyId::lakhia, PolicyId::lakhiaNaive}) {
        ClosedLoop loop = street(policy, 0);
        loop.run(2000);
        loop.toggles = 0;  // settled: nothing switches without noise
        const double before = loop.control.vTimeMs;
        loop.step(500.0);
        EXPECT_NEAR(loop.control.vTimeMs / before, 1.0, 1e-9);
        loop.run(120);
        EXPECT_EQ(loop.toggles, 0u) << policyOf(policy).name;

        ClosedLoop ungated = street(policy, 0);
        ungated.settings.control.medianGate = false;
        ungated.run(2000);
        ungated.toggles = 0;
        ungated.step(500.0);
        ungated.run(120);
        EXPECT_GT(ungated.toggles, 4u) << policyOf(policy).name;
    }
}

TEST(HardCase, Nr10AMeasurementThatSaysNothingIsSkipped) {
    const FrameFeatures front{.frame = 1, .frontCost = 100.0, .refusedGroups = 1, .shareFeedback = true};
    ControlState state = startedAt(0.25, 2.0);
    for (double actualMs : {2.0, 1.0, 0.0}) {
        feed(state, {}, front, actualMs);  // not above the overhead: no v_time in it
        EXPECT_EQ(state.vTimeMs, 0.25);
        EXPECT_EQ(state.marginal.count, 0u);
    }
    const Held before = held(state);
    for (double actualMs : {-1.0, std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
        feed(state, {}, front, actualMs);
        EXPECT_EQ(held(state), before);
    }
}

TEST(HardCase, Nr11AnOverheadAboveTheTargetLeavesATwentiethOfTheTarget) {
    ControlSettings settings;
    settings.targetMs = 10.0;
    ControlState state = startedAt(0.25, 15.0);
    EXPECT_EQ(shareMs(state, settings), 0.5);
    state.shareScale = 0.1;
    EXPECT_DOUBLE_EQ(shareMs(state, settings), 0.05);

    ClosedLoop loop = street(PolicyId::lakhia, 0);
    loop.control = startedAt(loop.control.vTimeMs, 20.0);
    loop.settings.model.overheadMs = 20.0;
    loop.run(400);
    for (NodeId n : loop.walk.selection.front) EXPECT_LT(n, loop.walk.hierarchy.rootCount);
    EXPECT_GT(loop.walk.selection.front.size(), 8u);
    for (double slice : loop.walk.state.shares) EXPECT_GT(slice, 0.0);
    EXPECT_TRUE(loop.control.infeasible);
}

TEST(HardCase, Nr17RootsThatExceedTheTargetAreDrawnReportedAndDoNotWindTheShareDown) {
    for (PolicyId policy : {PolicyId::lakhia, PolicyId::lakhiaNaive}) {
        ClosedLoop loop = street(policy, 0);
        loop.settings.control.targetMs = 3.0;  // sixteen roots take 5.2 ms
        loop.run(100);
        EXPECT_TRUE(loop.control.infeasible);
        const double before = loop.control.shareScale;
        loop.run(1000);
        EXPECT_EQ(loop.control.shareScale, before);
        EXPECT_EQ(loop.walk.selection.front.size(), 16u);
        for (NodeId n : loop.walk.selection.front) EXPECT_LT(n, 16u);
        loop.settings.control.targetMs = 15.0;  // and it is over as soon as the target allows
        loop.run(1000);
        EXPECT_FALSE(loop.control.infeasible);
        EXPECT_GT(loop.walk.selection.front.size(), 16u);
    }
}

TEST(HardCase, Nr18TheShareDoesNotWindUpWhereNothingLoadedCouldUseIt) {
    for (PolicyId policy : {PolicyId::lakhia, PolicyId::lakhiaNaive}) {
        ClosedLoop leaves = street(policy, 0);
        leaves.settings.control.targetMs = 500.0;  // every leaf takes 52 ms
        leaves.run(1000);
        ASSERT_EQ(leaves.walk.counters().refusedGroups, 0u) << "every leaf in view is drawn";
        const double before = leaves.control.shareScale;
        leaves.run(2000);
        EXPECT_EQ(leaves.control.shareScale, before);
        EXPECT_LT(leaves.actualMs, 0.9 * 500.0);

        ClosedLoop unloaded = street(policy, 0);
        for (NodeId n = 16; n < unloaded.walk.hierarchy.size(); ++n) unloaded.walk.loaded[n] = 0;
        unloaded.run(2000);
        EXPECT_EQ(unloaded.control.shareScale, 1.0);
        EXPECT_LT(unloaded.actualMs, 0.9 * 15.0);
    }
}

// With the recommended settings, from five places and for three targets.
void expectToSettle(PolicyId policy, int view, double targetMs, int within) {
    ClosedLoop loop = street(policy, view);
    loop.settings.control.targetMs = targetMs;
    loop.run(within);
    loop.toggles = 0;
    loop.run(300);
    EXPECT_EQ(loop.toggles, 0u) << policyOf(policy).name << " view " << view << " T " << targetMs;
    EXPECT_GT(loop.walk.selection.front.size(), 32u) << "and not at the roots";
    EXPECT_NEAR(loop.actualMs, targetMs, 0.1 * targetMs);
}

TEST(HardCase, Nr20AStillCameraSettlesWithoutNoise) {
    for (int view = 0; view < 5; ++view) {
        for (double targetMs : {10.0, 12.0, 15.0}) expectToSettle(PolicyId::lakhia, view, targetMs, 2000);
        expectToSettle(PolicyId::lakhiaNaive, view, 15.0, 900);
    }
}

// Five views of 900 frames. Expected are 0.3 switches a frame for the naive policy and a few thousandths with
// counters.
TEST(HardCase, Nr20WithNoiseCountersKeepAStillCameraCalmAndTheNaivePolicyDoesNot) {
    const auto togglesOf = [](PolicyId policy) {
        std::uint64_t toggles = 0;
        for (int view = 0; view < 5; ++view) {
            ClosedLoop loop = street(policy, view, 3.0);
            loop.run(2700);
            loop.toggles = 0;
            loop.run(900);
            toggles += loop.toggles;
        }
        return toggles;
    };
    EXPECT_LE(togglesOf(PolicyId::lakhia), 45u);        // 0.01 a frame
    EXPECT_GT(togglesOf(PolicyId::lakhiaNaive), 450u);  // 0.1 a frame
}

TEST(HardCase, Nr21TheMedianGateWorksBeyond32BitsOfMeasurements) {
    ControlSettings settings;
    settings.vTimeGain = 1.0;
    const FrameFeatures front{.frame = 1, .frontCost = 1.0};
    ControlState state = startedAt(1.0, 0.0);
    state.marginal.count = 0xfffffffeu;
    state.marginal.recent.fill(1.0);
    for (int i = 0; i < 4; ++i) {
        feed(state, settings, front, 5.0);  // a stall
        EXPECT_EQ(state.vTimeMs, 1.0) << "after measurement " << state.marginal.count;
        feed(state, settings, front, 1.0);
        feed(state, settings, front, 1.0);
        EXPECT_EQ(state.vTimeMs, 1.0);
    }
}

}  // namespace
}  // namespace fb
