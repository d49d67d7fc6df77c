// The city as geometry: valid meshes, ground and roofs without holes, a free way for the walk.
#include <algorithm>
#include <cmath>

#include "city/load_city.h"

namespace fb {
namespace {

struct City {
    std::unique_ptr<BlockSource> source;
    std::vector<SourceBlock> blocks;
};

City loadCity(const CityOptions& options) {
    City city;
    city.source = test::cityOf(options);
    city.blocks = test::loadAll(*city.source);
    return city;
}

TEST(CityMesh, EveryBlockIsAValidMesh) {
    for (const CityOptions& options :
         {test::smallCity(1), CityOptions{2, 4000, 65536, 2}, CityOptions{1, 60000, 30000, 3}}) {
        const City city = loadCity(options);
        for (const SourceBlock& block : city.blocks) {
            const SourceMesh& mesh = block.mesh;
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
            ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
            ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
            EXPECT_TRUE(mesh.colours.empty());
            std::vector<bool> used(mesh.positions.size(), false);
            for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
                const glm::uvec3 t = mesh.triangles[k];
                ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
                const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
                ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 1e-7)
                    << "triangle " << k << " of " << block.name;
                ASSERT_LT(mesh.materials[k], block.materials.size());
                const bool textured = block.materials[mesh.materials[k]].texture >= 0;
                for (const std::uint32_t v : {t.x, t.y, t.z}) {
                    used[v] = true;
                    const glm::vec2 uv = mesh.uvs[v];
                    if (textured) {
                        ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)
                            << uv.x << " " << uv.y;
                    }
                }
            }
            EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
            for (const glm::dvec3& p : mesh.positions) {
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
                ASSERT_TRUE(city.source->info().bounds.contains(p)) << p.x << " " << p.y << " " << p.z;
            }
            for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
            for (const SourceMaterial& m : block.materials) {
                ASSERT_LT(m.texture, static_cast<int>(block.textures.size()));
            }
            for (const SourceTexture& t : block.textures) {
                ASSERT_NE(t.image, nullptr);
                EXPECT_EQ(t.image->channels, 3);
                EXPECT_LE(std::max(t.image->width, t.image->height), 4096);
                EXPECT_EQ(t.image->pixels.size(), 3u * static_cast<std::size_t>(t.image->width) *
                                                      static_cast<std::size_t>(t.image->height));
            }
        }
    }
}

// Shares of the squares of a grid that no triangle covers as seen from above.
double uncoveredShare(const City& city, double step) {
    const Box3d& bounds = city.source->info().bounds;
    const auto columns = static_cast<int>(bounds.size().x / step),
               rows = static_cast<int>(bounds.size().z / step);
    std::vector<bool> covered(static_cast<std::size_t>(columns * rows), false);
    // Off the round coordinates of walls and kerbs.
    const auto xOf = [&](int i) { return bounds.min.x + (i + 0.5137) * step; };
    const auto zOf = [&](int j) { return bounds.min.z + (j + 0.4871) * step; };
    for (const SourceBlock& block : city.blocks) {
        for (const glm::uvec3& t : block.mesh.triangles) {
            const glm::dvec3 a = block.mesh.positions[t.x], b = block.mesh.positions[t.y],
                             c = block.mesh.positions[t.z];
            const double area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
            if (area >= 0.0) continue;  // faces down: seen from above it is open
            const auto first = [&](double low, double from) {
                return std::max(0, static_cast<int>((low - from) / step) - 1);
            };
            const double x1 = std::max({a.x, b.x, c.x}), z1 = std::max({a.z, b.z, c.z});
            for (int j = first(std::min({a.z, b.z, c.z}), bounds.min.z); j < rows && zOf(j) <= z1; ++j) {
                for (int i = first(std::min({a.x, b.x, c.x}), bounds.min.x); i < columns && xOf(i) <= x1;
                     ++i) {
                    const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
                        return (q.x - p.x) * (zOf(j) - p.z) - (q.z - p.z) * (xOf(i) - p.x);
                    };
                    if (side(a, b) <= 0.0 && side(b, c) <= 0.0 && side(c, a) <= 0.0) {
                        covered[static_cast<std::size_t>(j * columns + i)] = true;
                    }
                }
            }
        }
    }
    return static_cast<double>(std::count(covered.begin(), covered.end(), false)) /
           static_cast<double>(covered.size());
}

TEST(CityMesh, EveryVerticalRayOverTheCityHitsItFromAbove) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        EXPECT_EQ(uncoveredShare(loadCity({9, 18000, 80000, seed}), 0.37), 0.0) << "seed " << seed;
    }
    EXPECT_EQ(uncoveredShare(loadCity({1, 3000, 9000, 7}), 0.11), 0.0);
    EXPECT_EQ(uncoveredShare(loadCity({7, 60000, 80000, 11}), 0.29), 0.0);
}

TEST(CityMesh, TheGroundOfTheBlocksTilesTheCity) {
    const City city = loadCity(test::smallCity(4));
    const Box3d& bounds = city.source->info().bounds;
    double area = 0.0;
    Box3d all;
    for (const SourceBlock& block : city.blocks) {
        Box3d own;
        for (const glm::dvec3& p : block.mesh.positions) own.grow(p);
        area += own.size().x * own.size().z;
        all.grow(own);
    }
    // Beyond its ground a block has at most the crown of a tree.
    EXPECT_NEAR(area / (bounds.size().x * bounds.size().z), 1.0, 0.03);
    EXPECT_NEAR(all.min.x, bounds.min.x, 1e-9);
    EXPECT_NEAR(all.max.z, bounds.max.z, 1e-9);
    EXPECT_NEAR(glm::length(glm::dvec2(bounds.centre().x, bounds.centre().z)), 0.0, 0.2);
    EXPECT_LT(all.max.y, bounds.max.y);
}

double distanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::length(p - a - ab * t);
}

double distanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const auto inside = [&](const glm::dvec3& u, const glm::dvec3& v) {
        return glm::dot(glm::cross(v - u, p - u), n) >= 0.0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(glm::dot(p - a, n)) / glm::length(n);
    return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

double lengthOf(const WalkHint& walk) {
    double length = 0.0;
    for (std::size_t i = 1; i < walk.points.size(); ++i)
        length += glm::length(walk.points[i] - walk.points[i - 1]);
    return length;
}

void expectClearWalk(const City& city) {
    ASSERT_EQ(city.source->info().walks.size(), 1u);
    const WalkHint& walk = city.source->info().walks.front();
    std::vector<glm::dvec3> probes;
    Box3d around;
    for (std::size_t i = 1; i < walk.points.size(); ++i) {
        EXPECT_EQ(walk.points[i].y, 0.0);
        const glm::dvec3 way = walk.points[i] - walk.points[i - 1];
        ASSERT_LT(glm::length(way), 17.0);
        for (double t = 0.0; t < 1.0; t += 0.7 / glm::length(way)) {
            for (const double height : {0.6, 1.1, 1.7, 2.2}) {
                probes.push_back(walk.points[i - 1] + way * t + glm::dvec3(0.0, height, 0.0));
                around.grow(probes.back());
            }
        }
    }
    double nearest = 1e9, underfoot = 1e9;
    for (const SourceBlock& block : city.blocks) {
        for (const glm::uvec3& t : block.mesh.triangles) {
            const glm::dvec3 a = block.mesh.positions[t.x], b = block.mesh.positions[t.y],
                             c = block.mesh.positions[t.z];
            Box3d box;
            box.grow(a);
            box.grow(b);
            box.grow(c);
            if (box.min.y > 3.0) continue;
            const bool ground = box.max.y < 0.2;
            for (const glm::dvec3& probe : probes) {
                if (box.distance(probe) > 1.0) continue;
                const double distance = distanceToTriangle(probe, a, b, c);
                (ground ? underfoot : nearest) = std::min(ground ? underfoot : nearest, distance);
            }
        }
    }
    EXPECT_GE(nearest, 0.5);
    EXPECT_NEAR(underfoot, 0.6, 0.05);  // the walk is on the carriageway, not on a pavement or above a hole
}

TEST(CityWalk, KeepsHalfAMetreFromEverythingButTheGround) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) expectClearWalk(loadCity({9, 27000, 80000, seed}));
    expectClearWalk(loadCity({2, 4000, 65536, 1}));
    expectClearWalk(loadCity({1, 4000, 65536, 1}));
}

TEST(CityWalk, GoesAroundThreeCornersOfTheDefaultCity) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CityOptions options;
        options.seed = seed;
        const auto city = test::cityOf(options);
        const WalkHint& walk = city->info().walks.front();
        EXPECT_GE(lengthOf(walk), 100.0);
        EXPECT_LE(lengthOf(walk), 400.0);
        // Along x or z on the straights: count how often that changes.
        int corners = 0, last = -1;
        for (std::size_t i = 1; i < walk.points.size(); ++i) {
            const glm::dvec3 way = walk.points[i] - walk.points[i - 1];
            const int axis = std::abs(way.z) < 1e-9 ? 0 : std::abs(way.x) < 1e-9 ? 1 : -1;
            if (axis < 0) continue;
            corners += last >= 0 && axis != last ? 1 : 0;
            last = axis;
        }
        EXPECT_EQ(corners, 3);
    }
}

}  // namespace
}  // namespace fb
