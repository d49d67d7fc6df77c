// What lies flat: the ground of a unit (streets, kerbs, pavements, yards; open under buildings) and its
// roofs. Both take their colour from one picture of the unit from above, as from an aerial photograph
// registered with the scan.
#pragma once

#include <span>
#include <vector>

#include "import/city_mesh.h"
#include "import/city_plan.h"

namespace fb::city {

// A sheet over a grid of x and z lines with a hole per covered cell.
struct GroundSheet {
    std::vector<double> x, z;   // rising
    std::vector<Rect> covered;  // cells inside these are left out
};

// Lines that kerbs and buildings need, without filling.
[[nodiscard]] GroundSheet groundFeatures(const CityPlan& plan, const Unit& unit);
[[nodiscard]] std::uint64_t countGround(const GroundSheet& features, double spacing);
void addGround(const CityPlan& plan, const Unit& unit, const GroundSheet& features, double spacing,
               std::uint32_t material, MeshBuilder& mesh);

[[nodiscard]] std::uint64_t countRoof(const Building& building, double spacing);
void addRoof(const Unit& unit, const Building& building, double spacing, std::uint32_t material,
             MeshBuilder& mesh);

// Adds lines so that none is further than `spacing` from the next.
[[nodiscard]] std::vector<double> fillEvenly(std::span<const double> lines, double spacing);
[[nodiscard]] std::uint64_t countEvenly(std::span<const double> lines, double spacing);  // intervals

}  // namespace fb::city
