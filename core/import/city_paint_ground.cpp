// The ground from above: asphalt with patches, cracks, markings and manholes; pavements with kerbs; yards.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

constexpr Colour kAsphalt{96, 96, 98}, kNewAsphalt{70, 70, 73}, kSlab{158, 153, 144}, kKerb{178, 175, 168};
constexpr Colour kPaint{214, 212, 204}, kYellow{200, 164, 62};

const Street* streetAt(const std::vector<Street>& streets, double at) {
    for (const Street& street : streets) {
        if (std::abs(at - street.centre) < street.halfCarriage) return &street;
    }
    return nullptr;
}

double toNearestKerb(const std::vector<Street>& streets, double at) {
    double nearest = 1e9;
    for (const Street& street : streets) {
        nearest = std::min(nearest, std::abs(std::abs(at - street.centre) - street.halfCarriage));
    }
    return nearest;
}

void paintAsphalt(const PaintRow& row, const Run& run, std::span<const float> cracks, std::uint32_t seed) {
    // Repairs: at most one a lattice cell of 9 m.
    constexpr double kCell = 9.0;
    row.fill(run, kAsphalt);
    if (run.empty()) return;
    const auto cellZ = static_cast<std::int32_t>(std::floor(row.at / kCell));
    const auto firstX = static_cast<std::int32_t>(std::floor(row.places[run.begin] / kCell));
    const auto lastX = static_cast<std::int32_t>(std::floor(row.places[run.end - 1] / kCell));
    for (std::int32_t cellX = firstX; cellX <= lastX; ++cellX) {
        const std::uint32_t hash = latticeHash(seed, cellX, cellZ);
        if (unit(hash) > 0.3f) continue;
        const double x = (cellX + 0.5 * unit(mixBits(hash + 1))) * kCell,
                     z = (cellZ + 0.5 * unit(mixBits(hash + 2))) * kCell;
        const double width = 0.8 + 3.4 * unit(mixBits(hash + 3)), depth = 0.7 + 2.2 * unit(mixBits(hash + 4));
        if (row.at > z && row.at < z + depth) row.fill(row.between(x, x + width).within(run), kNewAsphalt);
    }
    // Cracks follow the zero line of smooth noise where the surface is bad; gravel shows as speckles.
    const float half = 0.010f, reach = half + static_cast<float>(row.texel) * 0.3f;
    const float strength = std::min(1.0f, half / reach * 2.0f);
    std::uint32_t grain = latticeHash(seed, cellZ, static_cast<std::int32_t>(row.at / row.texel)) | 1u;
    for (int i = run.begin; i < run.end; ++i) {
        grain = grain * 0x915f77f5u + 0x6d2b79f5u;
        float tone = 1.0f + 0.05f * signedUnit(grain);
        if (std::abs(cracks[i] + 0.2f * row.wave[i]) < reach) {
            const float bad = std::clamp((row.shade[i] - 0.97f) * 9.0f, 0.0f, 1.0f);
            tone *= 1.0f - 0.4f * strength * bad;
        }
        row.multiply(i, tone);
    }
}

// Markings of the streets along z on a row outside of crossings.
void markAlongZ(const CityPlan& plan, const PaintRow& row) {
    const double z = row.at;
    for (const Street& s : plan.alongZ) {
        // The crossing street whose pavement line the row is on, if any: pedestrians cross there.
        bool zebra = false, nearCrossing = false;
        for (const Street& other : plan.alongX) {
            const double away = std::abs(z - other.centre) - other.halfCarriage;
            zebra = zebra || (away > 0.4 && away < other.pavement - 0.2);
            nearCrossing = nearCrossing || away < other.pavement + 0.8;
            if (away > other.pavement + 0.1 && away < other.pavement + 0.55) {
                const bool south = z > other.centre;  // right-hand traffic stops on its own side
                const Run half = south ? row.between(s.centre, s.centre + s.halfCarriage)
                                       : row.between(s.centre - s.halfCarriage, s.centre);
                row.blend(half, kPaint, 0.7f);
            }
        }
        if (zebra) {
            for (double x = -s.halfCarriage + 0.3; x < s.halfCarriage - 0.5; x += 1.0) {
                row.blend(row.between(s.centre + x, s.centre + x + 0.5), kPaint, 0.68f);
            }
        } else if (!nearCrossing && phase(z, 4.5) < 0.5) {
            row.blend(row.between(s.centre - 0.07, s.centre + 0.07), kYellow, 0.75f);
        }
        if (!nearCrossing && phase(z, 6.3) < 0.025) {  // bays for parking
            row.blend(row.between(s.centre - s.halfCarriage, s.centre - s.halfCarriage + 2.1), kPaint, 0.5f);
            row.blend(row.between(s.centre + s.halfCarriage - 2.1, s.centre + s.halfCarriage), kPaint, 0.5f);
        }
    }
}

// Markings of the street along x that the row is on.
void markAlongX(const CityPlan& plan, const Street& street, const PaintRow& row) {
    const double across = row.at - street.centre;
    const bool stripe = std::abs(across) < street.halfCarriage - 0.3 && phase(across, 1.0) < 0.5;
    std::vector<double> walls{plan.ground.x0};  // ends of the stretches between crossings
    for (const Street& other : plan.alongZ) {
        for (const double side : {-1.0, 1.0}) {
            const double near = other.centre + side * (other.halfCarriage + 0.4);
            const double far = other.centre + side * (other.halfCarriage + other.pavement - 0.2);
            if (stripe) row.blend(row.between(std::min(near, far), std::max(near, far)), kPaint, 0.68f);
            const bool ownSide = side > 0.0 ? across < 0.0 : across > 0.0;
            const double stop = other.centre + side * (other.halfWidth() + 0.3);
            if (ownSide) row.blend(row.between(stop - 0.22, stop + 0.22), kPaint, 0.7f);
            walls.push_back(other.centre + side * (other.halfWidth() + 0.8));
        }
    }
    walls.push_back(plan.ground.x1);
    for (std::size_t i = 0; i + 1 < walls.size(); i += 2) {
        if (std::abs(across) < 0.07) {
            for (double x = walls[i]; x + 2.25 < walls[i + 1]; x += 4.5) {
                row.blend(row.between(x, x + 2.25), kYellow, 0.75f);
            }
        }
        if (std::abs(across) < street.halfCarriage - 2.1) continue;
        for (double x = walls[i] + 1.0; x < walls[i + 1] - 1.0; x += 6.3) {
            row.blend(row.between(x - 0.07, x + 0.07), kPaint, 0.5f);
        }
    }
}

void paintManholes(const CityPlan& plan, const PaintRow& row, std::uint32_t seed) {
    constexpr double kEvery = 17.0, kRadius = 0.36;
    const auto cellZ = static_cast<std::int32_t>(std::floor(row.at / kEvery));
    const auto firstX = static_cast<std::int32_t>(std::floor(row.places.front() / kEvery));
    const auto lastX = static_cast<std::int32_t>(std::floor(row.places.back() / kEvery));
    for (std::int32_t cellX = firstX; cellX <= lastX; ++cellX) {
        const std::uint32_t hash = latticeHash(seed, cellX, cellZ);
        const double x = (cellX + 0.1 + 0.8 * unit(hash)) * kEvery,
                     z = (cellZ + 0.1 + 0.8 * unit(mixBits(hash))) * kEvery;
        const double dz = row.at - z;
        if (std::abs(dz) >= kRadius || !plan.isCarriageway(x, z)) continue;
        const double half = std::sqrt(kRadius * kRadius - dz * dz);
        row.fill(row.between(x - half, x + half), {62, 60, 58});
        const double core = 0.26 * 0.26 - dz * dz;
        if (core > 0.0) row.fill(row.between(x - std::sqrt(core), x + std::sqrt(core)), {84, 80, 76});
    }
}

void paintCarParks(const Unit& unit, const PaintRow& row, std::span<const float> cracks) {
    for (const Rect& park : unit.carParks) {
        if (row.at < park.z0 || row.at > park.z1) continue;
        paintAsphalt(row, row.between(park.x0, park.x1), cracks, static_cast<std::uint32_t>(unit.seed) + 1);
        for (double z = park.z0 + 3.5; z < park.z1 - 3.0; z += 7.5) {
            if (std::abs(row.at - z) > 2.5) continue;
            for (double x = park.x0 + 0.65; x < park.x1; x += 2.7)
                row.blend(row.between(x - 0.06, x + 0.06), kPaint, 0.6f);
        }
    }
}

// What lies behind the buildings. Between the building line and a wall set back from it the pavement goes on.
void paintYards(const Unit& unit, const PaintRow& row, std::span<const float> cracks) {
    constexpr double kFromStreet = 3.5;
    Rect yard = unit.built;
    if (yard.z0 > unit.region.z0 + 0.1) yard.z0 += kFromStreet;
    if (yard.z1 < unit.region.z1 - 0.1) yard.z1 -= kFromStreet;
    if (!unit.alley && yard.x0 > unit.region.x0 + 0.1) yard.x0 += kFromStreet;
    if (!unit.alley && yard.x1 < unit.region.x1 - 0.1) yard.x1 -= kFromStreet;
    if (row.at < yard.z0 || row.at > yard.z1) return;
    const Run run = row.between(yard.x0, yard.x1);
    if (unit.alley) {
        paintAsphalt(row, run, cracks, static_cast<std::uint32_t>(unit.seed));
    } else {
        // Grass, with trodden earth where the noise is low.
        for (int i = run.begin; i < run.end; ++i) {
            const float earth = std::clamp(cracks[i] * 2.5f + 0.5f, 0.0f, 1.0f);
            row.put(i, Colour{92, 104, 66}.mixed({134, 118, 94}, earth),
                    row.shade[i] * (1.0f + 0.1f * row.wave[i]));
        }
    }
}

}  // namespace

void paintGroundRow(const CityPlan& plan, const Unit& unit, const Masonry& slabs,
                    std::span<const float> cracks, const PaintRow& row) {
    const auto seed = static_cast<std::uint32_t>(plan.seed);
    const Run all{0, static_cast<int>(row.places.size())};
    if (const Street* street = streetAt(plan.alongX, row.at)) {
        paintAsphalt(row, all, cracks, seed + 40);
        // The gutter is dark with dirt.
        if (toNearestKerb(plan.alongX, row.at) < 0.3) row.darken(all, 0.84f);
        markAlongX(plan, *street, row);
    } else {
        slabs.paint(row, all, kSlab, kSlab.scaled(0.66f));
        if (toNearestKerb(plan.alongX, row.at) < 0.18) row.fill(all, kKerb);
        for (const Street& s : plan.alongZ) {
            const double kerb = s.halfCarriage;
            row.fill(row.between(s.centre - kerb - 0.18, s.centre + kerb + 0.18), kKerb);
            const Run carriage = row.between(s.centre - kerb, s.centre + kerb);
            paintAsphalt(row, carriage, cracks, seed + 40);
            row.darken(row.between(s.centre - kerb, s.centre - kerb + 0.3), 0.84f);
            row.darken(row.between(s.centre + kerb - 0.3, s.centre + kerb), 0.84f);
        }
        markAlongZ(plan, row);
        paintYards(unit, row, cracks);
        paintCarParks(unit, row, cracks);
    }
    paintManholes(plan, row, seed + 41);
}

}  // namespace fb::city
