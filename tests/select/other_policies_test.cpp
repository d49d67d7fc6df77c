// Policies lakhia-naive, coarse and full on tiny worlds, and the table that names them.
#include <gtest/gtest.h>

#include <set>

#include "settings/knob_table.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

//         0         slices of a share of 16: 0 has 16; 1 has 12 and 2 has 4
//       /   \       3 has 4, 4 has 8; 5 has 4
//      1     2
//     / \    |
//    3   4   5
std::vector<TinyNode> threeLevels() {
    return {
        {.cost = 1,
         .children = {
             {.cost = 2, .benefit = 6, .children = {{.cost = 4, .benefit = 4}, {.cost = 2, .benefit = 4}}},
             {.cost = 1, .benefit = 1, .children = {{.cost = 8}}}}}};
}

TEST(LakhiaNaive, RefinesWhileTheChildrenNeedLessThanTheirParentsSlice) {
    TinyWalk walk(threeLevels(), PolicyId::lakhiaNaive);
    walk.shareMs = 16;
    EXPECT_EQ(walk.step(), (Front{2, 3, 4}));  // 3 of 16; 6 of 12; 8 of 4
    EXPECT_EQ(walk.boundBy(2), BoundBy::time);
    EXPECT_EQ(walk.counters().refusedGroups, 1u);
    EXPECT_EQ(walk.counters().visited, 6u);
    walk.shareMs = 7;
    EXPECT_EQ(walk.step(), (Front{1, 2}));  // 6 of 5.25
    EXPECT_EQ(walk.counters().refusedGroups, 2u);
    EXPECT_EQ(walk.selection.frontCost, 3.0);
}

TEST(LakhiaNaive, AGroupThatNeedsExactlyItsShareIsRefused) {
    TinyWalk walk(threeLevels(), PolicyId::lakhiaNaive);
    walk.shareMs = 3;
    EXPECT_EQ(walk.step(), (Front{0}));
    walk.shareMs = std::nextafter(3.0, 4.0);
    EXPECT_EQ(walk.step(), (Front{1, 2}));
}

TEST(LakhiaNaive, DrawsTheRootsEvenWhereTheyTakeLongerThanTheirShare) {
    TinyWalk walk({{.cost = 100, .children = {{.cost = 400}}}, {.cost = 50}}, PolicyId::lakhiaNaive);
    walk.shareMs = 30;
    EXPECT_EQ(walk.step(), (Front{0, 1}));
    EXPECT_EQ(walk.selection.frontCost, 150.0);
    EXPECT_EQ(walk.boundBy(0), BoundBy::time);
    EXPECT_EQ(walk.boundBy(1), BoundBy::leaf);
}

TEST(LakhiaNaive, CountsTheNeedOfVisibleChildrenAlone) {
    TinyWalk walk({{.children = {{.cost = 2}, {.cost = 50, .box = aside()}}}}, PolicyId::lakhiaNaive);
    walk.shareMs = 2.5;
    EXPECT_EQ(walk.step(), (Front{1}));
    walk.loaded[2] = 0;
    EXPECT_EQ(walk.step(), (Front{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::load);
    walk.refused[2] = 1;
    walk.step();
    EXPECT_EQ(walk.boundBy(0), BoundBy::memory);
    walk.settings.needAllChildren = false;
    EXPECT_EQ(walk.step(), (Front{1}));
}

TEST(LakhiaNaive, KeepsNoCounters) {
    TinyWalk walk(threeLevels(), PolicyId::lakhiaNaive);
    walk.shareMs = 16;
    for (int i = 0; i < 20; ++i) walk.step();
    EXPECT_EQ(walk.state.hysteresis, std::vector<double>(6, 0.0));
}

TEST(Coarse, DrawsTheVisibleRootsAndSaysThatThePolicyStopsThere) {
    TinyWalk walk({{.children = {{}}}, {.box = aside()}, {}, {.box = behind()}}, PolicyId::coarse);
    walk.shareMs = 1000;
    EXPECT_EQ(walk.step(), (Front{0, 2}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::policy);
    EXPECT_EQ(walk.boundBy(2), BoundBy::leaf);
    EXPECT_EQ(walk.counters().visited, 4u);
    EXPECT_EQ(walk.counters().refusedGroups, 0u);
}

TEST(Full, DrawsEveryLeafInViewWhateverItCosts) {
    TinyWalk walk(threeLevels(), PolicyId::full);
    walk.shareMs = 0.001;
    EXPECT_EQ(walk.step(), (Front{3, 4, 5}));
    EXPECT_EQ(walk.boundBy(5), BoundBy::leaf);
    EXPECT_EQ(walk.counters().visited, 6u);
}

TEST(Full, IsCoarserOnlyWhereChildrenAreNotLoaded) {
    TinyWalk walk(threeLevels(), PolicyId::full);
    walk.loaded[4] = 0;
    EXPECT_EQ(walk.step(), (Front{1, 5}));
    EXPECT_EQ(walk.boundBy(1), BoundBy::load);
    walk.refused[4] = 1;
    EXPECT_EQ(walk.step(), (Front{1, 5}));
    EXPECT_EQ(walk.boundBy(1), BoundBy::memory);
}

TEST(Full, LeavesOutWhatIsOutOfView) {
    TinyWalk walk({{.children = {{}, {.box = aside()}, {.box = behind()}}}, {.box = aside()}},
                  PolicyId::full);
    EXPECT_EQ(walk.step(), (Front{2}));
}

TEST(Policies, HaveTheNamesOfTheKnobInItsOrder) {
    const Knob* knob = findKnob("select.policy");
    ASSERT_NE(knob, nullptr);
    ASSERT_EQ(knob->choices.size(), policies().size());
    for (std::size_t i = 0; i < policies().size(); ++i) {
        const auto id = static_cast<PolicyId>(i);
        EXPECT_EQ(policyOf(id).id, id);
        EXPECT_EQ(policyOf(id).name, knob->choices[i]);
        EXPECT_FALSE(policyOf(id).help.empty());
    }
    EXPECT_TRUE(policyOf(PolicyId::lakhia).usesShareTime);
    EXPECT_TRUE(policyOf(PolicyId::lakhiaNaive).usesShareTime);
    EXPECT_FALSE(policyOf(PolicyId::coarse).usesShareTime);
    EXPECT_FALSE(policyOf(PolicyId::full).usesShareTime);
}

TEST(Policies, ReasonsHaveTheNamesOfTheReport) {
    std::set<std::string_view> names;
    for (int i = 0; i < kBoundByCount; ++i) names.insert(boundByName(static_cast<BoundBy>(i)));
    EXPECT_EQ(names, (std::set<std::string_view>{"leaf", "time", "load", "hysteresis", "memory", "policy", "view"}));
    EXPECT_EQ(boundByName(BoundBy::hysteresis), "hysteresis");
    EXPECT_EQ(boundByName(BoundBy::memory), "memory");
}

TEST(SelectFrontDeathTest, StopsOnSnapshotsOfAnotherHierarchy) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    TinyWalk walk(threeLevels(), PolicyId::lakhia);
    walk.refused.pop_back();
    EXPECT_DEATH(walk.step(), "memoryRefused.size.. == .* \\(5 against 6\\)");
    walk.refused.push_back(0);
    walk.loaded.push_back(1);
    EXPECT_DEATH(walk.step(), "loaded.size.. == .* \\(7 against 6\\)");
    walk.loaded.pop_back();
    walk.state.expanded.clear();
    EXPECT_DEATH(walk.step(), "expanded.size.. == .* \\(0 against 6\\)");
}

}  // namespace
}  // namespace fb
