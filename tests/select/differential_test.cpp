// Frame by frame against the slow implementation, on random worlds with random settings, cameras, residency
// and times.
#include <gtest/gtest.h>

#include <cmath>

#include "select/slow_selection.h"
#include "worlds/random_camera.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

SelectSettings randomSelectSettings(Random& r, PolicyId policy) {
    SelectSettings s;
    s.policy = policy;
    s.cVis = r.uniform(0.0, 3.0);
    s.cFore = r.uniform(0.0, 0.99);
    s.cTextured = r.uniform(0.05, 0.95);
    s.hystSwitch = r.uniform(1.0, 8.0);
    s.hystLimit = s.hystSwitch * r.uniform(1.0, 4.0);
    s.hystUnit = r.index(3) == 0 ? 100.0 : r.uniform(0.2, 3.0);
    s.hystStart = r.index(2) == 0 ? -1.0 : r.uniform(-1.0, 1.0);
    s.hystBand = r.index(2) == 0;
    s.needAllChildren = r.index(2) == 0;
    s.frustumFalloff = r.uniform(0.5, 60.0);
    s.minDistance = r.uniform(0.1, 3.0);
    s.lookAhead = r.uniform(0.0, 1.0);
    return s;
}

void changeResidency(Random& r, TinyWalk& walk) {
    for (NodeId n = walk.hierarchy.rootCount; n < walk.hierarchy.size(); ++n) {
        if (r.index(40) == 0) walk.loaded[n] ^= 1;
        walk.refused[n] = walk.loaded[n] == 0 && r.index(3) == 0 ? 1 : 0;
    }
}

struct Tally {
    std::uint64_t frames = 0, toggles = 0, pingPongs = 0, refused = 0, repaired = 0, frontNodes = 0;
    std::uint64_t boundBy[kBoundByCount] = {};
};

void compareFrame(TinyWalk& walk, SlowSelection& slow, const SlowFrame& expected, Tally& tally) {
    const std::set<NodeId> front(walk.selection.front.begin(), walk.selection.front.end());
    ASSERT_EQ(front, expected.front);
    ASSERT_EQ(front.size(), walk.selection.front.size()) << "a node is drawn twice";
    for (const auto& [node, reason] : expected.boundBy) {
        ASSERT_EQ(walk.boundBy(node), reason) << "node " << node;
        ++tally.boundBy[static_cast<int>(reason)];
    }
    const SelectCounters& c = walk.counters();
    ASSERT_EQ(c.togglesUp, expected.togglesUp);
    ASSERT_EQ(c.togglesDown, expected.togglesDown);
    ASSERT_EQ(c.pingPongs, expected.pingPongs);
    ASSERT_EQ(c.refusedGroups, expected.refusedGroups);
    ASSERT_EQ(c.repairedPriorities, expected.repairedPriorities);
    ASSERT_EQ(c.repairedCounters, 0u);
    for (const auto& [node, h] : slow.counters) {
        ASSERT_NEAR(walk.state.hysteresis[node], h, 1e-9 * (1.0 + std::abs(h))) << "node " << node;
    }
    ++tally.frames;
    tally.toggles += c.togglesUp + c.togglesDown;
    tally.pingPongs += c.pingPongs;
    tally.refused += c.refusedGroups;
    tally.repaired += c.repairedPriorities;
    tally.frontNodes += front.size();
}

void compareWorld(std::uint64_t seed, PolicyId policy, Tally& tally) {
    Random r(seed);
    Hierarchy world = randomWorld(r);
    ASSERT_TRUE(checkHierarchy(world)) << checkHierarchy(world).error().oneLine();
    const SelectSettings settings = randomSelectSettings(r, policy);
    TinyWalk walk(std::move(world), settings);
    for (bool& on : walk.effects.on) on = r.index(2) == 0;
    moveCamera(r, walk, true);
    walk.targetMs = 30.0;
    walk.vTimeMs = 0.02;
    walk.shareMs = 30.0 * std::pow(10.0, r.uniform(-1.5, 0.7));
    SlowSelection slow;
    for (int i = 0; i < 50; ++i) {
        walk.shareMs *= r.uniform(0.8, 1.25);
        walk.vTimeMs *= r.uniform(0.9, 1.11);
        changeResidency(r, walk);
        moveCamera(r, walk, r.index(25) == 0);
        walk.step();
        const SlowFrame expected = slow.step(walk.input());
        compareFrame(walk, slow, expected, tally);
        if (testing::Test::HasFatalFailure()) return;
    }
}

// The worlds must have asked every question, or the comparison says little.
void expectEveryAnswer(const Tally& tally, bool counters) {
    EXPECT_GT(tally.frontNodes, 2 * tally.frames);
    EXPECT_GT(tally.toggles, tally.frames / 20);
    EXPECT_GT(tally.pingPongs, 100u);
    EXPECT_GT(tally.refused, tally.frames / 10);
    EXPECT_GT(tally.repaired, 100u);
    for (BoundBy reason : {BoundBy::leaf, BoundBy::time, BoundBy::load, BoundBy::memory}) {
        EXPECT_GT(tally.boundBy[static_cast<int>(reason)], 200u) << boundByName(reason);
    }
    EXPECT_EQ(tally.boundBy[static_cast<int>(BoundBy::hysteresis)] > 200, counters);
}

TEST(AgainstTheSlowImplementation, LakhiaDrawsTheSameFrontWithTheSameCounters) {
    Tally tally;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("world " + std::to_string(seed));
        compareWorld(seed, PolicyId::lakhia, tally);
        if (HasFatalFailure()) return;
    }
    expectEveryAnswer(tally, true);
}

TEST(AgainstTheSlowImplementation, LakhiaNaiveDrawsTheSameFront) {
    Tally tally;
    for (std::uint64_t seed = 1001; seed <= 1200; ++seed) {
        SCOPED_TRACE("world " + std::to_string(seed));
        compareWorld(seed, PolicyId::lakhiaNaive, tally);
        if (HasFatalFailure()) return;
    }
    expectEveryAnswer(tally, false);
}

}  // namespace
}  // namespace fb
