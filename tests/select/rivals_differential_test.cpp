// The policies of algorithms 2.1 frame by frame against their slow implementations, on random worlds with
// random settings, cameras, residency and times.
#include "select/compare_with_slow.h"
#include "select/slow_rivals.h"

namespace fb {
namespace {

using enum BoundBy;

struct RivalCounts {
    std::uint64_t takenBack = 0, madeAndTakenBack = 0, otherThanWished = 0, passedOver = 0;
};

RivalCounts compareRival(PolicyId policy, std::uint64_t firstSeed, Tally& tally) {
    RivalCounts counts;
    for (std::uint64_t seed = firstSeed; seed < firstSeed + kWorlds; ++seed) {
        SlowRivals slow;
        compareWorld(seed, policy, slow, tally, [&](const TinyWalk& walk, const SlowFrame& expected) {
            if (policy != PolicyId::macielShirley) return;
            for (NodeId n : expected.front) {
                const auto counted = slow.counted.find(n);
                ASSERT_EQ(double{walk.state.waited[n]}, counted == slow.counted.end() ? 0.0 : counted->second)
                    << "node " << n;
            }
        });
        if (testing::Test::HasFatalFailure()) break;
        counts.takenBack += slow.takenBack;
        counts.madeAndTakenBack += slow.madeAndTakenBack;
        counts.otherThanWished += slow.otherThanWished;
        counts.passedOver += slow.passedOver;
    }
    return counts;
}

TEST(AgainstTheSlowImplementation, GreedyDrawsTheSameFront) {
    Tally tally;
    compareRival(PolicyId::greedy, 1, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, time, load, memory, view});
    expectManySwitches(tally);
}

TEST(AgainstTheSlowImplementation, FunkhouserDrawsTheSameFront) {
    Tally tally;
    const RivalCounts counts = compareRival(PolicyId::funkhouser, 1001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, time, load, memory, view});
    expectManySwitches(tally);
    EXPECT_GT(tally.skippedRoots, 200u);
    EXPECT_GT(counts.passedOver, 1000u);
}

TEST(AgainstTheSlowImplementation, FunkhouserIncrementalDrawsTheSameFront) {
    Tally tally;
    const RivalCounts counts = compareRival(PolicyId::funkhouserIncremental, 2001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, time, load, memory, view});
    expectManySwitches(tally);
    EXPECT_GT(counts.takenBack, 1000u);
    EXPECT_GT(counts.madeAndTakenBack, 200u);
}

TEST(AgainstTheSlowImplementation, MacielShirleyDrawsTheSameFrontAfterTheSameWait) {
    Tally tally;
    const RivalCounts counts = compareRival(PolicyId::macielShirley, 3001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, time, hysteresis, load, memory, view});
    expectManySwitches(tally);
    EXPECT_GT(counts.otherThanWished, 1000u);
}

TEST(AgainstTheSlowImplementation, EriksonDrawsTheSameFront) {
    Tally tally;
    compareRival(PolicyId::erikson, 4001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, time, load, memory, policy, view});
    expectManySwitches(tally);
}

TEST(AgainstTheSlowImplementation, ScreenErrorDrawsTheSameFront) {
    Tally tally;
    compareRival(PolicyId::screenError, 5001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, load, memory, policy, view});
    expectManySwitches(tally);
}

TEST(AgainstTheSlowImplementation, CoarseDrawsTheSameFront) {
    Tally tally;
    compareRival(PolicyId::coarse, 6001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, policy});
    EXPECT_EQ(tally.togglesUp + tally.togglesDown, 0u);
}

TEST(AgainstTheSlowImplementation, FullDrawsTheSameFront) {
    Tally tally;
    compareRival(PolicyId::full, 7001, tally);
    if (HasFatalFailure()) return;
    expectManyAnswers(tally, {leaf, load, memory, view});
    expectManySwitches(tally);
}

}  // namespace
}  // namespace fb
