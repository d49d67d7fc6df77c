#include "import/city_budget.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace fb::city {
namespace {

constexpr double kGreyShare = 0.10;   // of all triangles
constexpr double kThingShare = 0.07;  // of all triangles: things, if there are enough of them
constexpr double kFinestThing = 0.06, kCoarsestThing = 6.0;  // metres
constexpr int kLeastSide = 8, kLargestSide = 4096;           // texels of a picture

// Of a count that never rises with x: the smallest x in [low, high] with count(x) <= target, or `high`.
template <class Count>
double smallestWithin(double low, double high, double target, const Count& count) {
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2.0;
        (static_cast<double>(count(middle)) <= target ? high : low) = middle;
    }
    return high;
}

// In [0.5, 2], most often near 1, as likely halved as doubled.
double spread(Random& random) {
    const double a = random.uniform(), b = random.uniform();
    const double u = a + b - 1.0;
    return u >= 0.0 ? 1.0 + u : 1.0 / (1.0 - u);
}

struct UnitCounts {
    const Unit& unit;
    const UnitDesign& design;
    std::vector<FacadeGrid> grids;  // features only

    std::uint64_t facade(std::size_t i, double spacing) const {
        return countFilled(grids[i], spacing * spacingFactor(design.facades[i].role));
    }
    std::uint64_t sheets(double spacing) const {
        std::uint64_t count = countGround(design.ground, spacing * kGroundSpacingFactor);
        for (std::size_t i = 0; i < grids.size(); ++i) count += facade(i, spacing);
        for (const Building& b : unit.buildings) count += countRoof(b, spacing * kRoofSpacingFactor);
        return count;
    }
    std::uint64_t things(std::size_t howMany, double spacing) const {
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < howMany; ++i) count += countThing(design.things[i], spacing);
        return count;
    }
    std::uint64_t texels(const std::vector<bool>& grey, double texelsPerMetre) const {
        std::uint64_t count = aerialPictureSize(unit, texelsPerMetre).texels();
        for (std::size_t i = 0; i < grids.size(); ++i) {
            if (!grey[i]) count += facadePictureSize(design.facades[i], grids[i], texelsPerMetre).texels();
        }
        return count;
    }
};

// Flat walls where features would take most of the triangles, small reliefs where samples are dense.
Detail chooseDetail(const UnitDesign& design, double triangles) {
    double area = 0.0;
    for (const Facade& facade : design.facades) {
        if (facade.role == FacadeRole::front) area += facade.areaSquareMetres();
    }
    const double spacing = std::sqrt(2.0 * area / (0.6 * triangles));
    return spacing > 0.5 ? Detail::flat : spacing > 0.17 ? Detail::coarse : Detail::all;
}

// Backs and bare walls go without photographs until the untextured share is met.
void chooseGrey(const UnitCounts& counts, double greyTarget, UnitBudget& budget, Random random) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < counts.design.facades.size(); ++i) {
        if (counts.design.facades[i].role != FacadeRole::front) order.push_back(i);
    }
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    budget.grey.assign(counts.design.facades.size(), false);
    for (const std::size_t i : order) {
        const auto with = static_cast<double>(budget.greyTriangles + counts.facade(i, budget.spacing));
        if (with > greyTarget * 1.15) continue;
        budget.grey[i] = true;
        budget.greyTriangles = static_cast<std::uint64_t>(with);
    }
}

UnitBudget fitUnit(const Unit& unit, const UnitDesign& design, double triangles, double texels) {
    UnitCounts counts{unit, design, {}};
    UnitBudget budget;
    budget.detail = chooseDetail(design, triangles);
    for (const Facade& facade : design.facades)
        counts.grids.push_back(featureGrid(facade, detailOf(facade, budget)));

    std::uint64_t coarsest = 0;
    while (budget.things < design.things.size()) {
        coarsest += countThing(design.things[budget.things], kCoarsestThing);
        if (static_cast<double>(coarsest) > 0.8 * kThingShare * triangles) break;
        ++budget.things;
    }
    const auto finest = static_cast<double>(counts.things(budget.things, kFinestThing));
    const double forThings = std::min(kThingShare * triangles, finest);
    budget.spacing =
        smallestWithin(0.005, 50.0, triangles - forThings, [&](double s) { return counts.sheets(s); });
    const auto sheets = static_cast<double>(counts.sheets(budget.spacing));
    const double left = std::min(triangles - sheets, 1.2 * kGreyShare * triangles);
    budget.thingSpacing = smallestWithin(kFinestThing, kCoarsestThing, left,
                                         [&](double s) { return counts.things(budget.things, s); });
    budget.greyTriangles = counts.things(budget.things, budget.thingSpacing);
    budget.triangles = counts.sheets(budget.spacing) + budget.greyTriangles;
    chooseGrey(counts, kGreyShare * triangles, budget, Random::forPart(unit.seed, 3));

    budget.texelsPerMetre =
        -smallestWithin(-4000.0, -0.01, texels, [&](double d) { return counts.texels(budget.grey, -d); });
    budget.texels = counts.texels(budget.grey, budget.texelsPerMetre);
    return budget;
}

double worthSquareMetres(const Unit& unit) {
    double worth = 0.12 * unit.region.width() * unit.region.depth();
    for (const Building& b : unit.buildings) {
        for (int wall = 0; wall < 4; ++wall) {
            const double length =
                wall == kSouth || wall == kNorth ? b.footprint.width() : b.footprint.depth();
            const double share = b.walls[wall] == WallUse::street ? 1.0
                                 : b.walls[wall] == WallUse::back ? 0.35
                                                                  : 0.0;
            worth += share * length * b.top();
        }
    }
    return worth;
}

// Shares that sum to 1, none below half or above twice the mean but for what normalising changes.
std::vector<double> sharesOf(const CityPlan& plan, std::uint64_t part) {
    std::vector<double> shares;
    double mean = 0.0;
    for (const Unit& unit : plan.units) {
        Random random = Random::forPart(unit.seed, part);
        shares.push_back(worthSquareMetres(unit) * (0.6 + 0.4 * spread(random)));
        mean += shares.back() / static_cast<double>(plan.units.size());
    }
    double sum = 0.0;
    for (double& share : shares) {
        share = std::clamp(share / mean, 0.5, 2.0);
        sum += share;
    }
    for (double& share : shares) share /= sum;
    return shares;
}

// Sides in multiples of 8 where that is little: three mip levels without a remainder, as pictures from cameras have.
PictureSize pictureSize(double width, double height, double texelsPerMetre) {
    const auto side = [&](double metres) {
        const double texels = std::clamp(metres * texelsPerMetre, 1.0 * kLeastSide, 1.0 * kLargestSide);
        return static_cast<int>(texels < 64.0 ? texels + 0.5 : 8.0 * std::floor(texels / 8.0 + 0.5));
    };
    return {side(width), side(height)};
}

}  // namespace

UnitDesign designUnit(const CityPlan& plan, const Unit& unit) {
    UnitDesign design;
    for (const Building& building : unit.buildings) {
        std::vector<Facade> facades = designFacades(building);
        std::move(facades.begin(), facades.end(), std::back_inserter(design.facades));
    }
    design.ground = groundFeatures(plan, unit);
    design.things = placeThings(plan, unit);
    return design;
}

double spacingFactor(FacadeRole role) {
    return role == FacadeRole::front ? 1.0 : role == FacadeRole::back ? 1.6 : 2.5;
}

Detail detailOf(const Facade& facade, const UnitBudget& budget) {
    return facade.role == FacadeRole::front ? budget.detail : std::min(budget.detail, Detail::coarse);
}

PictureSize facadePictureSize(const Facade& facade, const FacadeGrid& grid, double texelsPerMetre) {
    const double factor = facade.role == FacadeRole::front  ? 1.0
                          : facade.role == FacadeRole::back ? 0.6
                                                            : 0.45;
    return pictureSize(grid.textureWidth(), grid.textureHeight(), texelsPerMetre * factor);
}

PictureSize aerialPictureSize(const Unit& unit, double texelsPerMetre) {
    return pictureSize(unit.region.width(), unit.region.depth(), texelsPerMetre * 0.5);
}

std::vector<UnitBudget> shareBudget(const CityPlan& plan, const CityOptions& options) {
    const std::vector<double> triangleShares = sharesOf(plan, 4), texelShares = sharesOf(plan, 5);
    std::vector<UnitBudget> budgets;
    double triangleCarry = 0.0, texelCarry = 0.0;
    for (std::size_t i = 0; i < plan.units.size(); ++i) {
        const double triangles = static_cast<double>(options.triangles) * triangleShares[i];
        const double texels = static_cast<double>(options.texels) * texelShares[i];
        const double wantedTriangles =
            triangles + std::clamp(triangleCarry, -0.2 * triangles, 0.2 * triangles);
        const double wantedTexels = texels + std::clamp(texelCarry, -0.2 * texels, 0.2 * texels);
        const UnitDesign design = designUnit(plan, plan.units[i]);
        budgets.push_back(fitUnit(plan.units[i], design, wantedTriangles, wantedTexels));
        triangleCarry += triangles - static_cast<double>(budgets.back().triangles);
        texelCarry += texels - static_cast<double>(budgets.back().texels);
    }
    return budgets;
}

}  // namespace fb::city
