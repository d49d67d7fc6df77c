// Roofs: flat ones with a little ponding inside their parapets, hips and mansards over the edge of the walls.
#include <algorithm>
#include <array>
#include <cmath>

#include "import/city_ground.h"
#include "import/city_noise.h"

namespace fb::city {
namespace {

constexpr double kInsideParapet = 0.12;  // a flat roof ends inside the parapet's 0.3 m
constexpr double kIntoNeighbour = 0.05;  // where no wall of its own stands between them
constexpr double kMansardRun = 1.2;      // metres in plan of the steep part

struct RoofGrid {
    std::vector<double> x, z;
};

RoofGrid roofFeatures(const Building& b) {
    Rect rect = b.footprint;
    const auto margin = [&](int wall) {
        if (b.walls[wall] == WallUse::hidden) return -kIntoNeighbour;
        return b.roof == RoofShape::flat ? kInsideParapet : 0.0;
    };
    rect.x0 += margin(kWest);
    rect.x1 -= margin(kEast);
    rect.z0 += margin(kNorth);
    rect.z1 -= margin(kSouth);
    RoofGrid grid{{rect.x0, rect.x1}, {rect.z0, rect.z1}};
    if (b.roof == RoofShape::flat) {
        for (int wall = 0; wall < 4; ++wall) {
            const double cut = b.chamfer[wall];
            if (cut <= 0.0) continue;
            const bool south = wall == kSouth || wall == kWest;
            grid.z.push_back(south ? rect.z1 - cut : rect.z0 + cut);
        }
    } else {
        const double half = std::min(rect.width(), rect.depth()) / 2.0;
        const double inside = b.roof == RoofShape::mansard ? std::min(kMansardRun, half) : half;
        grid.x.insert(grid.x.end(), {rect.x0 + inside, rect.x1 - inside});
        grid.z.insert(grid.z.end(), {rect.z0 + inside, rect.z1 - inside});
    }
    for (std::vector<double>* lines : {&grid.x, &grid.z}) {
        std::sort(lines->begin(), lines->end());
        const auto near = [](double a, double c) { return c - a < 0.02; };
        lines->erase(std::unique(lines->begin(), lines->end(), near), lines->end());
    }
    return grid;
}

// How far the cut-off corners push the roof's west and east edge inward at z.
std::array<double, 2> cutAt(const Building& b, const RoofGrid& grid, double z) {
    const auto inward = [&](int southCorner, int northCorner) {
        const double south = b.chamfer[southCorner] - (grid.z.back() - z);
        const double north = b.chamfer[northCorner] - (z - grid.z.front());
        return std::max({0.0, south, north});
    };
    return {inward(kWest, kNorth), inward(kSouth, kEast)};
}

double heightAt(const Building& b, const RoofGrid& grid, double x, double z) {
    if (b.roof == RoofShape::flat) return b.roofY();
    const double d = std::max(
        0.0, std::min({x - grid.x.front(), grid.x.back() - x, z - grid.z.front(), grid.z.back() - z}));
    const double eaves = b.top() - 0.03;
    if (b.roof == RoofShape::hip) return eaves + d * 0.55;
    return eaves + (d < kMansardRun ? d * (2.6 / kMansardRun) : 2.6 + (d - kMansardRun) * 0.12);
}

}  // namespace

std::uint64_t countRoof(const Building& building, double spacing) {
    const RoofGrid grid = roofFeatures(building);
    return 2 * countEvenly(grid.x, spacing) * countEvenly(grid.z, spacing);
}

void addRoof(const Unit& unit, const Building& building, double spacing, std::uint32_t material,
             MeshBuilder& mesh) {
    const RoofGrid features = roofFeatures(building);
    const RoofGrid grid{fillEvenly(features.x, spacing), fillEvenly(features.z, spacing)};
    const Rect& region = unit.region;
    const auto seed = static_cast<std::uint32_t>(building.seed);
    const double x0 = grid.x.front(), width = grid.x.back() - x0;
    std::vector<std::uint32_t> north(grid.x.size()), row(grid.x.size());
    for (std::size_t j = 0; j < grid.z.size(); ++j) {
        const double z = grid.z[j];
        const auto [west, east] = cutAt(building, features, z);
        for (std::size_t i = 0; i < grid.x.size(); ++i) {
            const double t = (grid.x[i] - x0) / width;
            const double x = grid.x[i] + west * (1.0 - t) - east * t;
            double y = heightAt(building, features, x, z);
            if (i > 0 && j > 0 && i + 1 < grid.x.size() && j + 1 < grid.z.size()) {
                y += 0.03 * smoothNoise(seed, x, z, 2.7) +
                     0.008 * signedUnit(latticeHash(seed + 1, static_cast<int>(i), static_cast<int>(j)));
            }
            const glm::dvec2 uv((x - region.x0) / region.width(), (z - region.z0) / region.depth());
            row[i] = mesh.addVertex({x, y, z}, glm::vec2(glm::clamp(uv, 0.0, 1.0)));
        }
        for (std::size_t i = 0; j > 0 && i + 1 < grid.x.size(); ++i) {
            mesh.addQuad(row[i], row[i + 1], north[i + 1], north[i], material);
        }
        north.swap(row);
    }
}

}  // namespace fb::city
