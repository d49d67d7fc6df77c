#include "import/city_ground.h"

#include <algorithm>
#include <cmath>

#include "import/city_noise.h"

namespace fb::city {
namespace {

constexpr double kHalfKerb = 0.04;     // the kerb's step is this wide to both sides of its line
constexpr double kUnderWall = 0.5;     // ground reaches this far under a building
constexpr double kUnderChamfer = 3.4;  // and this far where its corner is cut off
constexpr double kSetback = 0.4;       // the deepest

double parts(double from, double to, double spacing) {
    return std::max(1.0, std::ceil((to - from) / spacing));
}

void sortLines(std::vector<double>& lines, double low, double high) {
    std::erase_if(lines, [&](double at) { return at < low + 0.02 || at > high - 0.02; });
    lines.push_back(low);
    lines.push_back(high);
    std::sort(lines.begin(), lines.end());
    // Lines closer than 2 cm, which only rounding makes, are one.
    const auto near = [](double a, double b) { return b - a < 0.02; };
    const bool endNear = lines.size() > 1 && near(lines[lines.size() - 2], lines.back());
    if (endNear) lines.erase(lines.end() - 2);
    lines.erase(std::unique(lines.begin(), lines.end(), near), lines.end());
}

// The part of a building's footprint that needs no ground. The street sides of all buildings in a row share a
// line.
Rect coveredBy(const Building& b) {
    Rect rect = b.footprint;
    const auto inset = [&](int wall) {
        if (b.walls[wall] == WallUse::hidden || b.walls[wall] == WallUse::party) return 0.0;
        const bool cut = b.chamfer[wall] > 0.0 || b.chamfer[(wall + 3) % 4] > 0.0;
        return cut ? kUnderChamfer : kUnderWall;
    };
    rect.x0 += inset(kWest);
    rect.x1 -= inset(kEast);
    rect.z0 += inset(kNorth);
    rect.z1 -= inset(kSouth);
    return rect;
}

bool isCovered(const GroundSheet& sheet, double x, double z) {
    return std::any_of(sheet.covered.begin(), sheet.covered.end(),
                       [&](const Rect& r) { return r.contains(x, z); });
}

}  // namespace

std::vector<double> fillEvenly(std::span<const double> lines, double spacing) {
    std::vector<double> filled{lines.front()};
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const double count = parts(lines[i - 1], lines[i], spacing);
        for (double k = 1.0; k < count; k += 1.0) {
            filled.push_back(lines[i - 1] + (lines[i] - lines[i - 1]) * (k / count));
        }
        filled.push_back(lines[i]);
    }
    return filled;
}

std::uint64_t countEvenly(std::span<const double> lines, double spacing) {
    double count = 0.0;
    for (std::size_t i = 1; i < lines.size(); ++i) count += parts(lines[i - 1], lines[i], spacing);
    return static_cast<std::uint64_t>(count);
}

GroundSheet groundFeatures(const CityPlan& plan, const Unit& unit) {
    GroundSheet sheet;
    const auto addKerbs = [](std::vector<double>& lines, const std::vector<Street>& streets) {
        for (const Street& street : streets) {
            for (const double kerb :
                 {street.centre - street.halfCarriage, street.centre + street.halfCarriage}) {
                lines.push_back(kerb - kHalfKerb);
                lines.push_back(kerb + kHalfKerb);
            }
        }
    };
    addKerbs(sheet.x, plan.alongZ);
    addKerbs(sheet.z, plan.alongX);
    for (const Building& building : unit.buildings) {
        Rect rect = coveredBy(building);
        // One line for every setback.
        constexpr double kStreetInset = kSetback + kUnderWall;
        if (building.walls[kNorth] == WallUse::street)
            rect.z0 = std::max(rect.z0, unit.built.z0 + kStreetInset);
        if (building.walls[kSouth] == WallUse::street)
            rect.z1 = std::min(rect.z1, unit.built.z1 - kStreetInset);
        if (rect.x1 - rect.x0 < 0.5 || rect.z1 - rect.z0 < 0.5) continue;
        sheet.covered.push_back(rect);
        sheet.x.insert(sheet.x.end(), {rect.x0, rect.x1});
        sheet.z.insert(sheet.z.end(), {rect.z0, rect.z1});
    }
    sortLines(sheet.x, unit.region.x0, unit.region.x1);
    sortLines(sheet.z, unit.region.z0, unit.region.z1);
    return sheet;
}

std::uint64_t countGround(const GroundSheet& features, double spacing) {
    double cells = 0.0;
    for (std::size_t j = 1; j < features.z.size(); ++j) {
        const double z = (features.z[j - 1] + features.z[j]) / 2.0;
        double across = 0.0;
        for (std::size_t i = 1; i < features.x.size(); ++i) {
            if (isCovered(features, (features.x[i - 1] + features.x[i]) / 2.0, z)) continue;
            across += parts(features.x[i - 1], features.x[i], spacing);
        }
        cells += across * parts(features.z[j - 1], features.z[j], spacing);
    }
    return 2 * static_cast<std::uint64_t>(cells);
}

void addGround(const CityPlan& plan, const Unit& unit, const GroundSheet& features, double spacing,
               std::uint32_t material, MeshBuilder& mesh) {
    GroundSheet sheet{fillEvenly(features.x, spacing), fillEvenly(features.z, spacing), features.covered};
    const Rect& region = unit.region;
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::vector<std::uint32_t> vertices(sheet.x.size() * sheet.z.size(), kNone);
    const auto seed = static_cast<std::uint32_t>(plan.seed) + 31u;
    const auto vertexAt = [&](std::size_t i, std::size_t j) {
        std::uint32_t& vertex = vertices[j * sheet.x.size() + i];
        if (vertex != kNone) return vertex;
        const double x = sheet.x[i], z = sheet.z[j];
        double y = plan.isCarriageway(x, z) ? 0.0 : kPavementHeight;
        // Flat along the unit's border, where the neighbour has other samples.
        if (i > 0 && j > 0 && i + 1 < sheet.x.size() && j + 1 < sheet.z.size()) {
            y += 0.012 * smoothNoise(seed, x, z, 3.1) +
                 0.004 * signedUnit(latticeHash(seed + 1, static_cast<int>(i), static_cast<int>(j)));
        }
        const glm::vec2 uv((x - region.x0) / region.width(), (z - region.z0) / region.depth());
        vertex = mesh.addVertex({x, y, z}, uv);
        return vertex;
    };
    for (std::size_t j = 0; j + 1 < sheet.z.size(); ++j) {
        for (std::size_t i = 0; i + 1 < sheet.x.size(); ++i) {
            const double x = (sheet.x[i] + sheet.x[i + 1]) / 2.0, z = (sheet.z[j] + sheet.z[j + 1]) / 2.0;
            if (isCovered(sheet, x, z)) continue;
            const std::uint32_t a = vertexAt(i, j + 1), b = vertexAt(i + 1, j + 1);
            const std::uint32_t c = vertexAt(i + 1, j), d = vertexAt(i, j);
            mesh.addQuad(a, b, c, d, material);
        }
    }
}

}  // namespace fb::city
