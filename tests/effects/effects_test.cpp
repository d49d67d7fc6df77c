#include "effects/effects.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "settings/knob_table.h"
#include "worlds/random_worlds.h"

namespace fb {
namespace {

const EffectRow& rowOf(Effect effect) {
    return effectTable()[static_cast<std::size_t>(effect)];
}

EffectDecision decide(Effect effect, const SceneFacts& scene, const FrameFacts& frame = {}) {
    return decideEffect(rowOf(effect), EffectSettings{}, scene, frame);
}

void expectDecision(const EffectDecision& decision, bool on, const std::string& reason) {
    EXPECT_EQ(decision.on, on) << reason;
    EXPECT_EQ(decision.reason, reason);
}

TEST(EffectTable, HasARowForEachEffectAndAKnobForEachRow) {
    ASSERT_EQ(effectTable().size(), static_cast<std::size_t>(kEffectCount));
    for (int i = 0; i < kEffectCount; ++i) {
        const EffectRow& row = effectTable()[static_cast<std::size_t>(i)];
        EXPECT_EQ(row.effect, static_cast<Effect>(i));
        const Knob* knob = findKnob("effects." + std::string(row.name));
        ASSERT_NE(knob, nullptr) << row.name;
        ASSERT_EQ(knob->choices.size(), 3u);
        EXPECT_EQ(knob->choices[0], "off");
        EXPECT_EQ(knob->choices[1], "on");
        EXPECT_EQ(knob->choices[2], "auto");
        // The knob sets the mode that the row reads, and no other row's.
        for (double mode : {0.0, 1.0, 2.0}) {
            Settings settings;
            knob->set(settings, mode);
            for (const EffectRow& other : effectTable()) {
                const EffectMode expected = other.effect == row.effect
                                                ? static_cast<EffectMode>(static_cast<int>(mode))
                                                : EffectMode::automatic;
                EXPECT_EQ(other.mode(settings.effects), expected) << row.name << " against " << other.name;
            }
        }
    }
}

TEST(Effects, AreSwitchedOnAndOffByTheSettingWhateverTheScene) {
    for (const EffectRow& row : effectTable()) {
        Settings settings;
        const Knob* knob = findKnob("effects." + std::string(row.name));
        for (const bool called : {false, true}) {
            const SceneFacts scene = called ? SceneFacts{1, 1, 1.0} : SceneFacts{};
            const FrameFacts frame{called ? 1.0 : 0.0, !called, called, called, called, called ? 0.5 : 0.0, called ? 2u : 1u, 1};
            ASSERT_EQ(row.calledFor(scene, frame), called) << row.name;
            knob->set(settings, 0.0);
            expectDecision(decideEffect(row, settings.effects, scene, frame), false,
                           "switched off by the setting");
            knob->set(settings, 1.0);
            expectDecision(decideEffect(row, settings.effects, scene, frame), true,
                           "switched on by the setting");
            knob->set(settings, 2.0);
            EXPECT_EQ(decideEffect(row, settings.effects, scene, frame).on, called);
        }
    }
}

TEST(Effects, TexturingIsCalledForByTexturedTriangles) {
    expectDecision(decide(Effect::texturing, {0, 500, 1.0}), false, "no textured triangles");
    expectDecision(decide(Effect::texturing, {1, 500, 0.0}), true, "1 textured triangles");
    expectDecision(decide(Effect::texturing, {8950000, 0, 0.0}), true, "8950000 textured triangles");
}

TEST(Effects, LightingIsCalledForByTrianglesWithoutTexture) {
    expectDecision(decide(Effect::lighting, {500, 0, 0.0}), false,
                   "every triangle is textured: the light is in the photographs");
    expectDecision(decide(Effect::lighting, {500, 12, 0.0}), true, "12 triangles without texture");
}

TEST(Effects, ForeshorteningIsCalledForByCoherentNormals) {
    expectDecision(decide(Effect::foreshortening, {1, 0, 0.11}), false,
                   "normals of the nodes are incoherent: 0.11 < 0.50");
    expectDecision(decide(Effect::foreshortening, {1, 0, 0.5}), true,
                   "normals of the nodes are coherent: 0.50 >= 0.50");
    expectDecision(decide(Effect::foreshortening, {1, 0, 0.93}), true,
                   "normals of the nodes are coherent: 0.93 >= 0.50");
    // Rounded to the nearest it would say 0.50 < 0.50.
    expectDecision(decide(Effect::foreshortening, {1, 0, 0.4999}), false,
                   "normals of the nodes are incoherent: 0.49 < 0.50");
}

TEST(Effects, VelocityLeadIsCalledForByAMovingCamera) {
    expectDecision(decide(Effect::velocityLead, {}, {0.0, false, true}), false, "camera at rest");
    expectDecision(decide(Effect::velocityLead, {}, {0.001, false, true}), false, "camera at rest");
    expectDecision(decide(Effect::velocityLead, {}, {0.0011, false, true}), true,
                   "camera moves at 0.0011 m/s");
    expectDecision(decide(Effect::velocityLead, {}, {1.4, false, true}), true, "camera moves at 1.4 m/s");
    expectDecision(decide(Effect::velocityLead, {}, {std::numeric_limits<double>::quiet_NaN(), false, true}),
                   false, "camera at rest");
}

TEST(Effects, FrustumFalloffIsCalledForWhileSomethingIsNotLoaded) {
    expectDecision(decide(Effect::frustumFalloff, {}, {0.0, true, true}), false, "everything is loaded");
    expectDecision(decide(Effect::frustumFalloff, {}, {0.0, false, true}), true,
                   "there is something to load");
}

TEST(Effects, ShareFeedbackIsCalledForByPoliciesWithAShareTime) {
    expectDecision(decide(Effect::shareFeedback, {}, {0.0, false, true}), true,
                   "the policy shares time out from the roots");
    expectDecision(decide(Effect::shareFeedback, {}, {0.0, false, false}), false,
                   "the policy has no share time");
}

RC_GTEST_PROP(Effects, AreDecidedAlikeWithAndWithoutWords, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    Settings settings;
    randomiseGroup(r, settings, "effects");
    const SceneFacts scene{r.index(3), r.index(3), r.uniform()};
    const FrameFacts frame{r.index(2) == 0 ? 0.0 : r.uniform(0.0, 0.01), r.index(2) == 0, r.index(2) == 0};
    const ActiveEffects active = decideEffects(settings.effects, scene, frame);
    for (const EffectRow& row : effectTable()) {
        const EffectDecision decision = decideEffect(row, settings.effects, scene, frame);
        RC_ASSERT(decision.on == active[row.effect]);
        RC_ASSERT(!decision.reason.empty());
    }
}

//      0          the leaves are 1 and 2; what 0 holds is the same surface again
//     / \         .
//    1   2
TEST(SceneFacts, AreGatheredFromTheLeavesWeighedByArea) {
    Hierarchy h = makeWorld({{.children = {{}, {}}}});
    h.texturedTriangles = {1000, 30, 4};
    h.untexturedTriangles = {500, 0, 7};
    h.areaSquareMetres = {100.0f, 3.0f, 1.0f};
    h.normalCoherence = {0.0f, 0.5f, 0.9f};
    const SceneFacts facts = gatherSceneFacts(h);
    EXPECT_EQ(facts.texturedTriangles, 34u);
    EXPECT_EQ(facts.untexturedTriangles, 7u);
    EXPECT_NEAR(facts.meanNormalCoherence, (3.0 * 0.5 + 1.0 * 0.9) / 4.0, 1e-7);
}

TEST(SceneFacts, OfASceneWithoutAreaAreNotCoherent) {
    const SceneFacts facts = gatherSceneFacts(makeWorld({{}}));
    EXPECT_EQ(facts.meanNormalCoherence, 0.0);
}

}  // namespace
}  // namespace fb
