// Tiles of a terrain one by one: errors are bounds, borders keep what matters, skirts reach every neighbour,
// cliffs do not fold.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <optional>

#include "base/triangle_tree.h"
#include "build/simplify_height_field.h"
#include "build/terrain_error.h"
#include "build/terrain_skirts.h"
#include "build/terrain_tree.h"
#include "terrain_world.h"

namespace fb {
namespace {

using test::HandMadeTerrain;

struct TerrainWorld {
    ScratchFolder folder;
    TerrainGrid grid;
    TerrainLayout layout;
    std::optional<TerrainHeights> heights;

    explicit TerrainWorld(HandMadeTerrain terrain, std::uint64_t desired = 16) {
        EXPECT_TRUE(terrain.survey());
        grid = makeTerrainGrid(terrain.info()).value();
        layout = layOutTerrain(terrain.info().columns, terrain.info().rows, desired);
        heights.emplace(
            TerrainHeights::make(terrain, grid, layout.sideExponent(0) + 1, folder.path()).value());
    }
    [[nodiscard]] TerrainBuild build() const { return {*heights, grid, layout, 16}; }
};

TEST(KeepOnBorder, KeepsEndsChangesAndTheFarthestSamples) {
    std::vector<BorderPoint> line;
    const int heights[] = {0, 0, 0, 90, 0, 0, 0, 40, 0};
    for (int i = 0; i < 9; ++i)
        line.push_back({i * 10, heights[i], static_cast<std::uint8_t>(i < 8 ? 3 : 0)});
    using Kept = std::vector<std::uint8_t>;
    EXPECT_EQ(keepOnBorder(line, 1), (Kept{1, 0, 0, 0, 0, 0, 0, 0, 1}));
    EXPECT_EQ(keepOnBorder(line, 2), (Kept{1, 0, 0, 1, 0, 0, 0, 0, 1}));
    EXPECT_EQ(keepOnBorder(line, 100), (Kept{1, 0, 1, 1, 1, 0, 1, 1, 1}));
    line[4].sides = line[5].sides = kSideBefore;  // a hole below two of the stretches
    EXPECT_EQ(keepOnBorder(line, 1), (Kept{1, 0, 0, 0, 1, 0, 1, 0, 1}));
}

TEST(SimplifyHeightField, NeverTurnsACliffOverAndKeepsWhatIsLocked) {
    Random random(4);
    std::vector<HeightFieldPoint> points;
    std::vector<glm::uvec3> triangles;
    constexpr int kSide = 24;
    for (int r = 0; r <= kSide; ++r) {
        for (int c = 0; c <= kSide; ++c) {
            const bool border = r == 0 || c == 0 || r == kSide || c == kSide;
            points.push_back({c * 8, r * 8, static_cast<std::int32_t>(random.index(4000)), border});
        }
    }
    for (std::uint32_t r = 0; r < kSide; ++r) {
        for (std::uint32_t c = 0; c < kSide; ++c) {
            const std::uint32_t a = r * (kSide + 1) + c, d = a + kSide + 2;
            triangles.emplace_back(a, a + kSide + 1, d);
            triangles.emplace_back(a, d, a + 1);
        }
    }
    const std::vector<glm::uvec3> simplified = simplifyHeightField(points, triangles, 200);
    EXPECT_LE(simplified.size(), 200u);
    EXPECT_GE(simplified.size(), 190u);
    std::int64_t area = 0;
    std::vector<int> used(points.size(), 0);
    for (const glm::uvec3& t : simplified) {
        const std::int64_t part = planArea(points[t.x], points[t.y], points[t.z]);
        EXPECT_LT(part, 0);
        area += part;
        for (int k = 0; k < 3; ++k) used[t[k]] = 1;
    }
    EXPECT_EQ(area, -2 * kSide * 8 * kSide * 8);  // nothing lost, nothing twice
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_TRUE(!points[i].locked || used[i] == 1) << i;
}

TEST(SimplifyHeightField, AFlatSheetNeedsTwoTriangles) {
    std::vector<HeightFieldPoint> points;
    std::vector<glm::uvec3> triangles;
    for (int r = 0; r < 5; ++r) {
        for (int c = 0; c < 5; ++c) points.push_back({c, r, 7, (r % 4 == 0) && (c % 4 == 0)});
    }
    for (std::uint32_t r = 0; r < 4; ++r) {
        for (std::uint32_t c = 0; c < 4; ++c) {
            const std::uint32_t a = r * 5 + c;
            triangles.emplace_back(a, a + 5, a + 6);
            triangles.emplace_back(a, a + 6, a + 1);
        }
    }
    EXPECT_EQ(simplifyHeightField(points, triangles, 2).size(), 2u);
}

// Height of the map's surface at a place between samples; nothing over a hole.
std::optional<double> surfaceAt(const HeightWindow& map, const TerrainGrid& grid, double a, double d) {
    const auto cellOf = [](const std::vector<std::int32_t>& places, double at) {
        const auto above = std::upper_bound(places.begin(), places.end(), at);
        return std::clamp<std::int64_t>(above - places.begin() - 1, 0,
                                        static_cast<std::int64_t>(places.size()) - 2);
    };
    const std::int64_t c = cellOf(grid.across, a), r = cellOf(grid.down, d);
    if (!map.at(c, r).cell()) return std::nullopt;
    const double u = (a - grid.across[c]) / (grid.across[c + 1] - grid.across[c]);
    const double v = (d - grid.down[r]) / (grid.down[r + 1] - grid.down[r]);
    const double h = map.at(c, r).height(), end = map.at(c + 1, r + 1).height();
    if (v >= u) return h + (map.at(c, r + 1).height() - h) * v + (end - map.at(c, r + 1).height()) * u;
    return h + (map.at(c + 1, r).height() - h) * u + (end - map.at(c + 1, r).height()) * v;
}

std::optional<double> drawnAt(const TileMesh& tile, double a, double d) {
    for (const glm::uvec3& t : tile.triangles) {
        const TileVertex &p = tile.vertices[t.x], &q = tile.vertices[t.y], &r = tile.vertices[t.z];
        const glm::dvec2 at(a - p.across, d - p.down), qp(q.across - p.across, q.down - p.down),
            rp(r.across - p.across, r.down - p.down);
        const double area = qp.x * rp.y - qp.y * rp.x;
        const double s = (at.x * rp.y - at.y * rp.x) / area, w = (qp.x * at.y - qp.y * at.x) / area;
        if (s >= -1e-9 && w >= -1e-9 && s + w <= 1.0 + 1e-9)
            return p.height + s * (q.height - p.height) + w * (r.height - p.height);
    }
    return std::nullopt;
}

void checkErrors(const TerrainWorld& world, Random& random) {
    HeightWindow map{0, 0, world.grid.columns, world.grid.rows, {}};
    ASSERT_TRUE(world.heights->read(0, map));
    const TerrainTree tree = makeTerrainTree(*world.heights, world.layout).value();
    for (const TerrainTree::Node& node : tree.nodes) {
        if (node.tile.level == world.layout.depth) continue;
        const TileMesh tile = makeTile(world.build(), node.tile).value();
        const double error = terrainError(*world.heights, world.grid, tile).value();
        std::vector<TriangleCorners> corners;
        for (const glm::uvec3& t : tile.triangles) {
            corners.push_back({glm::vec3(tile.vertices[t.x].place()), glm::vec3(tile.vertices[t.y].place()),
                               glm::vec3(tile.vertices[t.z].place())});
        }
        const TriangleTree nearest(std::move(corners));
        double worst = 0.0;
        for (int k = 0; k < 400; ++k) {
            // Half of them on grid lines, where the overlay has its corners; the last one is the next tile's.
            const double a0 = world.grid.across[tile.firstColumn], a1 = world.grid.across[tile.lastColumn];
            const double d0 = world.grid.down[tile.firstRow], d1 = world.grid.down[tile.lastRow];
            double a = random.uniform(a0, a1);
            const double d = random.uniform(d0, d1);
            if (k % 2 == 0)
                a = world.grid.across[tile.firstColumn + random.index(tile.lastColumn - tile.firstColumn)];
            const std::optional<double> ground = surfaceAt(map, world.grid, a, d);
            if (!ground) continue;
            const std::optional<double> drawn = drawnAt(tile, a, d);
            const double distance = drawn ? std::abs(*ground - *drawn)
                                          : std::sqrt(static_cast<double>(
                                                nearest.closest(glm::vec3(a, *ground, d)).squaredDistance));
            worst = std::max(worst, distance);
        }
        RC_ASSERT(worst <= error * (1.0 + 1e-5) + 1.0);
    }
}

RC_GTEST_PROP(TerrainError, BoundsTheDistanceAtEveryPlace, ()) {
    Random random(*rc::gen::arbitrary<std::uint32_t>());
    const auto columns = static_cast<std::uint32_t>(2 + random.index(50)),
               rows = static_cast<std::uint32_t>(12 + random.index(60));
    checkErrors(TerrainWorld(test::randomTerrain(columns, rows, random.bits(), random.uniform(),
                                                 random.index(3) == 0)),
                random);
}

TEST(TerrainError, IsExactForASpikeBetweenTheKeptSamples) {
    // 8 x 8 cells, flat but for one height of 3 m; leaves of 4 x 4. The root may keep the spike or not: the
    // error is 0 or its height, nothing between.
    std::vector<float> heights(81, 1.0f);
    heights[4 * 9 + 3] = 4.0f;
    const TerrainWorld world(HandMadeTerrain(9, 9, heights));
    const TileMesh root = makeTile(world.build(), {0, 0, 0}).value();
    TileMesh without = root;
    for (TileVertex& v : without.vertices) v.height = world.grid.heightUnits(1.0f);
    const double units = 3.0 / world.grid.grid.step;
    EXPECT_NEAR(terrainError(*world.heights, world.grid, without).value(), units, 1e-6 * units);
}

TEST(HangSkirts, ReachBelowEveryNeighbourOfAnotherLevel) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const TerrainWorld world(test::randomTerrain(70, 60, seed, 0.4));
        const TerrainTree tree = makeTerrainTree(*world.heights, world.layout).value();
        int skirts = 0;
        for (const TerrainTree::Node& node : tree.nodes) {
            TileMesh tile = makeTile(world.build(), node.tile).value();
            const std::size_t surface = tile.triangles.size();
            ASSERT_TRUE(hangSkirts(world.build(), tile));
            for (std::size_t t = surface; t < tile.triangles.size(); t += 2) {
                ++skirts;
                // The two triangles of a stretch: its lower corners are those below the upper ones.
                std::map<std::pair<int, int>, std::pair<int, int>> ends;  // place -> low, high
                for (std::size_t k = t; k < t + 2; ++k) {
                    for (int i = 0; i < 3; ++i) {
                        const TileVertex& v = tile.vertices[tile.triangles[k][i]];
                        const auto [at, isNew] =
                            ends.emplace(std::pair(v.across, v.down), std::pair(v.height, v.height));
                        at->second = {std::min(at->second.first, v.height),
                                      std::max(at->second.second, v.height)};
                    }
                }
                ASSERT_EQ(ends.size(), 2u);
                const auto [a, b] = std::pair(*ends.begin(), *std::next(ends.begin()));
                EXPECT_LT(a.second.first, a.second.second);
                const bool vertical = a.first.first == b.first.first;
                // Every level's line there.
                for (std::uint32_t level = 1; level <= world.layout.depth; ++level) {
                    const std::uint32_t cells = 1u << world.layout.sideExponent(level);
                    const auto& places = vertical ? world.grid.across : world.grid.down;
                    const auto at = static_cast<std::uint32_t>(
                        std::lower_bound(places.begin(), places.end(),
                                         vertical ? a.first.first : a.first.second) -
                        places.begin());
                    if (at % cells != 0 || at == 0) continue;
                    const std::uint32_t tiles = (vertical ? world.grid.rows : world.grid.columns) / cells + 1;
                    for (std::uint32_t along = 0; along < tiles; ++along) {
                        const auto line = borderOf(*world.heights, world.grid, world.layout,
                                                   {level, vertical, at / cells, along})
                                              .value();
                        for (const BorderPoint& p : line) {
                            const int from = vertical ? a.first.second : a.first.first,
                                      to = vertical ? b.first.second : b.first.first;
                            if (p.place < from || p.place > to || p.sides != 3) continue;
                            const double part = static_cast<double>(p.place - from) / (to - from);
                            const double bottom = a.second.first + (b.second.first - a.second.first) * part;
                            EXPECT_LE(bottom, p.height);
                        }
                    }
                }
            }
        }
        EXPECT_GT(skirts, 50);
    }
}

}  // namespace
}  // namespace fb
