// Shares the city's triangles and texels among its units and finds, for each unit, the sample spacing and the
// texel density that use its share up. Counts are exact: what is planned here is what is made later. Comes
// from CityPlan; goes to city_block, which makes one unit.
#pragma once

#include <span>
#include <vector>

#include "import/city_facade.h"
#include "import/city_ground.h"
#include "import/city_lumps.h"

namespace fb::city {

// Everything in a unit but its density. Cheap enough to be made again for each use.
struct UnitDesign {
    std::vector<Facade> facades;
    GroundSheet ground;
    std::vector<Thing> things;
};
[[nodiscard]] UnitDesign designUnit(const CityPlan& plan, const Unit& unit);

struct UnitBudget {
    double spacing = 1.0;  // of fronts, metres; the others are multiples of it
    double thingSpacing = 1.0;
    std::size_t things = 0;  // how many of the design's
    Detail detail = Detail::flat;
    std::vector<bool> grey;  // a facade of which there are no photographs
    double texelsPerMetre = 1.0;
    std::uint64_t triangles = 0, greyTriangles = 0, texels = 0;  // as they will come out
};

// One budget a unit; the rounding of each is made good by the next.
[[nodiscard]] std::vector<UnitBudget> shareBudget(const CityPlan& plan, const CityOptions& options);

// The spacing of a facade, of roofs and of the ground, in multiples of UnitBudget::spacing.
[[nodiscard]] double spacingFactor(FacadeRole role);
inline constexpr double kRoofSpacingFactor = 3.0, kGroundSpacingFactor = 3.5;

// Detail of a facade in a unit of the given detail: only fronts show small reliefs.
[[nodiscard]] Detail detailOf(const Facade& facade, const UnitBudget& budget);

struct PictureSize {
    int width = 0, height = 0;

    [[nodiscard]] std::uint64_t texels() const {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};
[[nodiscard]] PictureSize facadePictureSize(const Facade& facade, const FacadeGrid& grid,
                                            double texelsPerMetre);
[[nodiscard]] PictureSize aerialPictureSize(const Unit& unit, double texelsPerMetre);

}  // namespace fb::city
