// Slices of a sibling group (thesis eq. 4.1) and their redistribution (thesis 6.6; algorithms 3.1).
#include "select/slices.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "select/sibling_group.h"
#include "worlds/random_worlds.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

//        0            1 has the priority 3 and nothing below it; 2 has 1 and two leaves of cost 6 each
//      /   \          .
//     1     2
//          / \        .
//         3   4
TinyWalk unequal() {
    const TinyNode leaf{.cost = 6};
    return {{{.children = {{.cost = 2, .benefit = 6}, {.cost = 2, .benefit = 2, .children = {leaf, leaf}}}}},
            PolicyId::lakhia};
}

std::vector<double> slicesOf(TinyWalk& walk, double shareMs) {
    gatherGroup(walk.input(), 0, walk.state, walk.selection);
    shareOut(walk.input(), shareMs, walk.state, walk.selection.counters);
    return walk.state.slices;
}

TEST(Slices, AreInProportionToPriorities) {
    TinyWalk walk = unequal();
    EXPECT_EQ(slicesOf(walk, 8.0), (std::vector<double>{6.0, 2.0}));
    EXPECT_EQ(walk.selection.counters.effectWork[Effect::redistribution], 0u);
    EXPECT_TRUE(walk.state.leaves.count.empty()) << "nothing is summed up for an effect that is off";
}

TEST(Slices, OfWhatCannotUseThemGoToTheSiblings) {
    TinyWalk walk = unequal();
    walk.effects[Effect::redistribution] = true;
    const std::vector<double> slices = slicesOf(walk, 8.0);  // node 1 is a leaf of 2 ms: 2.5 at most
    EXPECT_NEAR(slices[0], 2.5, 1e-9);
    EXPECT_NEAR(slices[1], 5.5, 1e-9);
    EXPECT_EQ(walk.selection.counters.effectWork[Effect::redistribution], 2u);
}

TEST(Slices, AreAtLeastWhatANodeTakesAnyway) {
    TinyWalk walk = unequal();
    walk.effects[Effect::redistribution] = true;
    const std::vector<double> slices = slicesOf(walk, 4.2);  // 3.15 and 1.05 by priority
    EXPECT_NEAR(slices[0], 2.2, 1e-9);
    EXPECT_NEAR(slices[1], 2.0, 1e-9);
}

TEST(Slices, AreInProportionToNeedsWhereThoseAreTooMuchAndToLeavesWhereThoseAreTooLittle) {
    TinyWalk walk = unequal();
    walk.effects[Effect::redistribution] = true;
    EXPECT_EQ(slicesOf(walk, 2.0), (std::vector<double>{1.0, 1.0}));
    EXPECT_EQ(slicesOf(walk, 28.0), (std::vector<double>{4.0, 24.0}));  // 2 and 12 ms of leaves, a quarter more each
}

RC_GTEST_PROP(Slices, AddUpToTheShareAndKeepToTheirBounds, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    Hierarchy world = randomWorld(r);
    TinyWalk walk(std::move(world), plainSettings(PolicyId::lakhia));
    walk.vTimeMs = 0.01;
    walk.effects[Effect::redistribution] = r.index(4) != 0;
    const double share = std::pow(10.0, r.uniform(-3.0, 3.0));
    gatherGroup(walk.input(), kNoNode, walk.state, walk.selection);
    walk.state.slices = {-7.0};  // of the group before
    shareOut(walk.input(), share, walk.state, walk.selection.counters);
    const std::vector<double>& slices = walk.state.slices;
    RC_ASSERT(slices.size() == walk.state.group.size());
    if (slices.empty()) return;
    double needs = 0.0;
    for (const NodeId n : walk.state.group) needs += timeNeeded(walk.input(), n);
    const double sum = std::accumulate(slices.begin(), slices.end(), 0.0);
    RC_ASSERT(std::abs(sum - share) <= 1e-6 * share);
    for (std::size_t i = 0; i < slices.size(); ++i) {
        RC_ASSERT(slices[i] > 0.0);
        if (walk.effects[Effect::redistribution] && needs < share)
            RC_ASSERT(slices[i] >= timeNeeded(walk.input(), walk.state.group[i]) * (1.0 - 1e-9));
    }
}

}  // namespace
}  // namespace fb
