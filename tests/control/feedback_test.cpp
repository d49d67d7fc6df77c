// The two feedback loops by hand (thesis 4.2; algorithms 2 items 8 and 9).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "control/control.h"
#include "worlds/feedback.h"
#include "worlds/random_worlds.h"

namespace fb {
namespace {

ControlSettings plainControl() {
    ControlSettings settings;
    settings.targetMs = 30.0;
    settings.medianGate = false;
    settings.medianFrames = 3;
    settings.vTimeGain = 0.3;
    settings.shareGain = settings.shareDrop = 0.01;
    settings.shareProportional = false;
    settings.shareLow = 0.90;
    settings.shareHigh = 1.05;
    settings.shareLimit = 20.0;
    return settings;
}

FrameFeatures frontOf(double cost) {
    return {.frame = 1, .frontCost = cost, .estimateMs = 0.0};
}

TEST(Estimate, IsOverheadPlusVTimeTimesCost) {
    const ControlState state = startedAt(0.25, 2.0);
    EXPECT_EQ(estimateMs(state, 0.0), 2.0);
    EXPECT_EQ(estimateMs(state, 100.0), 27.0);
}

TEST(Start, IsWhatWasMeasuredWhereNoKnobSaysOtherwise) {
    const ControlState state = startControl(plainControl(), {0.25, 2.0, 0.0}, 0.5);
    EXPECT_EQ(state.vTimeMs, 0.25);
    EXPECT_EQ(state.calibratedMs, 0.25);
    EXPECT_EQ(state.overheadMs, 2.0);
}

TEST(Start, TakesTheKnobsAndKeepsWhatWasMeasured) {
    ControlSettings settings = plainControl();
    settings.vTimeStartMs = 0.5;
    settings.overheadMs = 3.0;
    const ControlState state = startControl(settings, {0.25, 2.0, 0.0}, 0.5);
    EXPECT_EQ(state.vTimeMs, 0.5);
    EXPECT_EQ(state.calibratedMs, 0.25);
    EXPECT_EQ(state.overheadMs, 3.0);
    EXPECT_EQ(state.measured.overheadMs, 2.0);
    EXPECT_EQ(shareMs(state, settings), 27.0);
}

// A preset from a machine a thousand times slower: the feedback must be able to come back.
TEST(Start, KeepsVTimeWhereTheFeedbackCanFollow) {
    ControlSettings settings = plainControl();
    settings.vTimeStartMs = 250.0;
    EXPECT_EQ(startControl(settings, {0.25, 2.0, 0.0}, 0.5).vTimeMs, 2.0);
    settings.vTimeStartMs = 1e-9;
    EXPECT_EQ(startControl(settings, {0.25, 2.0, 0.0}, 0.5).vTimeMs, 0.03125);
}

TEST(VTime, MovesByThePartGainTowardsWhatWasMeasured) {
    ControlState state = startedAt(0.25, 2.0);
    // (52 - 2) / 100 = 0.5: 0.25 + 0.3 * 0.25
    feed(state, plainControl(), frontOf(100), 52.0);
    EXPECT_DOUBLE_EQ(state.vTimeMs, 0.325);
    // (12 - 2) / 100 = 0.1: 0.325 - 0.3 * 0.225
    feed(state, plainControl(), frontOf(100), 12.0);
    EXPECT_DOUBLE_EQ(state.vTimeMs, 0.2575);
    EXPECT_EQ(state.calibratedMs, 0.25);
}

TEST(VTime, StandsStillWithAGainOfZeroAndJumpsWithAGainOfOne) {
    ControlSettings settings = plainControl();
    settings.vTimeGain = 0.0;
    ControlState state = startedAt(0.25, 2.0);
    feed(state, settings, frontOf(100), 52.0);
    EXPECT_EQ(state.vTimeMs, 0.25);
    settings.vTimeGain = 1.0;
    feed(state, settings, frontOf(100), 52.0);
    EXPECT_EQ(state.vTimeMs, 0.5);
}

TEST(VTime, StaysWithinAnEighthAndEightTimesItsCalibratedValue) {
    ControlSettings settings = plainControl();
    settings.vTimeGain = 1.0;
    ControlState state = startedAt(0.25, 0.0);
    feed(state, settings, frontOf(1), 1000.0);
    EXPECT_EQ(state.vTimeMs, 2.0);
    feed(state, settings, frontOf(1000), 0.001);
    EXPECT_EQ(state.vTimeMs, 0.03125);
    feed(state, settings, frontOf(1), 1.0);
    EXPECT_EQ(state.vTimeMs, 1.0) << "a limit is not a trap";
}

TEST(MedianGate, FollowsTheMedianOfTheLastThreeMeasurements) {
    ControlSettings settings = plainControl();
    settings.medianGate = true;
    settings.vTimeGain = 1.0;
    ControlState state = startedAt(1.0, 0.0);
    const double measured[] = {2, 4, 1, 7, 3, 3, 8};
    const double followed[] = {2, 4, 2, 4, 3, 3, 3};  // the first two have no three to choose from
    for (int i = 0; i < 7; ++i) {
        feed(state, settings, frontOf(1), measured[i]);
        EXPECT_EQ(state.vTimeMs, followed[i]) << "measurement " << i;
    }
}

TEST(MedianGate, DoesNotMindTheOrder) {
    const double orders[][3] = {{1, 2, 3}, {1, 3, 2}, {2, 1, 3}, {2, 3, 1}, {3, 1, 2}, {3, 2, 1}};
    ControlSettings settings = plainControl();
    settings.medianGate = true;
    settings.vTimeGain = 1.0;
    for (const auto& order : orders) {
        ControlState state = startedAt(1.0, 0.0);
        for (double measured : order) feed(state, settings, frontOf(1), measured);
        EXPECT_EQ(state.vTimeMs, 2.0) << order[0] << order[1] << order[2];
    }
}

TEST(MedianGate, CountsMeasurementsThatSayNothingNeitherWay) {
    ControlSettings settings = plainControl();
    settings.medianGate = true;
    settings.vTimeGain = 1.0;
    ControlState state = startedAt(1.0, 0.5);
    for (double ms : {2.5, 4.5, 1.5}) feed(state, settings, frontOf(1), ms);
    EXPECT_EQ(state.vTimeMs, 2.0);
    feed(state, settings, frontOf(1), 0.5);  // actual = O
    feed(state, settings, frontOf(0), 9.0);  // empty front
    feed(state, settings, frontOf(1), 3.5);  // median of 4, 1, 3
    EXPECT_EQ(state.vTimeMs, 3.0);
}

// --- the second loop: T = 30 ms, so the marks are 27 and 31.5 ms. ---
FrameFeatures shareFrame(std::uint32_t refused, bool onlyRoots = false) {
    return {.frame = 1,
            .frontCost = 100.0,
            .estimateMs = 20.0,
            .refusedGroups = refused,
            .onlyRoots = onlyRoots,
            .shareFeedback = true};
}

double scaleAfter(double actualMs, const FrameFeatures& features,
                  const ControlSettings& settings = plainControl()) {
    ControlState state = startedAt(0.25, 2.0);
    feed(state, settings, features, actualMs);
    return state.shareScale;
}

TEST(ShareTime, RisesWhileTimeIsLeftAndALoadedGroupWasRefused) {
    EXPECT_DOUBLE_EQ(scaleAfter(26.9, shareFrame(1)), 1.01);
    EXPECT_EQ(scaleAfter(27.0, shareFrame(1)), 1.0);
    EXPECT_EQ(scaleAfter(26.9, shareFrame(0)), 1.0) << "nothing that is loaded could use more";
}

TEST(ShareTime, FallsWhileTheFrameTakesTooLong) {
    EXPECT_DOUBLE_EQ(scaleAfter(31.6, shareFrame(0)), 0.99);
    EXPECT_DOUBLE_EQ(scaleAfter(31.6, shareFrame(5)), 0.99);
    EXPECT_EQ(scaleAfter(31.5, shareFrame(0)), 1.0);
    EXPECT_EQ(scaleAfter(29.0, shareFrame(5)), 1.0) << "between the marks nothing moves";
}

TEST(ShareTime, DoesNotFallWhereNothingButRootsIsDrawn) {
    EXPECT_EQ(scaleAfter(100.0, shareFrame(0, true)), 1.0);
    EXPECT_DOUBLE_EQ(scaleAfter(20.0, shareFrame(1, true)), 1.01) << "it may rise";
}

TEST(ShareTime, StandsStillWhereTheEffectIsOff) {
    FrameFeatures features = shareFrame(1);
    features.shareFeedback = false;
    EXPECT_EQ(scaleAfter(1.0, features), 1.0);
    EXPECT_EQ(scaleAfter(100.0, features), 1.0);
}

TEST(ShareTime, RisesAndFallsByGainsOfTheirOwn) {
    ControlSettings settings = plainControl();
    settings.shareGain = 0.25;
    settings.shareDrop = 0.125;
    EXPECT_EQ(scaleAfter(10.0, shareFrame(1), settings), 1.25);
    EXPECT_EQ(scaleAfter(50.0, shareFrame(1), settings), 0.875);
}

TEST(ShareTime, MovesInProportionToWhatTheTimeIsFromTheTarget) {
    ControlSettings settings = plainControl();
    settings.shareProportional = true;
    settings.shareGain = 0.25;
    settings.shareDrop = 0.5;
    EXPECT_EQ(scaleAfter(7.5, shareFrame(1), settings), 1.1875);  // a quarter of T: 0.75 * 0.25
    EXPECT_EQ(scaleAfter(37.5, shareFrame(1), settings), 0.875);  // 1.25 T: 0.25 * 0.5
    EXPECT_EQ(scaleAfter(60.0, shareFrame(1), settings), 0.5);    // 2 T: all of it
    EXPECT_EQ(scaleAfter(6000.0, shareFrame(1), settings), 0.5);  // and never more
    EXPECT_EQ(scaleAfter(27.0, shareFrame(1), settings), 1.0);    // the marks stay where they are
    EXPECT_EQ(scaleAfter(31.5, shareFrame(1), settings), 1.0);
}

TEST(ShareTime, SeesTheMedianGatesTime) {
    ControlSettings settings = plainControl();
    settings.medianGate = true;
    ControlState state = startedAt(0.25, 2.0);
    for (int i = 0; i < 3; ++i) feed(state, settings, shareFrame(1), 29.0);
    feed(state, settings, shareFrame(1), 500.0);
    EXPECT_EQ(state.shareScale, 1.0);
    // The marginal time of the frames before, at this front's cost: 2 + 0.27 * 150 = 42.5 ms, whatever this
    // one took.
    FrameFeatures larger = shareFrame(1);
    larger.frontCost = 150.0;
    feed(state, settings, larger, 10.0);
    EXPECT_DOUBLE_EQ(state.shareScale, 0.99);
}

TEST(ShareTime, KeepsToItsLimits) {
    ControlSettings settings = plainControl();
    settings.shareGain = settings.shareDrop = 0.5;
    settings.shareLimit = 4.0;
    ControlState state = startedAt(0.25, 2.0);
    for (double expected : {1.5, 2.25, 3.375, 4.0, 4.0}) {
        feed(state, settings, shareFrame(1), 10.0);
        EXPECT_EQ(state.shareScale, expected);
    }
    for (double expected : {2.0, 1.0, 0.5, 0.25, 0.125, 0.1, 0.1}) {
        feed(state, settings, shareFrame(1), 100.0);
        EXPECT_EQ(state.shareScale, expected);
    }
    settings.shareLimit = 1.0;
    state.shareScale = 3.0;
    feed(state, settings, shareFrame(0), 29.0);
    EXPECT_EQ(state.shareScale, 1.0) << "a lowered limit holds at once";
}

TEST(ShareTime, IsAMultipleOfTheTargetLessTheOverheadSoThatANewTargetActsAtOnce) {
    ControlSettings settings = plainControl();
    ControlState state = startedAt(0.25, 2.0);
    state.shareScale = 1.5;
    EXPECT_EQ(shareMs(state, settings), 42.0);
    settings.targetMs = 12.0;
    EXPECT_EQ(shareMs(state, settings), 15.0);
}

TEST(Feasible, IsNotAFrontOfNothingButRootsThatTakesLongerThanTheTarget) {
    ControlState state = startedAt(0.25, 2.0);
    FrameFeatures features = shareFrame(0, true);
    features.estimateMs = 30.5;
    feed(state, plainControl(), features, 30.5);
    EXPECT_TRUE(state.infeasible);
    features.onlyRoots = false;
    feed(state, plainControl(), features, 30.5);
    EXPECT_FALSE(state.infeasible);
    features.onlyRoots = true;
    features.estimateMs = 30.0;
    feed(state, plainControl(), features, 30.0);
    EXPECT_FALSE(state.infeasible);
}

TEST(Feasible, IsTheSkyAgainAfterRootsThatWereNot) {
    ControlState state = startedAt(0.25, 2.0);
    FrameFeatures features = shareFrame(0, true);
    features.estimateMs = 30.5;
    feed(state, plainControl(), features, 30.5);
    ASSERT_TRUE(state.infeasible);
    feed(state, plainControl(), {.frame = 2, .frontCost = 0.0, .estimateMs = 2.0, .onlyRoots = true},
             2.0);
    EXPECT_FALSE(state.infeasible);
}

// --- timings that come late ---
TEST(FeatureRing, PairsATimingWithItsFrameUpToFifteenFramesLater) {
    FeatureRing ring;
    for (std::uint64_t frame = 1; frame <= 40; ++frame) {
        ring.push({.frame = frame, .frontCost = 10.0 * static_cast<double>(frame)});
        for (std::uint64_t late = 0; late < 16 && late < frame; ++late) {
            const FrameFeatures* found = ring.find(frame - late);
            ASSERT_NE(found, nullptr);
            EXPECT_EQ(found->frontCost, 10.0 * static_cast<double>(frame - late));
        }
        if (frame > 16) {
            EXPECT_EQ(ring.find(frame - 16), nullptr) << "too old";
        }
        EXPECT_EQ(ring.find(frame + 1), nullptr) << "yet to come";
    }
}

TEST(FeatureRing, HoldsNothingBeforeTheFirstFrame) {
    const FeatureRing ring;
    for (std::uint64_t frame = 0; frame < 20; ++frame) EXPECT_EQ(ring.find(frame), nullptr) << frame;
}

TEST(FeatureRing, KnowsFramesBeyond32Bits) {
    FeatureRing ring;
    ring.push({.frame = 0x100000005ull, .frontCost = 7.0});
    ASSERT_NE(ring.find(0x100000005ull), nullptr);
    EXPECT_EQ(ring.find(5), nullptr);
}

// --- whatever is measured ---
RC_GTEST_PROP(FeedBack, KeepsEveryNumberFiniteAndInItsLimits, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    Settings settings;
    randomiseGroup(r, settings, "control");
    const double odd[] = {
        0.0, -1.0, 1e-300, 1e300, HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::quiet_NaN(), 1.0};
    ControlState state =
        startedAt(std::pow(10.0, r.uniform(-7.0, 2.0)), r.index(3) == 0 ? 0.0 : r.uniform(0.0, 50.0));
    for (int i = 0; i < 100; ++i) {
        const bool strange = r.index(4) == 0;
        const double actualMs = strange ? odd[r.index(std::size(odd))] : std::pow(10.0, r.uniform(-6.0, 5.0));
        FrameFeatures features{.frame = static_cast<std::uint64_t>(i + 1)};
        features.frontCost = r.index(5) == 0 ? 0.0 : std::pow(10.0, r.uniform(0.0, 9.0));
        features.estimateMs = estimateMs(state, features.frontCost);
        features.refusedGroups = static_cast<std::uint32_t>(r.index(2));
        features.onlyRoots = r.index(2) == 0;
        features.shareFeedback = r.index(2) == 0;
        feed(state, settings.control, features, actualMs);
        RC_ASSERT(state.vTimeMs >= state.calibratedMs / 8.0);
        RC_ASSERT(state.vTimeMs <= state.calibratedMs * 8.0);
        RC_ASSERT(state.shareScale >= 0.1);
        RC_ASSERT(state.shareScale <= settings.control.shareLimit);
        RC_ASSERT(std::isfinite(shareMs(state, settings.control)));
        RC_ASSERT(shareMs(state, settings.control) > 0.0);
    }
}

// Halving the unit of cost doubles every cost: v_time halves, and a front is estimated as before.
TEST(RescaleCost, KeepsEstimates) {
    ControlState state = startedAt(2e-4, 3.0);
    state.vTimeMs = 4e-4;
    state.marginal.recent = {1e-4, 2e-4, 3e-4};
    const double before = estimateMs(state, 1000.0);
    rescaleCost(state, 2.0);
    EXPECT_DOUBLE_EQ(estimateMs(state, 2000.0), before);
    EXPECT_DOUBLE_EQ(state.calibratedMs, 1e-4);
    EXPECT_DOUBLE_EQ(state.marginal.recent[2], 1.5e-4);
    const ControlState kept = state;
    for (const double ratio : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        rescaleCost(state, ratio);
        EXPECT_EQ(state.vTimeMs, kept.vTimeMs);
    }
}

}  // namespace
}  // namespace fb
