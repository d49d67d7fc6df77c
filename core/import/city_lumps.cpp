#include "import/city_lumps.h"

#include <algorithm>
#include <cmath>

#include "import/city_noise.h"

namespace fb::city {
namespace {

glm::ivec3 divisionsOf(const Lump& lump, double spacing) {
    const int least = lump.shape == LumpShape::box ? 1 : 2;
    const auto along = [&](double size) {
        return std::clamp(static_cast<int>(size / spacing + 0.5), least, 400);
    };
    return {along(lump.size.x), along(lump.size.y), along(lump.size.z)};
}

// Height of a car's outline over its length t in [0, 1]: hood, windscreen, roof, rear.
double carOutline(double t) {
    constexpr std::array<glm::dvec2, 7> kPoints{
        {{0.0, 0.42}, {0.06, 0.56}, {0.28, 0.64}, {0.42, 0.98}, {0.72, 1.0}, {0.9, 0.66}, {1.0, 0.52}}};
    for (std::size_t i = 1; i < kPoints.size(); ++i) {
        if (t > kPoints[i].x) continue;
        const double w = (t - kPoints[i - 1].x) / (kPoints[i].x - kPoints[i - 1].x);
        return kPoints[i - 1].y + (kPoints[i].y - kPoints[i - 1].y) * w;
    }
    return kPoints.back().y;
}

// From the unit cube (x and z in [-0.5, 0.5], y in [0, 1]) to the lump's shape, still of unit size.
glm::dvec3 shapePoint(LumpShape shape, const glm::dvec3& p, bool alongX) {
    if (shape == LumpShape::ball) {
        const glm::dvec3 q(p.x * 2.0, p.y * 2.0 - 1.0, p.z * 2.0);
        const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)});
        const double length = std::sqrt(glm::dot(q, q));
        const glm::dvec3 onBall = length > 0.0 ? q * (largest / length) : q;
        return {onBall.x * 0.5, onBall.y * 0.5 + 0.5, onBall.z * 0.5};
    }
    if (shape == LumpShape::car) {
        const double along = (alongX ? p.x : p.z) + 0.5, across = alongX ? p.z : p.x;
        const double y = p.y * carOutline(along);
        // The cabin is narrower than the body, and both ends are rounded.
        const double nearEnd = std::min(along, 1.0 - along);
        const double narrow =
            (1.0 - 0.24 * std::max(0.0, y - 0.55) / 0.45) * (nearEnd < 0.1 ? 0.86 + 1.4 * nearEnd : 1.0);
        const double side = across * narrow;
        return alongX ? glm::dvec3(p.x, y, side) : glm::dvec3(side, y, p.z);
    }
    return p;
}

}  // namespace

std::uint64_t countThing(const Thing& thing, double spacing) {
    std::uint64_t count = 0;
    for (const Lump& lump : thing) {
        const glm::ivec3 n = divisionsOf(lump, spacing);
        const int flats = lump.underside ? 2 : 1;
        count += 2u * static_cast<std::uint64_t>(flats * n.x * n.z + 2 * n.x * n.y + 2 * n.y * n.z);
    }
    return count;
}

void addThing(const Thing& thing, double spacing, std::uint32_t material, MeshBuilder& mesh) {
    for (const Lump& lump : thing) {
        const glm::ivec3 n = divisionsOf(lump, spacing);
        // Vertices of the cube's surface by their lattice place.
        std::vector<std::uint32_t> vertices(static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1)), ~0u);
        const bool alongX = lump.size.x >= lump.size.z;
        const auto vertexAt = [&](const glm::ivec3& at) {
            const int index = (at.z * (n.y + 1) + at.y) * (n.x + 1) + at.x;
            std::uint32_t& vertex = vertices[static_cast<std::size_t>(index)];
            if (vertex != ~0u) return vertex;
            const glm::dvec3 cube(static_cast<double>(at.x) / n.x - 0.5, static_cast<double>(at.y) / n.y,
                                  static_cast<double>(at.z) / n.z - 0.5);
            const glm::dvec3 p = shapePoint(lump.shape, cube, alongX) * lump.size;
            const double wave = smoothNoise(lump.seed, p.x + 0.61 * p.y, p.z + 0.73 * p.y, 0.5);
            const double grain = signedUnit(latticeHash(lump.seed + 1, index, 0));
            const double out = lump.noiseMetres * (0.7 * wave + 0.5 * grain);
            const glm::dvec3 away(cube.x, cube.y - 0.5, cube.z);
            vertex = mesh.addVertex(lump.base + p + away * (2.0 * out));
            return vertex;
        };
        // One after the other: vertices are numbered in the order of the calls, which compilers may choose
        // for arguments.
        const auto quad = [&](const glm::ivec3& at, const glm::ivec3& u, const glm::ivec3& v) {
            const std::uint32_t a = vertexAt(at), b = vertexAt(at + u);
            const std::uint32_t c = vertexAt(at + u + v), d = vertexAt(at + v);
            mesh.addQuad(a, b, c, d, material);
        };
        const glm::ivec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
        for (int i = 0; i < n.x; ++i) {
            for (int j = 0; j < n.y; ++j) {
                quad({i, j, n.z}, x, y);
                quad({i + 1, j, 0}, -x, y);
            }
            for (int k = 0; k < n.z; ++k) {
                quad({i, n.y, k + 1}, x, -z);
                if (lump.underside) quad({i, 0, k}, x, z);
            }
        }
        for (int k = 0; k < n.z; ++k) {
            for (int j = 0; j < n.y; ++j) {
                quad({n.x, j, k + 1}, -z, y);
                quad({0, j, k}, z, y);
            }
        }
    }
}

}  // namespace fb::city
