// Settings: plain structs, one per group, generated from the rows of knobs/*.def so that a default is written once.
// A stage takes its group as const; what it needs adjusted it copies.
#pragma once

#include <cstdint>

namespace fb {

enum class Simplifier : std::uint8_t { meshoptimizer, openMesh };
enum class TextureCodec : std::uint8_t { automatic, jpeg, lossless };
enum class PolicyId : std::uint8_t {
    lakhia,
    lakhiaNaive,
    funkhouser,
    funkhouserIncremental,
    macielShirley,
    erikson,
    greedy,
    screenError,
    coarse,
    full,
    frontbench
};
inline constexpr int kPolicyCount = 11;
enum class GainMeasure : std::uint8_t { benefit, error };
enum class LoadOrder : std::uint8_t { priority, gain };
enum class CostModel : std::uint8_t { vTime, leastSquares };
enum class ColourMode : std::uint8_t { scene, level };
enum class EffectMode : std::uint8_t { off, on, automatic };

#define FB_REAL(member, key, symbol, initial, low, high, unit, reruns, help, equation) double member = initial;
#define FB_INT(member, key, symbol, initial, low, high, unit, reruns, help, equation) std::int64_t member = initial;
#define FB_BOOL(member, key, symbol, initial, reruns, help, equation) bool member = initial;
#define FB_CHOICE(member, key, symbol, Type, initial, reruns, help, equation, ...) Type member = initial;

struct BuildSettings {
#include "settings/knobs/build.def"
};
struct SelectSettings {
#include "settings/knobs/select.def"
};
struct ControlSettings {
#include "settings/knobs/control.def"
};
struct LoadSettings {
#include "settings/knobs/load.def"
};
struct DrawSettings {
#include "settings/knobs/draw.def"
};
struct ModelSettings {
#include "settings/knobs/model.def"
};
struct EffectSettings {
#include "settings/knobs/effects.def"
};

#undef FB_REAL
#undef FB_INT
#undef FB_BOOL
#undef FB_CHOICE

struct Settings {
    BuildSettings build;
    SelectSettings select;
    ControlSettings control;
    LoadSettings load;
    DrawSettings draw;
    ModelSettings model;
    EffectSettings effects;
};

}  // namespace fb
