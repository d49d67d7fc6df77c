// The phases of a build in their order, for tables.
#pragma once

#include "build/build_scene.h"

namespace fb::bench {

struct NamedPhase {
    const char* name;
    double BuildPhases::*seconds;
};

inline constexpr NamedPhase kPhases[] = {
    {"load", &BuildPhases::load},         {"textures", &BuildPhases::textures},
    {"simplify", &BuildPhases::simplify}, {"errors", &BuildPhases::errors},
    {"skirts", &BuildPhases::skirts},     {"dress", &BuildPhases::dress},
    {"atlas", &BuildPhases::atlas},       {"encode", &BuildPhases::encode},
    {"write", &BuildPhases::write}};

}  // namespace fb::bench
