// Roofs from above: gravel, felt in strips, membrane, tiles or slate on slopes.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

// Brightness of a slope towards each wall, by the sun of the facades.
constexpr std::array<float, 4> kSlopeLight{1.12f, 0.86f, 0.72f, 1.0f};

void paintSlopes(const Building& b, const BuildingStyle& style, const Run& run, const PaintRow& row) {
    const Rect& f = b.footprint;
    const double half = std::min(f.width(), f.depth()) / 2.0;
    const double toSouth = f.z1 - row.at, toNorth = row.at - f.z0;
    const double dz = std::min(toSouth, toNorth);
    const bool mansard = b.roof == RoofShape::mansard;
    const double steep = mansard ? std::min(1.2, half) : half;
    const double course = mansard ? 0.12 : 0.3;  // as seen from above
    for (int i = run.begin; i < run.end; ++i) {
        const double toEast = f.x1 - row.places[i], toWest = row.places[i] - f.x0;
        const double dx = std::min(toEast, toWest);
        const double d = std::min(dx, dz);
        if (d > steep) {
            row.put(i, Colour{118, 116, 112}, row.shade[i]);
            continue;
        }
        const int wall = dz < dx ? (toSouth < toNorth ? kSouth : kNorth) : (toEast < toWest ? kEast : kWest);
        float tone = kSlopeLight[wall];
        if (row.texel < course * 0.8 && phase(d, course) < 0.3) tone *= 0.78f;
        if (std::abs(dx - dz) < 0.12 || steep - d < 0.12) tone *= 1.15f;  // ridge tiles
        const auto along = static_cast<std::int32_t>((dz < dx ? row.places[i] : row.at) / 0.25);
        const auto rank = static_cast<std::int32_t>(d / course);
        const float each =
            1.0f + 0.09f * signedUnit(latticeHash(static_cast<std::uint32_t>(b.seed), along, rank));
        row.put(i, style.roofColour, tone * each * row.shade[i]);
    }
}

}  // namespace

Run footprintRun(const Building& building, const PaintRow& row) {
    const Rect& f = building.footprint;
    if (row.at < f.z0 || row.at > f.z1) return {};
    // The south west corner belongs to the west wall, the north west one to the north wall, and so on.
    const auto inward = [&](int southCorner, int northCorner) {
        return std::max({0.0, building.chamfer[southCorner] - (f.z1 - row.at),
                         building.chamfer[northCorner] - (row.at - f.z0)});
    };
    return row.between(f.x0 + inward(kWest, kNorth), f.x1 - inward(kSouth, kEast));
}

void paintRoofRow(const Building& b, const BuildingStyle& style, const Run& run, const PaintRow& row) {
    if (b.roof != RoofShape::flat) {
        paintSlopes(b, style, run, row);
        return;
    }
    const Rect& f = b.footprint;
    const auto seed = static_cast<std::uint32_t>(b.seed);
    const double edgeZ = std::min(f.z1 - row.at, row.at - f.z0);
    const double strip = style.roof == RoofCover::felt ? 1.0 : 2.0;
    const bool seams = style.roof != RoofCover::gravel && row.texel < 0.12;
    const bool alongX = f.width() > f.depth();
    const bool seamRow = seams && alongX && phase(row.at - f.z0, strip) < 0.05;
    const auto line = static_cast<std::int32_t>(row.at / row.texel);
    for (int i = run.begin; i < run.end; ++i) {
        const double edge = std::min({edgeZ, f.x1 - row.places[i], row.places[i] - f.x0});
        float tone = row.shade[i];
        if (style.roof == RoofCover::gravel) {
            tone *= 1.0f + 0.14f * signedUnit(latticeHash(seed, i, line));
        } else if (seamRow || (seams && !alongX && phase(row.places[i] - f.x0, strip) < 0.05)) {
            tone *= 0.8f;
        }
        // Water stands and leaves dirt in the middle; leaves gather along the parapet.
        if (row.shade[i] > 1.05f) tone *= 0.9f;
        if (edge < 0.8) tone *= static_cast<float>(0.74 + 0.26 * edge / 0.8);
        row.put(i, style.roofColour, tone);
    }
}

}  // namespace fb::city
