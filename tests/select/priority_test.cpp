#include "select/priority.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "worlds/tiny_worlds.h"

namespace fb {
namespace {

using V = glm::dvec3;

SelectSettings usual() {
    SelectSettings settings;
    settings.cVis = 1.275;
    settings.cFore = 0.45;
    settings.cTextured = 0.5;
    settings.frustumFalloff = 50.0;
    settings.minDistance = 1.0;
    settings.lookAhead = 0.25;
    return settings;
}

// One node; c_textured = 0.5, so that `cost` is its cost.
NodeView look(const TinyNode& node, const View& view, ActiveEffects effects = {},
              const SelectSettings& settings = usual()) {
    EffectWork work;
    return lookAtNode(makeWorld({node}), 0, view, settings, effects, work);
}

ActiveEffects with(Effect effect) {
    ActiveEffects effects;
    effects[effect] = true;
    return effects;
}

Box3f twoMetresAhead() {
    return boxOf({-0.25f, -0.25f, -3.0f}, {0.25f, 0.25f, -2.0f});
}

TEST(Priority, IsBenefitTimesVisibilityOverCostAndSquaredDistance) {
    // 12 * (1 + 1.275) / (3 * 2^2)
    const NodeView seen = look({.cost = 3, .benefit = 12, .box = twoMetresAhead()}, tinyView());
    EXPECT_TRUE(seen.visible);
    EXPECT_FALSE(seen.repaired);
    EXPECT_DOUBLE_EQ(seen.distance, 2.0);
    EXPECT_DOUBLE_EQ(seen.priority, 2.275);
}

TEST(Priority, WeighsTexturedAndUntexturedTrianglesByCTextured) {
    Hierarchy h = makeWorld({{.cost = 1, .benefit = 8}});
    h.texturedTriangles[0] = 100;
    h.untexturedTriangles[0] = 1000;
    SelectSettings settings = usual();
    settings.cVis = 0.0;
    settings.cTextured = 0.127;  // 12.7 + 873
    EffectWork work;
    EXPECT_DOUBLE_EQ(lookAtNode(h, 0, tinyView(), settings, {}, work).priority, 8.0 / 885.7);
}

TEST(Priority, TakesTheSmallestDistanceForAnEyeInsideTheBox) {
    SelectSettings settings = usual();
    settings.cVis = 0.0;
    const TinyNode around{.cost = 1, .benefit = 3, .box = boxOf({-9, -9, -9}, {9, 9, 9})};
    const NodeView seen = look(around, tinyView(), {}, settings);
    EXPECT_TRUE(seen.visible);
    EXPECT_EQ(seen.distance, 1.0);
    EXPECT_EQ(seen.priority, 3.0);
    settings.minDistance = 0.5;
    EXPECT_EQ(look(around, tinyView(), {}, settings).priority, 12.0);
}

TEST(Priority, WithoutTheFalloffEverythingOutOfViewIsOfTheSameVisibility) {
    const NodeView seen = look({.cost = 2, .benefit = 4, .box = behind()}, tinyView());
    EXPECT_FALSE(seen.visible);
    EXPECT_EQ(seen.distance, 1.0);
    EXPECT_EQ(seen.priority, 2.0);
}

TEST(Priority, FallsOffLinearlyOutsideTheView) {
    // 1.05 m outside of 50: fv = 0.979, vis = 1 + 1.275 * 0.979
    const ActiveEffects effects = with(Effect::frustumFalloff);
    EXPECT_NEAR(look({.cost = 2, .benefit = 4, .box = behind()}, tinyView(), effects).priority,
                2.0 * 2.248225, 1e-12);
    // 69.3 m outside: nothing is left; the distance is sqrt(100^2 + 1)
    EXPECT_NEAR(look({.cost = 2, .benefit = 4, .box = aside()}, tinyView(), effects).priority, 2.0 / 10001.0,
                1e-15);
    // ... until the falloff is longer: fv = 1 - 98 / sqrt 2 / 140
    SelectSettings settings = usual();
    settings.frustumFalloff = 140.0;
    EXPECT_NEAR(look({.cost = 2, .benefit = 4, .box = aside()}, tinyView(), effects, settings).priority,
                2.0 / 10001.0 * (1.0 + 1.275 * (1.0 - 98.0 / std::sqrt(2.0) / 140.0)), 1e-15);
    EXPECT_DOUBLE_EQ(look({.cost = 2, .benefit = 4}, tinyView(), effects).priority, 4.55)
        << "in view nothing changes";
}

// The camera looks along -z: a wall that faces it has the normal +z. The thesis prints the product with the
// normal of the image plane; the other sign would give the facing wall 0.55.
TEST(Foreshortening, AFacingWallMattersMoreThanItsBack) {
    SelectSettings settings = usual();
    settings.cVis = 0.0;
    const ActiveEffects effects = with(Effect::foreshortening);
    const auto fore = [&](glm::vec3 normal) {
        return look({.normal = normal}, tinyView(), effects, settings).priority;
    };
    EXPECT_DOUBLE_EQ(fore({0, 0, 1}), 1.45);
    EXPECT_DOUBLE_EQ(fore({0, 0, -1}), 0.55);
    EXPECT_DOUBLE_EQ(fore({1, 0, 0}), 1.0);
    EXPECT_NEAR(fore({0.6f, 0, 0.8f}), 1.36, 1e-7);
    EXPECT_EQ(look({.normal = {0, 0, 1}}, tinyView(), {}, settings).priority, 1.0) << "the effect is off";
}

TEST(VelocityLead, MeasuresFromWhereTheCameraWillBe) {
    SelectSettings settings = usual();
    settings.cVis = 0.0;
    const TinyNode node{.box = twoMetresAhead()};
    const auto distance = [&](V velocity, ActiveEffects effects) {
        return look(node, makeView(tinyCamera(), velocity, 100, 100), effects, settings).distance;
    };
    const ActiveEffects lead = with(Effect::velocityLead);
    EXPECT_EQ(distance(V(0, 0, 0), lead), 2.0);
    EXPECT_EQ(distance(V(0, 0, -2), lead), 1.5);  // a quarter of a second ahead
    EXPECT_EQ(distance(V(0, 0, 4), lead), 3.0);   // moving away: a speed added to the distance would say 1
    EXPECT_DOUBLE_EQ(distance(V(4, 0, 0), lead), std::sqrt(0.75 * 0.75 + 4.0));
    EXPECT_EQ(distance(V(0, 0, -2), {}), 2.0);
    settings.lookAhead = 0.5;
    EXPECT_EQ(distance(V(0, 0, -1), lead), 1.5);
}

TEST(VelocityLead, ChangesNothingAboutWhatIsVisible) {
    const View fast = makeView(tinyCamera(), V(0, 0, -1000), 100, 100);
    EXPECT_TRUE(look({}, fast, with(Effect::velocityLead)).visible);
    EXPECT_FALSE(
        look({.box = behind()}, makeView(tinyCamera(), V(0, 0, 1000), 100, 100), with(Effect::velocityLead))
            .visible);
}

// What is off is not even read: the plain formula, to the last bit, beside velocities and normals that are no
// numbers.
RC_GTEST_PROP(Priority, EffectsThatAreOffDoNoArithmetic, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    SelectSettings settings = usual();
    settings.cVis = r.uniform(0, 10);
    settings.cTextured = 0.5;
    settings.minDistance = r.uniform(0.1, 3);
    const glm::vec3 low(r.uniform(-9, 9), r.uniform(-9, 9), r.uniform(-9, 9));
    const TinyNode node{.cost = 1 + static_cast<std::uint32_t>(r.index(1000)),
                        .benefit = static_cast<float>(r.uniform(0.01, 100)),
                        .box = boxOf(low, low + glm::vec3(3)),
                        .normal = {nan, nan, nan}};
    const View view = makeView(tinyCamera(), V(nan, nan, nan), 100, 100);
    EffectWork work;
    const NodeView seen = lookAtNode(makeWorld({node}), 0, view, settings, {}, work);
    const double d = std::max(settings.minDistance, Box3d{V(node.box.min), V(node.box.max)}.distance(V(0)));
    const double vis = 1.0 + settings.cVis * (meetsView(view, node.box) ? 1.0 : 0.0);
    RC_ASSERT(seen.distance == d);
    RC_ASSERT(seen.priority == double{node.benefit} * vis / (node.cost * d * d));
    RC_ASSERT(!seen.repaired);
}

RC_GTEST_PROP(Priority, IsFiniteAndAboveZeroWhateverTheNodeHolds, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    const float oddities[] = {0.0f,
                              -0.0f,
                              -1.0f,
                              1e-45f,
                              1e38f,
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN(),
                              1.0f};
    const auto odd = [&] { return oddities[r.index(std::size(oddities))]; };
    SelectSettings settings = usual();
    settings.cVis = r.uniform(0, 100);
    settings.cFore = r.uniform(0, 0.99);
    settings.minDistance = r.uniform(1e-6, 1000);
    ActiveEffects effects;
    for (bool& on : effects.on) on = r.index(2) == 1;
    const TinyNode node{
        .cost = static_cast<std::uint32_t>(r.index(3)), .benefit = odd(), .normal = {odd(), odd(), odd()}};
    const View view = makeView(tinyCamera(), V(odd(), odd(), odd()), 100, 100);
    EffectWork work;
    const NodeView seen = lookAtNode(makeWorld({node}), 0, view, settings, effects, work);
    RC_ASSERT(std::isfinite(seen.priority));
    RC_ASSERT(seen.priority > 0.0);
    RC_ASSERT(seen.distance >= settings.minDistance);
    RC_ASSERT(!seen.repaired || seen.priority == 1e-12);
}

}  // namespace
}  // namespace fb
