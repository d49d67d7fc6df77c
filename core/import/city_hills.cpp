#include "import/city_hills.h"

#include <algorithm>
#include <cmath>

#include "import/city_mesh.h"
#include "import/city_noise.h"
#include "import/city_plan.h"

namespace fb::city {
namespace {

constexpr double kFoundationDepth = 0.6;  // below the lowest ground around a building
constexpr double kFoundationInset = 0.03;
constexpr double kStripDepth = 0.8, kStripStep = 2.0;

// Metres outside of the city's ground, 0 inside; a street's width of it is still level with the city.
double outsideMetres(const Hills& r, double x, double z) {
    const double dx = std::max({0.0, r.x0 - x, x - r.x1}), dz = std::max({0.0, r.z0 - z, z - r.z1});
    return std::max(0.0, std::sqrt(dx * dx + dz * dz) - 8.0);
}

// A wall from a to b in plan, its outside to the right of the way.
void addWall(const glm::dvec2& a, const glm::dvec2& b, double topA, double topB, double bottom,
             std::uint32_t material, MeshBuilder& mesh) {
    const std::uint32_t la = mesh.addVertex({a.x, bottom, a.y}), lb = mesh.addVertex({b.x, bottom, b.y});
    const std::uint32_t ua = mesh.addVertex({a.x, topA, a.y}), ub = mesh.addVertex({b.x, topB, b.y});
    mesh.addQuad(la, lb, ub, ua, material);
}

}  // namespace

double Hills::heightAt(double x, double z) const {
    if (!exist) return 0.0;
    const double gentle =
        9.0 * smoothNoise(seed + 101, x, z, 380.0) + 1.5 * smoothNoise(seed + 102, x, z, 140.0);
    const double outside = outsideMetres(*this, x, z);
    if (outside == 0.0) return gentle;
    const double reach = std::max(x1 - x0, z1 - z0);
    const double t = std::min(1.0, outside / (0.8 * reach)), rise = t * t * (3.0 - 2.0 * t);
    const double ridge = 1.0 - std::abs(smoothNoise(seed + 104, x, z, 420.0));
    const double wild = 30.0 * smoothNoise(seed + 103, x, z, 650.0) + 46.0 * ridge * ridge +
                        7.0 * smoothNoise(seed + 105, x, z, 110.0) +
                        1.6 * smoothNoise(seed + 106, x, z, 31.0);
    return gentle + rise * wild;
}

Hills::Range Hills::within(double left, double top, double right, double bottom) const {
    Range range;
    if (!exist) return range;
    range = {1e300, -1e300};
    const double wide = std::max(1.0, std::ceil((right - left) / 2.0)),
                 deep = std::max(1.0, std::ceil((bottom - top) / 2.0));
    for (double j = 0.0; j <= deep; j += 1.0) {
        for (double i = 0.0; i <= wide; i += 1.0) {
            const double height =
                heightAt(left + (right - left) * (i / wide), top + (bottom - top) * (j / deep));
            range.low = std::min(range.low, height);
            range.high = std::max(range.high, height);
        }
    }
    return range;
}

void addFoundations(const CityPlan& plan, const Unit& unit, std::uint32_t material, MeshBuilder& mesh) {
    for (const Building& b : unit.buildings) {
        Rect f = b.footprint;
        const Hills::Range ground = plan.hills.within(f.x0, f.z0, f.x1, f.z1);
        const double bottom = ground.low - kFoundationDepth;
        f = {f.x0 + kFoundationInset, f.z0 + kFoundationInset, f.x1 - kFoundationInset,
             f.z1 - kFoundationInset};
        const glm::dvec2 corners[4] = {
            {f.x1, f.z1}, {f.x1, f.z0}, {f.x0, f.z0}, {f.x0, f.z1}};  // at the walls' ends
        constexpr glm::dvec2 kWays[4] = {{1, 0}, {0, -1}, {-1, 0}, {0, 1}};
        for (int wall = 0; wall < 4; ++wall) {
            const int before = (wall + 3) % 4;
            const glm::dvec2 start = corners[before] + kWays[wall] * b.chamfer[before];
            const glm::dvec2 end = corners[wall] - kWays[wall] * b.chamfer[wall];
            addWall(start, end, b.baseY, b.baseY, bottom, material, mesh);
            if (b.chamfer[wall] > 0.0) {
                const int next = (wall + 1) % 4;
                addWall(end, corners[wall] + kWays[next] * b.chamfer[wall], b.baseY, b.baseY, bottom,
                        material, mesh);
            }
        }
    }
    const Rect& r = unit.region;
    const glm::dvec2 corners[5] = {{r.x0, r.z1}, {r.x1, r.z1}, {r.x1, r.z0}, {r.x0, r.z0}, {r.x0, r.z1}};
    for (int side = 0; side < 4; ++side) {
        const glm::dvec2 way = corners[side + 1] - corners[side];
        const double count = std::max(1.0, std::ceil((std::abs(way.x) + std::abs(way.y)) / kStripStep));
        for (double i = 0.0; i < count; i += 1.0) {
            const glm::dvec2 a = corners[side] + way * (i / count),
                             b = corners[side] + way * ((i + 1.0) / count);
            // A little below the street, which has its kerbs and noise there.
            const double ya = plan.hills.heightAt(a.x, a.y) - 0.02, yb = plan.hills.heightAt(b.x, b.y) - 0.02;
            addWall(a, b, ya, yb, std::min(ya, yb) - kStripDepth, material, mesh);
        }
    }
}

}  // namespace fb::city
