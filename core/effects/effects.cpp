#include "effects/effects.h"

#include <cmath>
#include <cstdio>

namespace fb {
namespace {

// Below this the normals of a node's triangles point in all directions and their average says nothing.
constexpr double kCoherentNormals = 0.5;
constexpr double kNoticeableFill = 0.02;
constexpr double kStandingStill = 1e-3;  // m/s

std::string withNumber(const char* format, double value) {
    char text[96];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

constexpr std::array<EffectRow, kEffectCount> kTable = {{
    {Effect::texturing, "texturing", [](const EffectSettings& s) { return s.texturing; },
     [](const SceneFacts& s, const FrameFacts&) { return s.texturedTriangles > 0; },
     [](const SceneFacts& s, const FrameFacts&, bool on) -> std::string {
         if (!on) return "no textured triangles";
         return withNumber("%.0f textured triangles", static_cast<double>(s.texturedTriangles));
     }},
    {Effect::lighting, "lighting", [](const EffectSettings& s) { return s.lighting; },
     [](const SceneFacts& s, const FrameFacts&) { return s.untexturedTriangles > 0; },
     [](const SceneFacts& s, const FrameFacts&, bool on) -> std::string {
         if (!on) return "every triangle is textured: the light is in the photographs";
         return withNumber("%.0f triangles without texture", static_cast<double>(s.untexturedTriangles));
     }},
    {Effect::foreshortening, "foreshortening", [](const EffectSettings& s) { return s.foreshortening; },
     [](const SceneFacts& s, const FrameFacts&) { return s.meanNormalCoherence >= kCoherentNormals; },
     [](const SceneFacts& s, const FrameFacts&, bool on) -> std::string {
         return withNumber(on ? "normals of the nodes are coherent: %.2f >= 0.50"
                              : "normals of the nodes are incoherent: %.2f < 0.50",
                           std::floor(100.0 * s.meanNormalCoherence) / 100.0);  // 0.499 is not 0.50
     }},
    {Effect::velocityLead, "velocity_lead", [](const EffectSettings& s) { return s.velocityLead; },
     [](const SceneFacts&, const FrameFacts& f) { return f.speedMetresPerSecond > kStandingStill; },
     [](const SceneFacts&, const FrameFacts& f, bool on) -> std::string {
         if (!on) return "camera at rest";
         return withNumber("camera moves at %.4g m/s", f.speedMetresPerSecond);
     }},
    {Effect::frustumFalloff, "frustum_falloff", [](const EffectSettings& s) { return s.frustumFalloff; },
     [](const SceneFacts&, const FrameFacts& f) { return !f.everythingLoaded; },
     [](const SceneFacts&, const FrameFacts&, bool on) -> std::string {
         return on ? "there is something to load" : "everything is loaded";
     }},
    {Effect::shareFeedback, "share_feedback", [](const EffectSettings& s) { return s.shareFeedback; },
     [](const SceneFacts&, const FrameFacts& f) { return f.policyUsesShareTime; },
     [](const SceneFacts&, const FrameFacts&, bool on) -> std::string {
         return on ? "the policy shares time out from the roots" : "the policy has no share time";
     }},
    {Effect::redistribution, "redistribution", [](const EffectSettings& s) { return s.redistribution; },
     [](const SceneFacts&, const FrameFacts& f) { return f.policyUsesShareTime && f.policyHasCounters && f.slicesUnused; },
     [](const SceneFacts&, const FrameFacts& f, bool on) -> std::string {
         if (on) return "leaves are drawn, which may have more time than they need";
         if (!f.policyUsesShareTime) return "the policy has no share time";
         return f.policyHasCounters ? "no leaf is drawn: every slice can be used"
                                    : "without counters of hysteresis it would switch in every frame";
     }},
    {Effect::fillRate, "fill_rate", [](const EffectSettings& s) { return s.fillRate; },
     [](const SceneFacts&, const FrameFacts& f) { return f.fillShare >= kNoticeableFill; },
     [](const SceneFacts&, const FrameFacts& f, bool on) -> std::string {
         return withNumber(on ? "filling the picture takes %.1f %% of the target"
                              : "filling the picture takes %.1f %% of the target: less than 2 %%",
                           100.0 * f.fillShare);
     }},
    {Effect::texturePressure, "texture_pressure", [](const EffectSettings& s) { return s.texturePressure; },
     [](const SceneFacts&, const FrameFacts& f) {
         return f.textureBudgetBytes > 0 && f.residentTextureBytes > f.textureBudgetBytes;
     },
     [](const SceneFacts&, const FrameFacts& f, bool on) -> std::string {
         if (f.textureBudgetBytes == 0) return "textures have no budget of their own";
         return withNumber(on ? "textures in memory are %.2f times their budget: more than 1"
                              : "textures in memory are %.2f times their budget",
                           static_cast<double>(f.residentTextureBytes) / static_cast<double>(f.textureBudgetBytes));
     }},
}};

}  // namespace

SceneFacts gatherSceneFacts(const Hierarchy& hierarchy) {
    SceneFacts facts;
    double area = 0.0;
    double coherent = 0.0;
    for (NodeId n = 0; n < hierarchy.size(); ++n) {
        if (!hierarchy.isLeaf(n)) continue;
        facts.texturedTriangles += hierarchy.texturedTriangles[n];
        facts.untexturedTriangles += hierarchy.untexturedTriangles[n];
        area += hierarchy.areaSquareMetres[n];
        coherent += static_cast<double>(hierarchy.areaSquareMetres[n]) * hierarchy.normalCoherence[n];
    }
    facts.meanNormalCoherence = area > 0.0 ? coherent / area : 0.0;
    return facts;
}

std::span<const EffectRow> effectTable() { return kTable; }

EffectDecision decideEffect(const EffectRow& row, const EffectSettings& settings, const SceneFacts& scene,
                            const FrameFacts& frame) {
    switch (row.mode(settings)) {
        case EffectMode::off: return {false, "switched off by the setting"};
        case EffectMode::on: return {true, "switched on by the setting"};
        case EffectMode::automatic: break;
    }
    const bool on = row.calledFor(scene, frame);
    return {on, row.reason(scene, frame, on)};
}

ActiveEffects decideEffects(const EffectSettings& settings, const SceneFacts& scene, const FrameFacts& frame) {
    ActiveEffects active;
    for (const EffectRow& row : kTable) {
        const EffectMode mode = row.mode(settings);
        active[row.effect] = mode == EffectMode::on || (mode == EffectMode::automatic && row.calledFor(scene, frame));
    }
    return active;
}

}  // namespace fb
