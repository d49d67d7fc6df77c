// Things that stand about and were scanned without photographs: cars, trees, lamp posts, machinery on roofs.
// Each is a few lumps, coarse and noisy; they make most of the city's untextured triangles.
#pragma once

#include <vector>

#include "import/city_mesh.h"
#include "import/city_plan.h"

namespace fb::city {

enum class LumpShape : std::uint8_t { box, ball, car };

// A box, a ball or a car body of this size standing on `base` (the middle of its underside).
struct Lump {
    LumpShape shape = LumpShape::box;
    glm::dvec3 base{0.0};
    glm::dvec3 size{1.0};
    double noiseMetres = 0.02;
    std::uint32_t seed = 0;
    bool underside = false;  // seen from below; the others are open there
};

// Lumps that belong together: kept or left out as one.
using Thing = std::vector<Lump>;

// Everything that stands in a unit, the most wanted first.
[[nodiscard]] std::vector<Thing> placeThings(const CityPlan& plan, const Unit& unit);

[[nodiscard]] std::uint64_t countThing(const Thing& thing, double spacing);
void addThing(const Thing& thing, double spacing, std::uint32_t material, MeshBuilder& mesh);

}  // namespace fb::city
