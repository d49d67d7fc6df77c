// What planning gives up: which groups are evicted, and which never.
#include <gtest/gtest.h>

#include "plan_worlds.h"

namespace fb::test {
namespace {

TEST(PlanLoads, EvictsTheGroupOfLowestPriorityWhole) {
    World w = fourGroups();
    w.setBudget(800);
    w.settle();
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3, 4, 5, 6, 7}));
    w.hierarchy.staticBenefit[10] = 100;
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{6, 7}));
    EXPECT_EQ(w.wished(), (Nodes{10, 11}));
    EXPECT_EQ(w.refusedNodes(), (Nodes{6, 7, 8, 9})) << "what was evicted had no room either";
    EXPECT_EQ(w.residency.totalBytes(), 800u);
    EXPECT_EQ(w.residency.counters.evicted, 2u);
    EXPECT_FALSE(w.plan.frontEvicted);
    w.deliverAll();
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
}

TEST(PlanLoads, EvictsOnlyBelowTheMargin) {
    World w = fourGroups();
    w.setBudget(800);
    w.settle();
    w.hierarchy.staticBenefit[10] = 8.0f;  // 4 < 0.5 * 8 does not hold
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
    EXPECT_EQ(w.refusedNodes(), (Nodes{8, 9, 10, 11}));
    w.hierarchy.staticBenefit[10] = 8.25f;
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{6, 7}));
}

TEST(PlanLoads, EvictsNothingWhenEvenThatWouldNotMakeRoom) {
    World w = fourGroups();
    w.setBudget(800);
    w.settle();
    w.hierarchy.staticBenefit[10] = 12;  // group of 200 + 300 bytes: 4 may go, 8 may not
    w.hierarchy.residentBytes[10] = 400;
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
    w.hierarchy.staticBenefit[10] = 17;  // now both may go, and 400 bytes are still too few
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
    EXPECT_EQ(w.refusedNodes(), (Nodes{8, 9, 10, 11}));
    w.hierarchy.residentBytes[10] = 300;
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{6, 7, 4, 5})) << "lowest priority first";
}

TEST(PlanLoads, KeepsTheSiblingsOfWhatIsDrawn) {
    World w = fourGroups();
    w.setBudget(800);
    w.settle();
    w.setFront({6});  // 7 is outside the view, but without it 6 could not be drawn
    w.hierarchy.staticBenefit[10] = 100;
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{4, 5})) << "the lowest of those not drawn";
    w.deliverAll();
    w.setFront({6, 10});
    w.hierarchy.staticBenefit[8] = 1000;
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
}

//      0          1        roots
//      2          3        priority 4; 3
//      4                   1
TEST(PlanLoads, EvictsChildrenBeforeTheirParent) {
    World w({{kRoot, 1, 100}, {kRoot, 1, 100}, {0, 4, 100}, {1, 3, 100}, {2, 1, 100}});
    w.setBudget(400);
    w.settle();
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3}));
    w.setBudget(500);
    w.settle();
    ASSERT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3, 4}));
    w.setBudget(300);
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{4, 3})) << "1, then 3; 2 has the greatest priority";
}

//      0          1
//      2          3        priority 2; 100
//      4                   50: ranks above its parent
TEST(PlanLoads, NeverEvictsAParentFirstAlthoughItsChildRanksHigher) {
    World w({{kRoot, 1, 100}, {kRoot, 1, 100}, {0, 2, 100}, {1, 1, 100}, {2, 50, 100}});
    w.settle();
    ASSERT_EQ(w.loadedNodes().size(), 5u);
    w.residency.setUnloaded(w.hierarchy, 3);
    w.hierarchy.staticBenefit[3] = 100;
    w.hierarchy.residentBytes[3] = 200;
    w.setBudget(400);
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{4, 2}));
    EXPECT_EQ(w.wished(), (Nodes{3}));
}

TEST(PlanLoads, NeverEvictsTheParentOfWhatItMakesRoomFor) {
    //   0 - 1 - 2 : 2 matters far more than 1 and there is room for one of them
    World w({{kRoot, 1, 100}, {0, 1, 100}, {1, 100, 100}});
    w.setBudget(200);
    w.settle();
    for (int frame = 0; frame < 3; ++frame) {
        w.planFrame();
        EXPECT_TRUE(w.plan.evicted.empty());
        EXPECT_TRUE(w.plan.wishes.empty());
        EXPECT_EQ(w.refusedNodes(), (Nodes{2}));
    }
}

TEST(PlanLoads, NeverEvictsARoot) {
    World w = fourGroups();
    w.settle();
    w.setBudget(100);
    w.planFrame();
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3}));
    EXPECT_EQ(w.refusedNodes(), (Nodes{4, 5, 6, 7, 8, 9, 10, 11}));
    w.planFrame();
    EXPECT_TRUE(w.plan.evicted.empty());
    EXPECT_TRUE(w.plan.wishes.empty());
}

TEST(PlanLoads, EvictsEvenTheFrontAtOnceWhenTheBudgetIsCut) {
    World w = fourGroups();
    w.settle();
    ASSERT_EQ(w.residency.totalBytes(), 1200u);
    w.setFront({10, 11, 6, 7});  // priorities 1 and 4; not drawn: 8 and 2
    w.setBudget(850);
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{8, 9, 4, 5})) << "first what is not drawn, lowest priority first";
    EXPECT_FALSE(w.plan.frontEvicted);
    w.setBudget(600);
    w.planFrame();
    EXPECT_EQ(w.plan.evicted, (Nodes{10, 11}));
    EXPECT_TRUE(w.plan.frontEvicted);
    EXPECT_EQ(w.residency.totalBytes(), 600u);
}

TEST(PlanLoads, ComesBackWhenTheBudgetIsRestored) {
    World w = fourGroups();
    w.settle();
    w.setBudget(600);
    w.settle();
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(w.refusedNodes(), (Nodes{6, 7, 8, 9, 10, 11}));
    w.setBudget(1200);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{6, 7, 8, 9, 10, 11}));
    EXPECT_TRUE(w.refusedNodes().empty());
}

TEST(PlanLoads, CountsReservedBytesAgainstTheBudgetWhenItIsCut) {
    World w = fourGroups();
    w.planFrame();
    ASSERT_EQ(w.residency.reservedBytes, 800u);
    w.setBudget(750);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{4, 5}));
    EXPECT_EQ(w.residency.counters.cancelled, 6u);
    EXPECT_TRUE(w.plan.evicted.empty()) << "nothing of it was on the device";
}

TEST(PlanLoads, FreesRoomByStoppingALoadWhosePriorityFellBehind) {
    World w = fourGroups();
    w.setBudget(600);
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{4, 5}));
    w.hierarchy.staticBenefit[6] = 17;
    w.planFrame();
    EXPECT_EQ(w.wished(), (Nodes{6, 7}));
    EXPECT_EQ(w.residency.counters.cancelled, 2u);
    EXPECT_EQ(w.residency.totalBytes(), 600u);
    EXPECT_TRUE(w.plan.evicted.empty());
}

}  // namespace
}  // namespace fb::test
