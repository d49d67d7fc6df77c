// The table of hard cases (core/algorithms.md section 5), as far as it is about selecting: one test a row,
// named by its number. Cases 9 to 11, 17, 18, 20 and 21 are about the feedback too:
// tests/control/hard_cases_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "select/priority.h"
#include "settings/knob_table.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

//      0
//     / \        .
//    1   2
std::vector<TinyNode> pair() {
    return {{.children = {{}, {}}}};
}

TEST(HardCase, Nr01ANodeThatNeedsNoTimeCountsAsOneTriangle) {
    TinyWalk walk({{.children = {{.cost = 0}, {.cost = 0, .benefit = 0}}}}, PolicyId::lakhia);
    walk.shareMs = 4;
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.selection.frontCost, 2.0);
    EXPECT_EQ(walk.state.hysteresis[0], 3.0);
    walk.state.reset(walk.hierarchy, walk.settings);
    walk.vTimeMs =
        0;  // and a v_time of nothing gives a ratio that is large but finite: the counter goes to its limit
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.state.hysteresis[0], walk.settings.hystLimit);
    EXPECT_EQ(walk.counters().repairedCounters, 0u);
}

TEST(HardCase, Nr02ACameraInsideTheBoxIsTheSmallestDistanceAway) {
    const Box3f around = boxOf({-5, -5, -5}, {5, 5, 5});
    TinyWalk walk(
        {{.cost = 2, .box = around, .children = {{.cost = 1, .benefit = 3, .box = around}, {.cost = 1}}}},
        PolicyId::lakhia);
    walk.shareMs = 8;
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    // Slices 6 and 2 of 8: the box around the eye is d_min = 1 m away like the other one.
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{3, 5, 1}));
}

// Two walls that face the camera and two that turn their backs, c_fore = 3: as printed the priorities are 4,
// 4, -2, -2 and slices negative.
TEST(HardCase, Nr03AForeshorteningWeightOfOneOrMoreIsRefusedAndCannotTurnPrioritiesNegative) {
    Settings settings;
    const Knob* knob = findKnob("select.c_fore");
    ASSERT_NE(knob, nullptr);
    EXPECT_FALSE(admit(settings, *knob, 1.0, "test"));
    EXPECT_EQ(settings.select.cFore, 0.45);

    const TinyNode facing{.normal = {0, 0, 1}}, away{.normal = {0, 0, -1}};
    TinyWalk walk({{.children = {facing, facing, away, away}}}, PolicyId::lakhia);
    walk.effects[Effect::foreshortening] = true;
    walk.settings.cFore = 3.0;
    walk.settings.needAllChildren = true;
    walk.shareMs = 8.1;  // 4 + 4 + 0.05 + 0.05
    walk.step();
    const double slices[] = {4.0, 4.0, 0.05, 0.05};
    for (NodeId n = 1; n <= 4; ++n) EXPECT_NEAR(walk.state.hysteresis[n], slices[n - 1] - 1.0, 1e-12);
}

TEST(HardCase, Nr04NodesWithoutAUsablePriorityShareEqually) {
    const float inf = std::numeric_limits<float>::infinity();
    TinyWalk walk({{.children = {{.benefit = 0}, {.benefit = -1}, {.benefit = NAN}, {.benefit = inf}}}},
                  PolicyId::lakhia);
    walk.shareMs = 8;  // 2 each, 1 needed
    EXPECT_EQ(walk.step(), (Front{1, 2, 3, 4}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{7, 1, 1, 1, 1}));
    EXPECT_EQ(walk.counters().repairedPriorities, 4u);
}

TEST(HardCase, Nr05ANodeWithoutAverageNormalIsNotForeshortened) {
    SelectSettings settings = plainSettings(PolicyId::lakhia);
    ActiveEffects effects;
    effects[Effect::foreshortening] = true;
    EffectWork work;
    const NodeView seen = lookAtNode(makeWorld({{.benefit = 7}}), 0, tinyView(), settings, effects, work);
    EXPECT_EQ(seen.priority, 7.0);
    EXPECT_FALSE(seen.repaired);
}

//       0
//    / | | \      1 in view, 2 to 4 out of it
//   1  2 3  4
TEST(HardCase, Nr06OneVisibleChildOfFourTakesTheWholeShareButNeedsItsSiblingsLoaded) {
    const TinyNode out{.cost = 9, .benefit = 100, .box = aside()};
    TinyWalk walk({{.children = {{}, out, out, out}}}, PolicyId::lakhia);
    walk.shareMs = 3;
    EXPECT_EQ(walk.step(), (Front{1}));
    EXPECT_EQ(walk.state.hysteresis,
              (std::vector<double>{2, 2, 0, 0, 0}));  // 3 of 1 needed; the others stand still
    EXPECT_EQ(walk.counters().visited, 5u);
    walk.settings.policy = PolicyId::lakhiaNaive;
    walk.shareMs = 1.5;
    EXPECT_EQ(walk.step(), (Front{1})) << "only the visible child's need counts";
    walk.loaded[4] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    walk.settings.policy = PolicyId::lakhia;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load);
}

TEST(HardCase, Nr07WithoutAVisibleChildTheParentIsDrawnAndNothingSwitches) {
    for (const Policy& each : policies()) {
        const PolicyId policy = each.id;
        TinyWalk walk({{.children = {{.box = aside()}, {.box = behind()}}}}, policy);
        walk.settings.hystStart = -1.0;
        walk.state.reset(walk.hierarchy, walk.settings);
        const double start = -walk.settings.hystSwitch;
        walk.shareMs = walk.targetMs = 100;
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(walk.step(), (Front{0}));
            EXPECT_EQ(walk.counters().togglesUp + walk.counters().togglesDown, 0u);
        }
        EXPECT_EQ(walk.boundBy(0), policy == PolicyId::coarse ? BoundBy::policy : BoundBy::view);
        EXPECT_EQ(walk.state.hysteresis[1], start);
        EXPECT_EQ(walk.state.hysteresis[2], start);
    }
}

TEST(HardCase, Nr08TheSkyIsAnEmptyFrontAndMovesNoCounter) {
    for (const Policy& each : policies()) {
        TinyWalk walk(pair(), each.id);
        walk.shareMs = 2.5;
        walk.step();
        const std::vector<double> before = walk.state.hysteresis;
        walk.view = makeView(lookAt({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), glm::dvec3(0.0), 100, 100);
        EXPECT_EQ(walk.step(), (Front{}));
        EXPECT_EQ(walk.state.hysteresis, before);
        EXPECT_EQ(walk.selection.frontCost, 0.0);
        EXPECT_EQ(walk.counters().visited, each.id == PolicyId::macielShirley ? 2u : 1u) << each.name;
        EXPECT_EQ(walk.counters().togglesDown, 0u);
    }
}

TEST(HardCase, Nr11ANegativeShareCountsAsATwentiethOfTheTarget) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.targetMs = 40;
    walk.shareMs = -25;
    walk.step();
    // Root: 2 of 1 needed; the children 1 each of 1 needed.
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{1, 0, 0}));
    walk.settings.policy = PolicyId::lakhiaNaive;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.state.shares, (std::vector<double>{2}));
}

TEST(HardCase, Nr12ACounterThatIsNoNumberStartsAgain) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.settings.hystStart = -1.0;
    walk.shareMs = 4;
    for (double bad :
         {kNan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        walk.state.hysteresis = {0, bad, 0};
        walk.step();
        EXPECT_EQ(walk.state.hysteresis[1], -walk.settings.hystSwitch);
        EXPECT_EQ(walk.state.hysteresis[2], 1.0);
        EXPECT_EQ(walk.counters().repairedCounters, 1u);
        walk.step();
        EXPECT_EQ(walk.counters().repairedCounters, 0u);
    }
}

TEST(HardCase, Nr13AHugeRatioIsClampedBeforeItIsTruncated) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.shareMs = 2e12;
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{45, 45, 45}));
    // One frame of it is forgotten in as many frames as the limit says: 45 + 15 of a ratio of -1.
    walk.targetMs = walk.shareMs = 0;
    EXPECT_EQ(walk.framesUntil({0}, 1000), 60);
}

TEST(HardCase, Nr14ANodeThatLeavesTheViewKeepsItsCounter) {
    TinyWalk walk({{.children = {{}, {.box = boxOf({-0.25f, -0.25f, -2.0f}, {0.25f, 0.25f, -1.5f})}}},
                   {.box = behind()}},
                  PolicyId::lakhia);
    walk.shareMs = 3.25;
    for (int i = 0; i < 5; ++i) walk.step();
    const std::vector<double> before = walk.state.hysteresis;
    EXPECT_EQ(before[0], 5 * 2.25);
    walk.view = makeView(lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), glm::dvec3(0.0), 100, 100);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(walk.step(), (Front{1}));
    EXPECT_EQ(walk.state.hysteresis[0], before[0]);
    EXPECT_EQ(walk.state.hysteresis[2], before[2]);
    EXPECT_EQ(walk.state.hysteresis[3], before[3]);
    walk.view = tinyView();
    walk.step();
    EXPECT_EQ(walk.state.hysteresis[0], 6 * 2.25);
}

TEST(HardCase, Nr19AChildEvictedWhileDrawnIsReplacedByItsParentInTheSameFrame) {
    for (PolicyId policy : {PolicyId::lakhia, PolicyId::lakhiaNaive, PolicyId::full}) {
        TinyWalk walk(pair(), policy);
        walk.shareMs = 4;
        EXPECT_EQ(walk.step(), (Front{1, 2}));
        walk.loaded[2] = 0;
        EXPECT_EQ(walk.step(), (Front{0}));
        EXPECT_EQ(walk.counters().togglesDown, 1u);
        EXPECT_EQ(walk.boundBy(0), BoundBy::load);
        EXPECT_EQ(walk.state.expanded[0], 0);
    }
}

TEST(HardCase, Nr19WithTheBandAnEvictedGroupThatReturnsHasToEarnItsPlaceAgain) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.settings.hystBand = true;
    walk.settings.hystSwitch = 2;
    walk.state.hysteresis = {0, 2, 0};
    walk.shareMs = 2;  // a ratio of 0: the sum stays 1
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    walk.state.hysteresis = {0, 1, 1};
    EXPECT_EQ(walk.step(), (Front{1, 2})) << "a sum of 0 holds the children";
    walk.loaded[1] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    walk.loaded[1] = 1;
    EXPECT_EQ(walk.step(), (Front{0})) << "a sum of 0 holds the parent";
}

TEST(HardCase, Nr21TheTimeStepChangesNothingThatIsCountedInFrames) {
    for (double dt : {0.0, 1e-5, 0.1, 2.0}) {
        TinyWalk walk(pair(), PolicyId::lakhia);
        walk.settings.hystSwitch = 2;
        walk.dtSeconds = dt;
        walk.shareMs = 1;  // ratios of -0.5: -2 in frame 4
        EXPECT_EQ(walk.framesUntil({0}, 10), 4);
    }
}

TEST(HardCase, Nr21FramesAreCountedBeyond32Bits) {
    TinyWalk walk(pair(), PolicyId::lakhiaNaive);
    walk.frame = 0xfffffffdull;
    walk.shareMs = 1;
    walk.step();
    for (int i = 0; i < 6; ++i) {
        walk.shareMs = i % 2 == 0 ? 3 : 1;
        walk.step();
        EXPECT_EQ(walk.counters().togglesUp, i % 2 == 0 ? 1u : 0u);
        EXPECT_EQ(walk.counters().togglesDown, i % 2 == 0 ? 0u : 1u);
        EXPECT_EQ(walk.counters().pingPongs, i == 0 ? 0u : 1u);
    }
    EXPECT_EQ(walk.frame, 0x100000004ull);
    EXPECT_EQ(walk.state.toggledFrame[0], 0x100000004ull);
}

}  // namespace
}  // namespace fb
