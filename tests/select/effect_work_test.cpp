// An effect that is off does no work (design section 10): counted, not timed.
#include <gtest/gtest.h>

#include "worlds/random_worlds.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

constexpr Effect kOfTheSelection[] = {Effect::foreshortening, Effect::velocityLead, Effect::frustumFalloff,
                                      Effect::redistribution, Effect::texturePressure};

EffectWork workOf(const Policy& policy, const ActiveEffects& effects) {
    EffectWork work;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Random r(seed);
        TinyWalk walk(randomWorld(r), plainSettings(policy.id));
        walk.effects = effects;
        walk.textureMsPerByte = effects[Effect::texturePressure] ? 1e-6 : 0.0;
        walk.vTimeMs = 1e-3;
        walk.targetMs = walk.shareMs = 10.0;
        for (int frame = 0; frame < 3; ++frame) {
            walk.view = makeView(lookAt(randomPoint(r, 20.0), randomPoint(r, 5.0), {0, 1, 0}), {1, 0, 0}, 160, 90);
            walk.step();
            for (int i = 0; i < kEffectCount; ++i)
                work.count[static_cast<std::size_t>(i)] += walk.counters().effectWork.count[static_cast<std::size_t>(i)];
        }
    }
    return work;
}

TEST(EffectWork, IsNoneForWhatIsOffAndSomeForWhatIsOn) {
    for (const Policy& policy : policies()) {
        SCOPED_TRACE(policy.name);
        const EffectWork nothing = workOf(policy, {});
        for (const std::uint64_t count : nothing.count) EXPECT_EQ(count, 0u);
        for (const Effect one : kOfTheSelection) {
            ActiveEffects effects;
            effects[one] = true;
            const EffectWork work = workOf(policy, effects);
            for (const Effect other : kOfTheSelection) {
                const bool called = other == one && (one != Effect::redistribution || policy.usesShareTime);
                EXPECT_EQ(work[other] > 0, called) << static_cast<int>(one) << " " << static_cast<int>(other);
            }
        }
    }
}

}  // namespace
}  // namespace fb
