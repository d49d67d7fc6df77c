#include <gtest/gtest.h>

#include "load/residency.h"
#include "tiny_world.h"

namespace fb::test {
namespace {

//      0         1        roots of 10 and 20 bytes
//    2   3                1 and 2 bytes more
World twoRoots() {
    return World({{kRoot, 1, 10}, {kRoot, 1, 20}, {0, 1, 100}, {0, 1, 200}});
}

TEST(Residency, MovesBytesFromReservedToResident) {
    World w = twoRoots();
    EXPECT_EQ(w.residency.residentBytes, 30u);
    w.residency.reserve(w.hierarchy, 2);
    w.residency.reserve(w.hierarchy, 3);
    EXPECT_EQ(w.residency.reservedBytes, 300u);
    EXPECT_EQ(w.residency.residentBytes, 30u);
    w.residency.setResident(w.hierarchy, 2);
    EXPECT_EQ(w.residency.reservedBytes, 200u);
    EXPECT_EQ(w.residency.residentBytes, 130u);
    EXPECT_EQ(w.residency.totalBytes(), 330u);
    w.residency.setUnloaded(w.hierarchy, 3);
    EXPECT_EQ(w.residency.totalBytes(), 130u);
    EXPECT_EQ(w.residency.peakBytes, 330u);
}

TEST(Residency, CountsLoadedChildrenOfEachNode) {
    World w = twoRoots();
    w.residency.reserve(w.hierarchy, 2);
    EXPECT_EQ(w.residency.loadedChildren[0], 0u);
    w.residency.setResident(w.hierarchy, 2);
    w.residency.setResident(w.hierarchy, 3);
    EXPECT_EQ(w.residency.loadedChildren[0], 2u);
    EXPECT_EQ(w.residency.loadedChildren[1], 0u);
    w.residency.setUnloaded(w.hierarchy, 2);
    EXPECT_EQ(w.residency.loadedChildren[0], 1u);
    EXPECT_EQ(w.residency.loaded[2], 0);
    EXPECT_EQ(w.residency.loaded[3], 1);
}

TEST(Residency, RemovesFromTheMiddleOfItsLists) {
    World w = twoRoots();
    w.residency.setResident(w.hierarchy, 2);
    w.residency.setResident(w.hierarchy, 3);
    EXPECT_EQ(w.residency.resident, (Nodes{0, 1, 2, 3}));
    w.residency.setUnloaded(w.hierarchy, 2);
    EXPECT_EQ(w.residency.resident, (Nodes{0, 1, 3}));
    w.residency.setUnloaded(w.hierarchy, 3);
    EXPECT_EQ(w.residency.resident, (Nodes{0, 1}));
}

TEST(Residency, WaitsHalfASecondThenOneThenTwoThenGivesUp) {
    World w = twoRoots();
    const double waits[] = {0.5, 1.0, 2.0};
    double now = 10.0;
    for (const double wait : waits) {
        w.residency.reserve(w.hierarchy, 2);
        w.residency.setFailed(w.hierarchy, 2, now);
        EXPECT_EQ(w.residency.state[2], NodeState::failedTemporarily);
        EXPECT_EQ(w.residency.retryAtSeconds[2], now + wait);
        EXPECT_EQ(w.residency.reservedBytes, 0u);
        now += wait;
    }
    w.residency.reserve(w.hierarchy, 2);
    w.residency.setFailed(w.hierarchy, 2, now);
    EXPECT_EQ(w.residency.state[2], NodeState::failed);
}

TEST(Residency, ForgetsFailuresWhenTheNodeIsLoadedAfterAll) {
    World w = twoRoots();
    for (int i = 0; i < 3; ++i) {
        w.residency.reserve(w.hierarchy, 2);
        w.residency.setFailed(w.hierarchy, 2, 0.0);
    }
    w.residency.reserve(w.hierarchy, 2);
    w.residency.setResident(w.hierarchy, 2);
    w.residency.setUnloaded(w.hierarchy, 2);
    w.residency.reserve(w.hierarchy, 2);
    w.residency.setFailed(w.hierarchy, 2, 7.0);
    EXPECT_EQ(w.residency.state[2], NodeState::failedTemporarily);
    EXPECT_EQ(w.residency.retryAtSeconds[2], 7.5);
}

TEST(ResidencyDeathTest, StopsWhenAParentWouldGoBeforeItsChild) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    World w({{kRoot, 1, 1}, {0, 1, 1}, {1, 1, 1}});
    w.residency.setResident(w.hierarchy, 1);
    w.residency.setResident(w.hierarchy, 2);
    EXPECT_DEATH(w.residency.setUnloaded(w.hierarchy, 1), "loadedChildren");
}

}  // namespace
}  // namespace fb::test
