// What the feedback tells the selection (algorithms 3.1).
#include <gtest/gtest.h>

#include <cmath>

#include "worlds/feedback.h"
#include "worlds/tiny_worlds.h"

namespace fb {
namespace {

Hierarchy oneNode(std::uint32_t textured, std::uint32_t untextured, std::uint16_t side = 0) {
    Hierarchy h = makeWorld({{}});
    h.texturedTriangles[0] = textured;
    h.untexturedTriangles[0] = untextured;
    h.textureWidth[0] = h.textureHeight[0] = side;
    return h;
}

TEST(TimeModel, OfVTimeIsVTimeTimesCostAndOverheadAndFill) {
    ControlState state = startControl(ControlSettings{}, {0.5, 2.0, 4.0}, 0.25);
    const TimeModel model = timeModel(state, {}, 0.25, 0.75, nullptr);
    EXPECT_EQ(model.fixedMs, 2.0 + 4.0 * 0.75);
    EXPECT_EQ(nodeTimeMs(model, oneNode(40, 20), 0), 0.5 * (40 * 0.25 + 20 * 0.75));
    EXPECT_EQ(nodeTimeMs(model, oneNode(0, 0), 0), 0.5) << "cost is at least 1";
    state.vTimeMs = 0.0;
    EXPECT_GT(nodeTimeMs(timeModel(state, {}, 0.25, 0.0, nullptr), oneNode(40, 20), 0), 0.0);
}

TEST(TimeModel, OfLeastSquaresHasAWeightForEachKindOfWorkAndTheFastFactor) {
    ControlSettings settings;
    settings.costModel = CostModel::leastSquares;
    ControlState state = startControl(settings, {0.5, 2.0, 4.0}, 0.25);
    state.fit.theta = {100.0, 200.0, 3.0, 8.0, 1.0};
    state.fit.factor = 2.0;
    const TimeModel model = timeModel(state, settings, 0.25, 0.5, nullptr);
    EXPECT_EQ(model.fixedMs, 2.0 * (8.0 * 0.5 + 1.0));
    EXPECT_DOUBLE_EQ(nodeTimeMs(model, oneNode(40, 20), 0), 2.0 * (4.0 + 4.0 + 3.0));
}

TEST(TimeModel, ChargesTexturesOnlyForTheShareThatDoesNotFit) {
    ControlSettings settings;
    settings.texturePressure = 6.0;
    const ControlState state = startControl(settings, {0.5, 0.0, 0.0}, 0.5);
    const Hierarchy textured = oneNode(2, 0, 512);  // 1 MiB, 4/3 with mip levels
    const double mib = static_cast<double>(textured.textureBytes(0)) / 1048576.0;
    EXPECT_NEAR(mib, 4.0 / 3.0, 1e-5);
    const TexturePressure none{100, 100}, half{200, 100};
    EXPECT_EQ(nodeTimeMs(timeModel(state, settings, 0.5, 0.0, &none), textured, 0), 0.5);
    EXPECT_DOUBLE_EQ(nodeTimeMs(timeModel(state, settings, 0.5, 0.0, &half), textured, 0), 0.5 + 3.0 * mib);
    EXPECT_EQ(nodeTimeMs(timeModel(state, settings, 0.5, 0.0, &half), oneNode(2, 0), 0), 0.5);
}

TEST(TimeModel, TellsHowFastTheDeviceIsOverSecondsAgainstNow) {
    ControlSettings settings;
    settings.slowSeconds = 0.9;
    ControlState state = startControl(settings, {0.5, 0.0, 0.0}, 0.5);
    EXPECT_EQ(timeModel(state, settings, 0.5, 0.0, nullptr).slowRatio, 1.0);
    state.vTimeMs = 1.0;  // half as fast all of a sudden
    EXPECT_EQ(timeModel(state, settings, 0.5, 0.0, nullptr).slowRatio, 0.5);
    passTime(state, settings, 0.1);  // a tenth of the way
    EXPECT_DOUBLE_EQ(timeModel(state, settings, 0.5, 0.0, nullptr).slowRatio, 0.55);
    for (int i = 0; i < 500; ++i) passTime(state, settings, 0.1);
    EXPECT_NEAR(timeModel(state, settings, 0.5, 0.0, nullptr).slowRatio, 1.0, 1e-9);
    passTime(state, settings, 0.0);
    EXPECT_NEAR(state.slowSpeed, 2.0, 1e-9) << "no time, no change";
}

TEST(Residual, FollowsTheUsualErrorAndIsNotMovedFarByOneStall) {
    ControlSettings settings;
    settings.targetMs = 30.0;
    ControlState state = startedAt(0.25, 0.0);
    EXPECT_DOUBLE_EQ(timeModel(state, settings, 0.5, 0.0, nullptr).residualMs, 0.9);
    FrameFeatures frame{.frame = 1, .frontCost = 100.0, .estimateMs = 25.0};
    // One of 1000 ms counts as four times the usual error: 0.9 + 0.02 * (1.2533 * 3.6 - 0.9)
    feed(state, settings, frame, 1025.0);
    EXPECT_DOUBLE_EQ(state.residualMs, 0.9 + 0.02 * (1.2533 * 3.6 - 0.9));
    for (int i = 0; i < 2000; ++i) feed(state, settings, frame, 25.0);
    EXPECT_DOUBLE_EQ(state.residualMs, 0.15) << "at least half a per cent of the target";
    for (int i = 0; i < 2000; ++i) feed(state, settings, frame, i % 2 == 0 ? 24.0 : 26.0);
    EXPECT_NEAR(state.residualMs, 1.2533, 1e-6);
    for (int i = 0; i < 4000; ++i) feed(state, settings, frame, 125.0);
    EXPECT_DOUBLE_EQ(state.residualMs, 3.0) << "at most a tenth of the target";
}

TEST(CostModel, IsTakenUpWhereVTimeIsWhenItIsSwitched) {
    ControlState state = startedAt(0.002, 2.0);
    state.vTimeMs = 0.004;
    followCostModel(state, CostModel::leastSquares, 0.5);
    ControlSettings settings;
    const TimeModel model = timeModel(state, settings, 0.5, 0.0, nullptr);
    EXPECT_DOUBLE_EQ(model.texturedMs, 0.002);
    EXPECT_DOUBLE_EQ(model.untexturedMs, 0.002);
    EXPECT_DOUBLE_EQ(model.fixedMs, 2.0);
    EXPECT_EQ(model.slowRatio, 1.0);
    state.fit.measured = 20;
    const CostFit before = state.fit;
    followCostModel(state, CostModel::leastSquares, 0.5);
    EXPECT_EQ(state.fit.measured, before.measured) << "what was learnt stays";
    followCostModel(state, CostModel::vTime, 0.5);
    EXPECT_DOUBLE_EQ(timeModel(state, settings, 0.5, 0.0, nullptr).texturedMs, 0.002);
}

}  // namespace
}  // namespace fb
