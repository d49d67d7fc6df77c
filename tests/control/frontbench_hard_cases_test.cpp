// The table of hard cases (core/algorithms.md section 5) for the policy frontbench: the loop of selection, simulated device
// and feedback is closed.
#include <gtest/gtest.h>

#include <cmath>

#include "worlds/closed_loop.h"
#include "worlds/feedback.h"

namespace fb {
namespace {

ClosedLoop street(int view, double noisePct = 0.0, CostModel model = CostModel::vTime) {
    Settings settings;
    settings.select.policy = PolicyId::frontbench;
    settings.control.targetMs = 15.0;
    settings.control.costModel = model;
    settings.model.noisePct = noisePct;
    settings.model.fillMsPerMegapixel = 0.0;
    ClosedLoop loop(streetWorld(), settings);
    loop.walk.view = streetView(view);
    return loop;
}

constexpr CostModel kBoth[] = {CostModel::vTime, CostModel::leastSquares};

TEST(FrontbenchHardCase, Nr09AStallSwitchesNothing) {
    for (const CostModel model : kBoth) {
        ClosedLoop loop = street(0, 0.0, model);
        loop.run(600);
        loop.toggles = 0;
        for (const double stallMs : {500.0, 500.0}) loop.step(stallMs);  // two frames running
        loop.run(120);
        EXPECT_EQ(loop.toggles, 0u);
        EXPECT_GT(loop.actualMs, 12.0) << "it was not all roots";
    }
}

std::size_t nodesBoundBy(const Selection& selection, BoundBy reason) {
    return selection.counters.boundBy[static_cast<std::size_t>(reason)];
}

// Half of the houses stay in view: to them, too, nothing is a switch that anybody sees.
TEST(FrontbenchHardCase, Nr15TheFrameOfACutIsAsFineAsTimeAllows) {
    for (const int to : {1, 2, 4}) {
        ClosedLoop loop = street(0);
        loop.run(300);
        loop.walk.view = streetView(to);
        loop.step();
        EXPECT_EQ(nodesBoundBy(loop.walk.selection, BoundBy::hysteresis), 0u) << to;
        EXPECT_GT(loop.walk.selection.estimateMs, 0.8 * loop.settings.control.targetMs) << to;
        loop.toggles = 0;
        loop.run(60);
        EXPECT_LE(loop.toggles, 4u) << to;
    }
}

// A turn that a hand makes is no cut, and what stays in the picture waits.
TEST(FrontbenchHardCase, Nr15ATurnOfTenDegreesIsNoCut) {
    ClosedLoop loop = street(0);
    loop.run(300);
    for (const int degrees : {10, 20}) {
        ClosedLoop turned = loop;
        Camera camera = loop.walk.view.camera;
        camera.orientation = glm::angleAxis(glm::radians(1.0 * degrees), glm::dvec3(0, 1, 0)) * camera.orientation;
        turned.walk.view = makeView(camera, glm::dvec3(0.0), 160, 90);
        turned.step();
        std::size_t seenAnew = 0;
        for (const Refinement& r : turned.walk.state.tree.nodes) seenAnew += r.isNew ? 1 : 0;
        EXPECT_EQ(seenAnew == turned.walk.state.tree.nodes.size(), degrees == 20) << degrees;
    }
}

// The camera rests, patience is at its most, and only now the data of the whole street come: they have been waited for.
TEST(FrontbenchHardCase, WhatIsLoadedLateIsDrawnAsItComes) {
    ClosedLoop loop = street(0);
    loop.settings.control.targetMs = 60.0;
    std::fill(loop.walk.loaded.begin() + loop.walk.hierarchy.rootCount, loop.walk.loaded.end(), std::uint8_t{0});
    loop.run(300);
    EXPECT_EQ(loop.walk.state.patience, loop.settings.select.restFactor);
    EXPECT_EQ(loop.toggles, 0u);
    const std::size_t wishes = nodesBoundBy(loop.walk.selection, BoundBy::load);
    EXPECT_GE(wishes, 12u);
    std::ranges::fill(loop.walk.loaded, std::uint8_t{1});
    loop.step();
    EXPECT_EQ(loop.toggles, wishes);
}

// The device drops to three fifths of its speed.
void loseSpeed(ClosedLoop& loop) {
    ModelSettings& device = loop.settings.model;
    for (double* part : {&device.texturedUs, &device.untexturedUs, &device.nodeUs}) *part /= 0.6;
}

// At most 300.
int framesUntilBelow(ClosedLoop& loop, double ms) {
    for (int frames = 0; frames < 300; ++frames) {
        loop.step();
        if (loop.actualMs <= ms) return frames;
    }
    return 300;
}

// The gate waits for three of five frames, the average for the rest.
TEST(FrontbenchHardCase, Nr16IsBackAtTheTargetHalfASecondAfterTheDeviceLostTwoFifthsOfItsSpeed) {
    ClosedLoop loop = street(0);
    loop.walk.settings.restFactor = 1.0;  // as with a camera that moves
    loop.run(900);
    loseSpeed(loop);
    loop.step();
    EXPECT_GT(loop.actualMs, 1.3 * 15.0);
    EXPECT_LE(framesUntilBelow(loop, 1.05 * 15.0), 14);
    for (int i = 0; i < 300; ++i) {
        loop.step();
        EXPECT_LE(loop.actualMs, 1.05 * 15.0);
    }
    EXPECT_GT(loop.actualMs, 0.85 * 15.0) << "and no more was given up than that";
}

// At rest a late frame shows least and a switch most: it takes seconds.
TEST(FrontbenchHardCase, Nr16IsBackWithinAQuarterOfTheTargetWithACameraAtRest) {
    ClosedLoop loop = street(0);
    loop.run(900);
    loseSpeed(loop);
    EXPECT_LE(framesUntilBelow(loop, 1.25 * 15.0), 90);
    loop.run(300);
    EXPECT_LE(loop.actualMs, 1.25 * 15.0);
    loop.toggles = 0;
    loop.run(900);
    EXPECT_EQ(loop.toggles, 0u);
}

// Least squares must find out which work it was, where all fronts so far had as many triangles a node: too many are given up,
// then some are taken back.
TEST(FrontbenchHardCase, Nr16IsBackAtTheTargetWithLeastSquaresToo) {
    ClosedLoop loop = street(0, 0.0, CostModel::leastSquares);
    loop.walk.settings.restFactor = 1.0;
    loop.run(900);
    loseSpeed(loop);
    EXPECT_LE(framesUntilBelow(loop, 1.05 * 15.0), 15);
    loop.run(900);
    for (int i = 0; i < 300; ++i) {
        loop.step();
        EXPECT_LE(loop.actualMs, 1.05 * 15.0);
    }
    EXPECT_GT(loop.actualMs, 0.85 * 15.0);
}

TEST(FrontbenchHardCase, Nr17RootsThatExceedTheTargetAreDrawnAndReported) {
    ClosedLoop loop = street(0);
    loop.settings.control.targetMs = 3.0;  // sixteen roots take 5.2 ms
    loop.run(100);
    EXPECT_TRUE(loop.control.infeasible);
    EXPECT_GT(loop.walk.selection.front.size(), 8u);
    for (const NodeId n : loop.walk.selection.front) EXPECT_LT(n, loop.walk.hierarchy.rootCount);
    EXPECT_EQ(loop.toggles, 0u);
}

// Everything fits for a minute; nothing winds up that would overshoot when it no longer does.
TEST(FrontbenchHardCase, Nr18TimeThatNothingCanUseIsNotSavedUp) {
    ClosedLoop loop = street(0);
    loop.settings.control.targetMs = 500.0;
    loop.run(1800);
    for (const NodeId n : loop.walk.selection.front) EXPECT_TRUE(loop.walk.hierarchy.isLeaf(n) || loop.walk.boundBy(n) == BoundBy::view);
    loop.settings.control.targetMs = 15.0;
    loop.step();
    EXPECT_LE(loop.walk.selection.estimateMs, 15.0);
    for (int i = 0; i < 300; ++i) {
        loop.step();
        EXPECT_LE(loop.actualMs, 1.05 * 15.0);
    }
}

TEST(FrontbenchHardCase, Nr19OfAChildThatIsEvictedTheParentIsDrawnInTheSameFrame) {
    ClosedLoop loop = street(0);
    loop.run(300);
    const Hierarchy& h = loop.walk.hierarchy;
    NodeId evicted = kNoNode;
    for (const NodeId n : loop.walk.selection.front) {
        if (h.level[n] > 0) evicted = n;
    }
    ASSERT_NE(evicted, kNoNode);
    const NodeId parent = h.parent[evicted];
    loop.walk.loaded[evicted] = 0;
    loop.toggles = 0;
    loop.step();
    EXPECT_EQ(std::ranges::count(loop.walk.selection.front, parent), 1);
    EXPECT_EQ(loop.walk.boundBy(parent), BoundBy::load);
    EXPECT_EQ(loop.walk.state.refined[parent], 0);
    EXPECT_GE(loop.toggles, 1u);
}

// 30 seconds at each of five places, with the noise of a device. Before that two minutes: what fits by a hair waits until the
// noise lets it in, and what is too much by a hair until it does not; each happens once.
TEST(FrontbenchHardCase, Nr20AStillCameraSwitchesNothingOnceItHasSettled) {
    for (const CostModel model : kBoth) {
        for (int view = 0; view < 5; ++view) {
            ClosedLoop loop = street(view, 3.0, model);
            loop.run(3600);
            loop.toggles = 0;
            loop.run(900);
            EXPECT_EQ(loop.toggles, 0u) << "view " << view << ", model " << static_cast<int>(model);
        }
    }
}

TEST(FrontbenchHardCase, Nr21NoTimeGoingByAndMuchTimeGoingByAreFrames) {
    ClosedLoop loop = street(0, 3.0);
    loop.run(300);
    loop.toggles = 0;
    loop.walk.dtSeconds = 0.0;
    loop.run(200);
    EXPECT_EQ(loop.toggles, 0u);
    loop.walk.dtSeconds = 0.1;  // the frame clamps what is more
    loop.run(200);
    EXPECT_EQ(loop.toggles, 0u);
    for (const float waited : loop.walk.state.waited) EXPECT_TRUE(std::isfinite(waited));
}

// At another frame rate the same walk switches about as often: all waits are in seconds, and only the noise comes more often.
TEST(Frontbench, SwitchesAsOftenAtAnyFrameRate) {
    const auto togglesOnTheWalk = [](double hz) {
        ClosedLoop loop = street(0, 3.0);
        loop.walk.dtSeconds = 1.0 / hz;
        const auto frames = static_cast<int>(40.0 * hz);
        for (int i = 0; i < frames; ++i) {
            const double z = -80.0 * i / frames;
            Camera camera = lookAt({0, 2, z}, {0, 2, z - 1}, {0, 1, 0});
            camera.fovyRadians = tinyCamera().fovyRadians;
            loop.walk.view = makeView(camera, {0, 0, -2}, 160, 90);
            loop.step();
        }
        return static_cast<double>(loop.toggles);
    };
    const double at30 = togglesOnTheWalk(30.0);
    EXPECT_GT(at30, 25.0);
    for (const double hz : {15.0, 60.0, 120.0}) EXPECT_NEAR(togglesOnTheWalk(hz) / at30, 1.0, 0.6) << hz;
    EXPECT_NEAR(togglesOnTheWalk(120.0) / togglesOnTheWalk(60.0), 1.0, 0.2) << "and does not go on rising";
}

}  // namespace
}  // namespace fb
