#include <gtest/gtest.h>

#include "control/control.h"
#include "control/model_device.h"
#include "select/count_allocations.h"
#include "worlds/random_worlds.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

class Allocations : public testing::TestWithParam<PolicyId> {};

TEST_P(Allocations, AreCounted) {
    const std::uint64_t before = allocationsSoFar();
    const std::vector<int> some(10);
    EXPECT_EQ(allocationsSoFar(), before + 1);
}

// All that the frame does between the camera and the next frame, as far as these stages go.
void frame(TinyWalk& walk, ControlState& control, FeatureRing& ring, const Settings& settings,
           const SceneFacts& facts, std::uint64_t& hash) {
    const double t = 0.1 * static_cast<double>(walk.frame % 60);
    const Camera camera = lookAt({20 * std::cos(t), 3, 20 * std::sin(t)}, {0, 0, 0}, {0, 1, 0});
    walk.view = makeView(camera, {1, 0, 0}, 160, 90);
    walk.effects = decideEffects(settings.effects, facts, {glm::length(walk.view.velocity), false, true});
    walk.shareMs = shareMs(control, settings.control);
    walk.vTimeMs = control.vTimeMs;
    ++walk.frame;
    selectFront(
        {walk.hierarchy, walk.loaded, walk.refused, walk.view, walk.settings, walk.effects, walk.vTimeMs,
         control.overheadMs, walk.shareMs, settings.control.targetMs, walk.dtSeconds, walk.frame},
        walk.state, walk.selection);
    hash = chainFrontHash(hash, walk.selection.front);
    const Selection& s = walk.selection;
    ring.push(
        {walk.frame, s.frontCost, estimateMs(control, s.frontCost), s.counters.refusedGroups, false, true});
    const double actualMs = modelFrameMs(
        settings.model, {s.texturedTriangles, s.triangles - s.texturedTriangles, s.front.size()}, walk.frame);
    if (const FrameFeatures* features = ring.find(walk.frame))
        feedBack(control, settings.control, *features, actualMs);
}

TEST_P(Allocations, AreNoneInAFrameAfterTheFirstRound) {
    Random r(42);
    Hierarchy world = randomWorld(r);
    while (world.size() < 40) world = randomWorld(r);
    const SceneFacts facts = gatherSceneFacts(world);
    TinyWalk walk(std::move(world), plainSettings(GetParam()));
    Settings settings;
    ControlState control = startControl(0.02, 2.0);
    FeatureRing ring;
    std::uint64_t hash = 0;
    // One round with every leaf: what the vectors may ever have to hold.
    walk.settings.policy = PolicyId::full;
    for (int i = 0; i < 60; ++i) frame(walk, control, ring, settings, facts, hash);
    walk.settings.policy = GetParam();
    std::uint64_t mostDrawn = 0;
    const std::uint64_t before = allocationsSoFar();
    for (int i = 0; i < 60; ++i) {
        frame(walk, control, ring, settings, facts, hash);
        mostDrawn = std::max<std::uint64_t>(mostDrawn, walk.selection.front.size());
    }
    EXPECT_EQ(allocationsSoFar(), before);
    EXPECT_GT(mostDrawn, 0u);
}

INSTANTIATE_TEST_SUITE_P(Policies, Allocations,
                         testing::Values(PolicyId::lakhia, PolicyId::lakhiaNaive, PolicyId::coarse,
                                         PolicyId::full),
                         [](const auto& row) {
                             std::string name(policyOf(row.param).name);
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace fb
