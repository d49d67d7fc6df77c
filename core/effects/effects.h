// Effects run only where the scene calls for them (design section 10). Facts of the scene and the frame go in; a
// decision with its reason in words comes out. A stage asks ActiveEffects and does no work for what is off.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scenefile/hierarchy.h"
#include "settings/settings.h"

namespace fb {

enum class Effect : std::uint8_t {
    texturing,
    lighting,
    foreshortening,
    velocityLead,
    frustumFalloff,
    shareFeedback,
    redistribution,
    fillRate,
    texturePressure
};
inline constexpr int kEffectCount = 9;

struct SceneFacts {
    std::uint64_t texturedTriangles = 0, untexturedTriangles = 0;
    double meanNormalCoherence = 0.0;  // area weighted over the leaves
};
[[nodiscard]] SceneFacts gatherSceneFacts(const Hierarchy& hierarchy);

struct FrameFacts {
    double speedMetresPerSecond = 0.0;
    bool everythingLoaded = false;
    bool policyUsesShareTime = true;
    bool policyHasCounters = true;  // of hysteresis
    bool slicesUnused = false;  // in the frame before, leaves were drawn: they may have had more time than they need
    double fillShare = 0.0;     // time of filling the whole picture as a part of the target
    std::uint64_t residentTextureBytes = 0, textureBudgetBytes = 0;  // no budget: 0
};

struct ActiveEffects {
    std::array<bool, kEffectCount> on{};
    [[nodiscard]] bool operator[](Effect e) const { return on[static_cast<std::size_t>(e)]; }
    bool& operator[](Effect e) { return on[static_cast<std::size_t>(e)]; }
};

// How often each effect's own arithmetic ran: 0 for what is off.
struct EffectWork {
    std::array<std::uint64_t, kEffectCount> count{};
    [[nodiscard]] std::uint64_t operator[](Effect e) const { return count[static_cast<std::size_t>(e)]; }
    std::uint64_t& operator[](Effect e) { return count[static_cast<std::size_t>(e)]; }
};

struct EffectDecision {
    bool on = false;
    std::string reason;  // "no textured triangles", "switched on by the setting"
};

struct EffectRow {
    Effect effect;
    std::string_view name;  // as in the knob effects.NAME
    EffectMode (*mode)(const EffectSettings&);
    bool (*calledFor)(const SceneFacts&, const FrameFacts&);
    std::string (*reason)(const SceneFacts&, const FrameFacts&, bool calledFor);
};
[[nodiscard]] std::span<const EffectRow> effectTable();

// Decisions with words, for the panel and the report.
[[nodiscard]] EffectDecision decideEffect(const EffectRow& row, const EffectSettings& settings, const SceneFacts& scene,
                                          const FrameFacts& frame);
// The same decisions without the words: what the frame uses; allocates nothing.
[[nodiscard]] ActiveEffects decideEffects(const EffectSettings& settings, const SceneFacts& scene,
                                          const FrameFacts& frame);

}  // namespace fb
