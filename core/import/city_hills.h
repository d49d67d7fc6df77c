// The hills under and around the procedural city (`city --terrain`): gentle where the city stands, mountains
// beyond. Comes from CityOptions; goes to the plan (where buildings stand), to the meshes, and as a height
// map with a painted picture to build/build_terrain. Only integer hashes and + - * / on doubles: the same
// bits on every machine.
#pragma once

#include <cstdint>
#include <memory>

#include "import/terrain_source.h"

namespace fb::city {

struct CityPlan;
struct Unit;
class MeshBuilder;

struct Hills {
    bool exist = false;  // false: flat everywhere
    std::uint32_t seed = 0;
    double x0 = 0.0, z0 = 0.0, x1 = 0.0, z1 = 0.0;  // the city's ground

    // Metres at a place; 0 everywhere without hills. At most a tenth of slope in the city.
    [[nodiscard]] double heightAt(double x, double z) const;
    // The highest and the lowest of a rectangle, up to a few centimetres: looked at every two metres at most.
    struct Range {
        double low = 0.0, high = 0.0;
    };
    [[nodiscard]] Range within(double left, double top, double right, double bottom) const;
};

// Foundations below all walls of the unit's buildings, and a strip below the unit's border, so that no gap
// shows where the ground falls away or neighbouring units sample it differently.
void addFoundations(const CityPlan& plan, const Unit& unit, std::uint32_t material, MeshBuilder& mesh);

// The country: three times as wide and deep as the city, which stands in a hole of it; around that hole's
// edge the country reaches a little under the city, lower than its ground.
[[nodiscard]] std::unique_ptr<TerrainSource> makeCountry(const CityPlan& plan);

inline constexpr double kUnderCity =
    0.5;  // metres by which the country lies below the city's ground at its edge

}  // namespace fb::city
