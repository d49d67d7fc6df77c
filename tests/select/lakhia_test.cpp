// Policy `lakhia` by hand: slices, counters and fronts worked out on paper over several frames (thesis 4.2,
// algorithms 2). Priorities are benefit / cost, v_time is 1 ms per unit of cost, everything is 1 m ahead
// (worlds/tiny_walk.h).
#include <gtest/gtest.h>

#include "worlds/tiny_walk.h"

namespace fb {
namespace {

//      0          cost 1
//     / \         .
//    1   2        costs 1, 2; priorities 3, 1
std::vector<TinyNode> pair() {
    return {{.cost = 1, .children = {{.cost = 1, .benefit = 3}, {.cost = 2, .benefit = 2}}}};
}

TEST(Lakhia, SharesTheParentsSliceByPriorityAndCountsTheRelativeSurplus) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.settings.hystSwitch = 2;
    walk.settings.hystLimit = 6;
    walk.shareMs = 8;
    // Root: (8 - 1) / 1 = 7, limited to 6. Slices 6 and 2, needs 1 and 2: 5 and 0. Sum: trunc(5/2) + 0 = 2.
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{6, 5, 0}));
    // The limit: 5 + 5 is cut to 6.
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{6, 6, 0}));
}

TEST(Lakhia, DrawsTheParentFromTheFrameOnInWhichTheTruncatedSumFallsBelowZero) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.settings.hystSwitch = 2;
    walk.settings.hystLimit = 6;
    walk.shareMs = 1;
    // Slices 0.75 and 0.25, needs 1 and 2: -0.25 and -0.875 a frame. trunc(-1.75 / 2) is still 0,
    // trunc(-2.625 / 2) -1.
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.step(), (Front{1, 2}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{0, -0.5, -1.75}));
    EXPECT_EQ(walk.counters().refusedGroups, 0u);
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{0, -0.75, -2.625}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::time);  // 3 ms needed, 1 ms given
    EXPECT_EQ(walk.counters().refusedGroups, 1u);
    EXPECT_EQ(walk.counters().togglesDown, 1u);
    // The counters of a refused group go on moving down to the limit.
    for (int i = 0; i < 40; ++i) walk.step();
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{0, -6, -6}));
}

TEST(Lakhia, AGroupThatFitsButMustWaitIsBoundByHysteresis) {
    TinyWalk walk(pair(), PolicyId::lakhia);
    walk.settings.hystSwitch = 1;
    walk.settings.hystLimit = 8;
    walk.state.hysteresis = {0, -8, -8};
    walk.shareMs = 8;  // slices 6 and 2, needs 1 and 2: the first rises by 5 a frame, the second stays
    EXPECT_EQ(walk.step(), (Front{0}));  // -3 - 8
    EXPECT_EQ(walk.boundBy(0), BoundBy::hysteresis);
    EXPECT_EQ(walk.step(), (Front{0}));  // 2 - 8
    EXPECT_EQ(walk.step(), (Front{0}));  // 7 - 8
    EXPECT_EQ(walk.state.hysteresis[1], 7.0);
    EXPECT_EQ(walk.step(), (Front{1, 2}));  // 8 - 8 = 0
}

//       0
//    / | | \      four siblings of equal priority: costs 1, 8, 8, 8
//   1  2 3  4
TEST(Lakhia, OneCheapSiblingMayOutvoteThreeDearOnesForAWhile) {
    const TinyNode dear{.cost = 8, .benefit = 8};
    TinyWalk walk({{.children = {{.cost = 1, .benefit = 1}, dear, dear, dear}}}, PolicyId::lakhia);
    walk.settings.hystSwitch = 4;
    walk.settings.hystLimit = 16;
    walk.vTimeMs = 1.0 / 16;
    walk.shareMs = 1;
    // Slices 1/4; needs 1/16 and 1/2, together 25/16 of what there is. Ratios 3 and -1/2: the sum of ratios
    // is not the ratio of sums. The cheap one reaches its limit, 4 votes, in frame 6; the others vote -1 each
    // from frame 8 and -2 each from frame 16 on.
    EXPECT_EQ(walk.framesUntil({0}, 100), 16);
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{16, 16, -8, -8, -8}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::time);
}

//         0         slices: 0 has 16
//       /   \       1 has 12 (priority 3 of 4), 2 has 4
//      1     2
//     / \    |      3 has 4 (1 of 3), 4 has 8; 5 has 4
//    3   4   5
std::vector<TinyNode> threeLevels() {
    return {
        {.cost = 1,
         .children = {
             {.cost = 2, .benefit = 6, .children = {{.cost = 4, .benefit = 4}, {.cost = 2, .benefit = 4}}},
             {.cost = 1, .benefit = 1, .children = {{.cost = 8}}}}}};
}

TEST(Lakhia, HandsSlicesDownLevelByLevel) {
    TinyWalk walk(threeLevels(), PolicyId::lakhia);
    walk.settings.hystSwitch = 1;
    walk.settings.hystLimit = 4;
    walk.shareMs = 16;
    EXPECT_EQ(walk.step(), (Front{3, 4, 5}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{4, 4, 3, 0, 3, -0.5}));
    EXPECT_EQ(walk.selection.frontCost, 14.0);
    EXPECT_EQ(walk.selection.triangles, 28u);
    EXPECT_EQ(walk.selection.texturedTriangles, 28u);
    EXPECT_EQ(walk.step(), (Front{2, 3, 4}));  // the counter of 5 reached -1
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{4, 4, 4, 0, 4, -1}));
    EXPECT_EQ(walk.selection.frontCost, 7.0);
    EXPECT_EQ(walk.boundBy(2), BoundBy::time);
    EXPECT_EQ(walk.boundBy(3), BoundBy::leaf);
}

TEST(Lakhia, VisitsBreadthFirstAndTheChildrenOfTheFrontToo) {
    TinyWalk walk(threeLevels(), PolicyId::lakhia);
    walk.settings.hystSwitch = 1;
    walk.settings.hystLimit = 4;
    walk.shareMs = 16;
    walk.step();
    walk.step();
    std::vector<NodeId> order;
    for (const Reached& r : walk.selection.reached) order.push_back(r.node);
    EXPECT_EQ(order, (std::vector<NodeId>{0, 1, 2, 3, 4}));
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{2, 3, 4}));
    EXPECT_EQ(walk.counters().visited, 6u);  // 5 was looked at before it was refused
    EXPECT_EQ(walk.counters().boundBy[static_cast<int>(BoundBy::time)], 1u);
    EXPECT_EQ(walk.counters().boundBy[static_cast<int>(BoundBy::leaf)], 2u);
}

TEST(Lakhia, CountersBelowTheFrontStandStill) {
    TinyWalk walk(threeLevels(), PolicyId::lakhia);
    walk.settings.hystSwitch = 1;
    walk.settings.hystLimit = 4;
    walk.state.hysteresis = {0, -4, -4, 1.5, -2.5, 0.25};
    walk.shareMs = 1;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.state.hysteresis[3], 1.5);
    EXPECT_EQ(walk.state.hysteresis[4], -2.5);
    EXPECT_EQ(walk.state.hysteresis[5], 0.25);
    EXPECT_EQ(walk.counters().visited, 3u);
}

//    0   1      two roots
//    |   |
//    2   3
std::vector<TinyNode> twoRoots() {
    return {{.benefit = 3, .children = {{.cost = 2}}}, {.benefit = 1, .children = {{.cost = 2}}}};
}

TEST(Lakhia, AllVisibleRootsAreOneGroupAndTheirCountersNeverStopTheDescent) {
    TinyWalk walk(twoRoots(), PolicyId::lakhia);
    walk.settings.hystSwitch = 1;
    walk.settings.hystLimit = 4;
    walk.state.hysteresis = {-4, -4, 0, 0};
    walk.shareMs = 8;
    // Slices 6 and 2; needs of the children 2: +2 and 0. The roots' own sum is 4 - 4 + ... but nobody asks.
    EXPECT_EQ(walk.step(), (Front{2, 3}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{1, -3, 2, 0}));
    walk.state.hysteresis = {-4, -4, 0, 0};
    walk.shareMs = 1;  // the roots get 0.75 and 0.25 of the 1 they need, their children of the 2 they need
    EXPECT_EQ(walk.step(), (Front{2, 3}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{-4, -4, -0.625, -0.875}));
}

TEST(Lakhia, ARootOutOfViewTakesNoShareAndItsCounterStandsStill) {
    std::vector<TinyNode> roots = twoRoots();
    roots[1].box = roots[1].children[0].box = aside();
    TinyWalk walk(roots, PolicyId::lakhia);
    walk.shareMs = 8;
    EXPECT_EQ(walk.step(), (Front{2}));
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{7, 0, 3, 0}));
    EXPECT_EQ(walk.counters().visited, 3u);
}

// --- start value and band: one root with one child, so that the ratio is share / need - 1. ---
TinyWalk single(double start, bool band) {
    SelectSettings settings = plainSettings(PolicyId::lakhia);
    settings.hystSwitch = 2;
    settings.hystLimit = 6;
    settings.hystStart = start;
    settings.hystBand = band;
    return {makeWorld({{.children = {{.cost = 1}}}}), settings};
}

TEST(HysteresisStart, AsPrintedAcceptsAGroupThatDoesNotFitUntilItsCounterHasFallen) {
    TinyWalk walk = single(0.0, false);
    walk.shareMs = 0.5;  // -0.5 a frame: -2 in frame 4
    EXPECT_EQ(walk.step(), (Front{1}));
    EXPECT_EQ(walk.framesUntil({0}, 10), 3);
}

TEST(HysteresisStart, AtMinusOneRefusesAGroupThatDoesNotFitFromTheFirstFrameOn) {
    TinyWalk walk = single(-1.0, false);
    EXPECT_EQ(walk.state.hysteresis, (std::vector<double>{-2, -2}));
    walk.shareMs = 0.5;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.state.hysteresis[1], -2.5);
}

TEST(HysteresisStart, AtMinusOneWithoutBandAcceptsAtTheFirstSurplus) {
    TinyWalk walk = single(-1.0, false);
    walk.shareMs = 1.5;  // -2 + 0.5: trunc(-0.75) = 0
    EXPECT_EQ(walk.step(), (Front{1}));
}

TEST(HysteresisBand, HoldsTheParentAtASumOfZeroUntilTheSumIsOne) {
    TinyWalk walk = single(-1.0, true);
    walk.shareMs = 2;  // +1 a frame: -1, 0, 1, 2
    EXPECT_EQ(walk.framesUntil({1}, 10), 4);
    EXPECT_EQ(walk.state.hysteresis[1], 2.0);
    EXPECT_EQ(walk.counters().togglesUp, 1u);
}

TEST(HysteresisBand, HoldsTheChildrenAtASumOfZeroUntilTheSumIsMinusOne) {
    TinyWalk walk = single(-1.0, true);
    walk.shareMs = 2;
    ASSERT_EQ(walk.framesUntil({1}, 10), 4);
    walk.targetMs = 0;
    walk.shareMs = 0;  // -1 a frame: 1, 0, -1, -2
    EXPECT_EQ(walk.framesUntil({0}, 10), 4);
    EXPECT_EQ(walk.state.hysteresis[1], -2.0);
}

TEST(HysteresisBand, WithoutItUpAndDownSwitchAtTheSameThreshold) {
    TinyWalk walk = single(0.0, false);
    walk.targetMs = 0;
    walk.shareMs = 0;                         // -1 a frame
    EXPECT_EQ(walk.framesUntil({0}, 10), 2);  // at -2
    walk.shareMs = 1.0625;                    // +1/16
    EXPECT_EQ(walk.framesUntil({1}, 10), 1);  // at -1.9375
}

TEST(HysteresisBand, TakesTheParentWhereTheNodeWasNotReachedTheFrameBefore) {
    TinyWalk walk = single(0.0, true);
    walk.shareMs = 1;  // a ratio of 0: the sum stays 0
    EXPECT_EQ(walk.step(), (Front{0}));
    walk.state.hysteresis[1] = 2.0;
    EXPECT_EQ(walk.step(), (Front{1}));
    walk.state.hysteresis[1] = 1.0;
    EXPECT_EQ(walk.step(), (Front{1})) << "held";
    walk.view = makeView(lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), glm::dvec3(0.0), 100, 100);
    EXPECT_EQ(walk.step(), (Front{}));
    walk.view = tinyView();
    EXPECT_EQ(walk.step(), (Front{0})) << "what was drawn two frames ago is not held";
    EXPECT_EQ(walk.counters().togglesDown, 0u);
}

// --- frames per switch: the printed constants are frames of the ratio, or of percent (algorithms 2.3). ---
struct SwitchRow {
    const char* name;
    double hystSwitch, hystLimit, unit, startCounter, shareMs;
    Front wanted;
    int frames;
};

class FramesPerSwitch : public testing::TestWithParam<SwitchRow> {};

TEST_P(FramesPerSwitch, AreThoseWorkedOut) {
    const SwitchRow& row = GetParam();
    TinyWalk walk = single(0.0, false);
    walk.settings.hystSwitch = row.hystSwitch;
    walk.settings.hystLimit = row.hystLimit;
    walk.settings.hystUnit = row.unit;
    walk.state.hysteresis[1] = row.startCounter;
    walk.targetMs = 0;  // lets a share of 0 through
    walk.shareMs = row.shareMs;
    EXPECT_EQ(walk.framesUntil(row.wanted, 30000), row.frames);
}

INSTANTIATE_TEST_SUITE_P(
    Hysteresis, FramesPerSwitch,
    testing::Values(SwitchRow{"PrintedDownAtMinusOne", 1500, 4510, 1, 4510, 0, {0}, 6010},
                    SwitchRow{"PrintedDownAtMinusAQuarter", 1500, 4510, 1, 4510, 0.75, {0}, 24040},
                    SwitchRow{"PrintedUpAtPlusOne", 1500, 4510, 1, -4510, 2, {1}, 3011},
                    SwitchRow{"PrintedUpAtPlusTen", 1500, 4510, 1, -4510, 11, {1}, 302},
                    SwitchRow{"PercentDownAtMinusOne", 1500, 4510, 100, 4510, 0, {0}, 61},
                    SwitchRow{"PercentDownAtMinusAQuarter", 1500, 4510, 100, 4510, 0.75, {0}, 241},
                    SwitchRow{"PercentUpAtPlusOne", 1500, 4510, 100, -4510, 2, {1}, 31},
                    SwitchRow{"PercentUpAtPlusTen", 1500, 4510, 100, -4510, 11, {1}, 4},
                    SwitchRow{"RatioDownAtMinusOne", 3, 9, 1, 9, 0, {0}, 12},
                    SwitchRow{"RatioDownAtMinusAQuarter", 3, 9, 1, 9, 0.75, {0}, 48},
                    SwitchRow{"RatioUpAtPlusOne", 3, 9, 1, -9, 2, {1}, 7},
                    SwitchRow{"RatioUpAtPlusTen", 3, 9, 1, -9, 11, {1}, 1}),
    [](const auto& row) { return std::string(row.param.name); });

// --- loading ---
TEST(LakhiaLoading, CountersMoveWhetherOrNotTheGroupIsLoaded) {
    TinyWalk walk = single(0.0, false);
    walk.shareMs = 2;
    walk.loaded[1] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load);
    EXPECT_EQ(walk.state.hysteresis[1], 1.0);
    EXPECT_EQ(walk.counters().refusedGroups, 0u) << "a group that is not loaded was not refused";
    walk.refused[1] = 1;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::memory);
    walk.loaded[1] = 1;
    EXPECT_EQ(walk.step(), (Front{1})) << "what is loaded may be drawn, whatever the last plan said";
}

TEST(LakhiaLoading, AMissingGroupThatDoesNotFitEitherIsBoundByTimeAndWasNotRefused) {
    TinyWalk walk = single(-1.0, false);
    walk.shareMs = 0.5;
    walk.loaded[1] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::time);
    EXPECT_EQ(walk.counters().refusedGroups, 0u);
}

//      0
//     / \        1 in view, 2 out of it and not loaded
//    1   2
TEST(LakhiaLoading, VisibleChildrenAreEnoughOnlyWhereTheSettingSaysSo) {
    TinyWalk walk({{.children = {{}, {.box = aside()}}}}, PolicyId::lakhia);
    walk.shareMs = 2;
    walk.loaded[2] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load);
    walk.settings.needAllChildren = false;
    EXPECT_EQ(walk.step(), (Front{1}));
    walk.loaded = {1, 0, 1};
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load);
    walk.refused[2] = 1;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load) << "the refused sibling is out of view and not needed";
}

TEST(LakhiaLoading, NeverLooksBelowAGroupThatIsNotDrawn) {
    TinyWalk walk(threeLevels(), PolicyId::lakhia);
    walk.shareMs = 100;
    walk.loaded[2] = 0;  // 1 and its children are loaded
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.counters().visited, 3u);
}

}  // namespace
}  // namespace fb
