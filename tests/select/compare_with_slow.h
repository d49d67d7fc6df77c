// Compares a policy frame by frame with its slow implementation on random walks, and counts what has come up.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "select/random_walk.h"
#include "select/slow_frame.h"

namespace fb {

inline constexpr int kWorlds = 200, kFrames = 50;

struct Tally {
    std::uint64_t worlds = 0, ties = 0, frames = 0, frontNodes = 0, togglesUp = 0, togglesDown = 0,
                  pingPongs = 0;
    std::uint64_t skippedRoots = 0, emptyFronts = 0;
    std::uint64_t boundBy[kBoundByCount] = {};

    void add(const SlowFrame& frame) {
        ++frames;
        frontNodes += frame.front.size();
        emptyFronts += frame.front.empty() ? 1 : 0;
        togglesUp += frame.togglesUp;
        togglesDown += frame.togglesDown;
        pingPongs += frame.pingPongs;
        skippedRoots += frame.skippedRoots;
        for (const auto& [node, reason] : frame.boundBy) ++boundBy[static_cast<int>(reason)];
    }
    [[nodiscard]] std::uint64_t operator[](BoundBy reason) const { return boundBy[static_cast<int>(reason)]; }
};

inline void compareFrame(const TinyWalk& walk, const SlowFrame& expected) {
    const std::set<NodeId> front(walk.selection.front.begin(), walk.selection.front.end());
    ASSERT_EQ(front, expected.front);
    ASSERT_EQ(front.size(), walk.selection.front.size()) << "a node is drawn twice";
    for (const auto& [node, reason] : expected.boundBy) {
        ASSERT_EQ(boundByName(walk.boundBy(node)), boundByName(reason)) << "node " << node;
    }
    const SelectCounters& c = walk.counters();
    ASSERT_EQ(c.skippedRoots, expected.skippedRoots);
    ASSERT_EQ(c.togglesUp, expected.togglesUp);
    ASSERT_EQ(c.togglesDown, expected.togglesDown);
    ASSERT_EQ(c.pingPongs, expected.pingPongs);
}

// Stops where a difference that rounding could turn round has decided: from there both sides are right.
template <class Slow, class CompareMore>
void compareWorld(std::uint64_t seed, PolicyId policy, Slow& slow, Tally& tally, CompareMore compareMore) {
    SCOPED_TRACE("world " + std::to_string(seed));
    RandomWalk world(seed, policy);
    const auto checked = checkHierarchy(world.walk.hierarchy);
    ASSERT_TRUE(checked) << checked.error().oneLine();
    ++tally.worlds;
    for (int i = 0; i < kFrames; ++i) {
        const SelectInput in = world.next();
        SCOPED_TRACE("frame " + std::to_string(in.frame));
        selectFront(in, world.walk.state, world.walk.selection);
        const SlowFrame expected = slow.step(in);
        if (expected.hungOnRounding) {
            ++tally.ties;
            return;
        }
        compareFrame(world.walk, expected);
        if (testing::Test::HasFatalFailure()) return;
        compareMore(world.walk, expected);
        if (testing::Test::HasFatalFailure()) return;
        tally.add(expected);
    }
}

// The worlds must have asked every question, or the comparison says little.
inline void expectManyAnswers(const Tally& tally, std::initializer_list<BoundBy> reasons) {
    EXPECT_LT(100 * tally.ties, tally.worlds);
    EXPECT_GT(tally.frontNodes, 2 * tally.frames);
    EXPECT_GT(tally.emptyFronts, 100u);
    for (int i = 0; i < kBoundByCount; ++i) {
        const auto reason = static_cast<BoundBy>(i);
        const bool given = std::find(reasons.begin(), reasons.end(), reason) != reasons.end();
        if (given) {
            EXPECT_GT(tally[reason], 200u) << boundByName(reason);
        } else {
            EXPECT_EQ(tally[reason], 0u) << boundByName(reason);
        }
    }
}
inline void expectManySwitches(const Tally& tally) {
    EXPECT_GT(tally.togglesUp, tally.frames / 40);
    EXPECT_GT(tally.togglesDown, tally.frames / 40);
    EXPECT_GT(tally.pingPongs, 100u);
}

}  // namespace fb
