// Planning around nodes that could not be loaded.
#include <gtest/gtest.h>

#include "plan_worlds.h"

namespace fb::test {
namespace {

TEST(PlanLoads, WaitsForTheRetryOfAFailedNode) {
    World w = fourGroups();
    w.setBudget(600);
    w.planFrame();
    ASSERT_EQ(w.wished(), (Nodes{4, 5}));
    w.nowSeconds = 10.0;
    w.residency.setFailed(w.hierarchy, 4, 10.0);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{5})) << "what is under way goes on";
    w.deliver(5);
    w.nowSeconds = 10.4375;
    w.planFrame();
    EXPECT_TRUE(w.plan.wishes.empty());
    EXPECT_FALSE(w.plan.everythingLoaded);
    w.nowSeconds = 10.5;
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{4}));
}

TEST(PlanLoads, LoadsNoSiblingsWhileOneMayNotBeRetried) {
    World w = fourGroups();
    w.planFrame();
    w.residency.setFailed(w.hierarchy, 4, 0.0);
    w.residency.setUnloaded(w.hierarchy, 5);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{6, 7, 8, 9, 10, 11}));
    w.nowSeconds = 0.5;
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{4, 5, 6, 7, 8, 9, 10, 11}));
}

void failForGood(World& w, NodeId node) {
    while (w.residency.state[node] != NodeState::failed) {
        if (!w.residency.isInFlight(node)) w.residency.reserve(w.hierarchy, node);
        w.residency.setFailed(w.hierarchy, node, w.nowSeconds);
    }
}

TEST(PlanLoads, GivesUpAGroupThatCanNeverBeComplete) {
    World w = fourGroups();
    w.planFrame();
    failForGood(w, 4);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{6, 7, 8, 9, 10, 11})) << "5 is stopped: without 4 it is of no use";
    w.deliverAll();
    w.nowSeconds = 1e6;
    w.planFrame();
    EXPECT_TRUE(w.plan.wishes.empty());
    EXPECT_TRUE(w.plan.everythingLoaded) << "nothing is left that could be loaded";
    EXPECT_TRUE(w.refusedNodes().empty());
}

TEST(PlanLoads, TakesTheMemoryOfAUselessGroupFirst) {
    World w = fourGroups();
    w.setBudget(800);
    w.planFrame();
    w.deliver(5);
    w.deliver(6);
    w.deliver(7);
    failForGood(w, 4);
    w.planFrame();  // 5 is of no use although its priority is the greatest; 100 bytes are free, {8, 9} needs
                    // 200
    EXPECT_EQ(w.plan.evicted, (Nodes{5}));
    EXPECT_EQ(w.wished(), (Nodes{8, 9}));
}

TEST(PlanLoads, KeepsWhatIsThereOfABrokenGroupWhenVisibleChildrenAreEnough) {
    World w = fourGroups();
    w.select.needAllChildren = false;
    w.setBudget(800);
    w.planFrame();
    w.deliver(5);
    w.deliver(6);
    w.deliver(7);
    failForGood(w, 4);
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
    EXPECT_TRUE(w.plan.wishes.empty());
    EXPECT_EQ(w.refusedNodes(), (Nodes{8, 9, 10, 11}));
}

//    0 - {1, 2};  1 - {3};  when 2 is lost, 3 can never be drawn
TEST(PlanLoads, LoadsNothingBelowAnIncompleteGroup) {
    World w({{kRoot, 1, 100}, {0, 4, 100}, {0, 4, 100}, {1, 2, 100}});
    w.planFrame();
    w.deliver(1);
    failForGood(w, 2);
    w.planFrame();
    EXPECT_TRUE(w.plan.wishes.empty());
    EXPECT_TRUE(w.plan.everythingLoaded);
    w.select.needAllChildren = false;
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{3}));
}

}  // namespace
}  // namespace fb::test
