// A hundred thousand frames with random knobs, cameras, residency and times: no number that is none, and the front always a
// front.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "worlds/closed_loop.h"
#include "worlds/random_worlds.h"

namespace fb {
namespace {

constexpr int kFrames = 100000, kFramesAWorld = 400;

// Every visible path from a root that is drawn to a visible leaf passes one node of the front.
void expectFront(const TinyWalk& walk, const std::set<NodeId>& front, NodeId n, int above) {
    if (!meetsView(walk.view, walk.hierarchy.bounds[n])) return;
    const int covered = above + static_cast<int>(front.count(n));
    ASSERT_LE(covered, 1);
    ASSERT_TRUE(covered == 1 || !walk.hierarchy.isLeaf(n));
    for (std::uint32_t i = 0; i < walk.hierarchy.childCount[n]; ++i)
        expectFront(walk, front, walk.hierarchy.firstChild[n] + i, covered);
}

void expectSound(const ClosedLoop& loop) {
    const TinyWalk& walk = loop.walk;
    const std::set<NodeId> front(walk.selection.front.begin(), walk.selection.front.end());
    ASSERT_EQ(front.size(), walk.selection.front.size());
    std::set<NodeId> reached;
    for (const Reached& r : walk.selection.reached) {
        reached.insert(r.node);
        ASSERT_TRUE(std::isfinite(r.needMs));
        ASSERT_TRUE(std::isfinite(r.hadMs));
    }
    for (NodeId root = 0; root < walk.hierarchy.rootCount; ++root) {
        if (reached.contains(root)) expectFront(walk, front, root, 0);
    }
    for (const double h : walk.state.hysteresis) ASSERT_LE(std::abs(h), walk.settings.hystLimit);
    for (const float waited : walk.state.waited) {
        ASSERT_TRUE(std::isfinite(waited));
        ASSERT_GE(waited, 0.0f);
    }
    ASSERT_TRUE(std::isfinite(walk.state.price));
    ASSERT_GE(walk.state.price, 0.0);
    ASSERT_TRUE(std::isfinite(walk.selection.estimateMs));
    ASSERT_GT(loop.control.vTimeMs, 0.0);
    ASSERT_TRUE(std::isfinite(loop.control.vTimeMs));
    ASSERT_TRUE(std::isfinite(loop.control.slowSpeed));
    ASSERT_TRUE(std::isfinite(loop.control.residualMs));
    ASSERT_TRUE(std::isfinite(loop.control.fit.factor));
    for (const double ms : loop.control.fit.theta) ASSERT_TRUE(std::isfinite(ms));
    ASSERT_GT(shareMs(loop.control, loop.settings.control), 0.0);
    ASSERT_TRUE(std::isfinite(shareMs(loop.control, loop.settings.control)));
}

void turnKnobs(Random& r, ClosedLoop& loop) {
    const PolicyId policy = policies()[r.index(policies().size())].id;
    for (const char* group : {"select", "control", "model"}) randomiseGroup(r, loop.settings, group);
    loop.settings.select.policy = policy;
    loop.walk.settings = loop.settings.select;
    for (bool& on : loop.walk.effects.on) on = r.index(2) == 0;
    followCostModel(loop.control, loop.settings.control.costModel, loop.settings.select.cTextured);
    for (double& h : loop.walk.state.hysteresis) h = std::clamp(h, -loop.walk.settings.hystLimit, loop.walk.settings.hystLimit);
}

void look(Random& r, TinyWalk& walk) {
    Camera camera = lookAt(randomPoint(r, 25.0), randomPoint(r, 15.0), {0, 1, 0});
    camera.fovyRadians = r.uniform(0.2, 2.6);
    walk.view = makeView(camera, randomPoint(r, 50.0), 160, 90);
}

TEST(LongRun, OfRandomKnobsCamerasAndResidencyStaysSound) {
    std::uint64_t toggles = 0, drawn = 0;
    for (int world = 0; world < kFrames / kFramesAWorld; ++world) {
        SCOPED_TRACE("world " + std::to_string(world));
        Random r(static_cast<std::uint64_t>(world));
        Settings settings;
        ClosedLoop loop(randomWorld(r), settings);
        for (int frame = 0; frame < kFramesAWorld; ++frame) {
            if (frame % 40 == 0) turnKnobs(r, loop);
            if (r.index(5) == 0) look(r, loop.walk);
            for (NodeId n = loop.walk.hierarchy.rootCount; n < loop.walk.hierarchy.size(); ++n) {
                if (r.index(30) == 0) loop.walk.loaded[n] ^= 1;
            }
            loop.walk.dtSeconds = r.index(10) == 0 ? 0.0 : r.uniform(0.0, 0.1);
            // Stalls, frames without work and times that are none.
            const double strange[] = {0.0, 1e-3, 1e4, HUGE_VAL, std::nan("")};
            loop.step(r.index(20) == 0 ? std::optional(strange[r.index(5)]) : std::nullopt);
            expectSound(loop);
            if (HasFatalFailure()) return;
            drawn += loop.walk.selection.front.size();
        }
        toggles += loop.toggles;
    }
    EXPECT_GT(drawn, 3u * kFrames / 2u);
    EXPECT_GT(toggles, kFrames / 40u);
}

}  // namespace
}  // namespace fb
