// The policy of algorithms 3 frame by frame against its slow implementation, on random worlds with random
// settings, cameras, residency and times.
#include "select/compare_with_slow.h"
#include "select/slow_frontbench.h"

namespace fb {
namespace {

using enum BoundBy;

TEST(AgainstTheSlowImplementation, FrontbenchDrawsTheSameFrontAtTheSamePrice) {
    Tally tally;
    std::uint64_t coarsened = 0, refinements = 0, newRefinements = 0, exchanges = 0, exchangesAwaited = 0;
    std::uint64_t exchangesOfSeveral = 0, cameAsRefined = 0, patientFrames = 0;
    std::uint64_t cutNodes = 0, newExchanges = 0, arrivals = 0;
    for (std::uint64_t seed = 8001; seed < 8001 + 4 * kWorlds; ++seed) {
        SlowFrontbench slow;
        compareWorld(
            seed, PolicyId::frontbench, slow, tally, [&](const TinyWalk& walk, const SlowFrame& expected) {
                ASSERT_NEAR(walk.state.price, slow.price, 1e-9 * slow.price);
                for (NodeId n : expected.front) {
                    const auto waited = slow.waited.find(n);
                    ASSERT_EQ(walk.state.waited[n], waited == slow.waited.end() ? 0.0f : waited->second)
                        << "node " << n;
                }
            });
        if (HasFatalFailure()) return;
        coarsened += slow.coarsened;
        refinements += slow.refinements;
        newRefinements += slow.newRefinements;
        cutNodes += slow.cutNodes;
        newExchanges += slow.newExchanges;
        arrivals += slow.arrivals;
        exchanges += slow.exchanges;
        exchangesOfSeveral += slow.exchangesOfSeveral;
        exchangesAwaited += slow.exchangesAwaited;
        cameAsRefined += slow.cameAsRefined;
        patientFrames += slow.patientFrames;
    }
    expectManyAnswers(tally, {leaf, time, hysteresis, load, memory, view});
    expectManySwitches(tally);
    EXPECT_GT(coarsened, 1000u);
    EXPECT_GT(refinements, 1000u);
    EXPECT_GT(newRefinements, 1000u);
    EXPECT_GT(cutNodes, 1000u);
    EXPECT_GT(newExchanges, 20u);
    EXPECT_GT(arrivals, 100u);
    EXPECT_GT(exchanges, 200u);
    EXPECT_GT(exchangesOfSeveral, 50u);
    EXPECT_GT(exchangesAwaited, exchanges + 50);
    EXPECT_GT(cameAsRefined, 200u);
    EXPECT_GT(patientFrames, 1000u);
}

}  // namespace
}  // namespace fb
