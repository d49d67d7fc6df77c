// The city on hills: what stands, stands on the ground; the country never comes through the streets; without
// hills nothing changes.
#include <gtest/gtest.h>

#include <cmath>

#include "import/city_plan.h"
#include "import/terrain_source.h"
#include "load_city.h"

namespace fb {
namespace {

using test::cityOf;
using test::loadAll;
using test::smallCity;

CityOptions hillyCity() {
    CityOptions options = smallCity();
    options.terrain = true;
    return options;
}

struct Country {
    TerrainInfo info;
    std::vector<float> heights;
};
Country countryOf(const BlockSource& city) {
    Country country{city.terrain()->info(), {}};
    EXPECT_TRUE(city.terrain()->readHeights([&](std::uint32_t, std::span<const float> rows) -> Result<void> {
        country.heights.insert(country.heights.end(), rows.begin(), rows.end());
        return {};
    }));
    return country;
}

TEST(CityTerrain, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
    const auto a = cityOf(hillyCity()), b = cityOf(hillyCity());
    EXPECT_EQ(a->info().sourceHash, b->info().sourceHash);
    EXPECT_EQ(test::hashOf(loadAll(*a)[1]), test::hashOf(loadAll(*b)[1]));
    EXPECT_NE(a->info().sourceHash, cityOf(smallCity())->info().sourceHash);
    CityOptions other = hillyCity();
    other.seed = 2;
    EXPECT_NE(a->terrain()->info().sourceHash, cityOf(other)->terrain()->info().sourceHash);
    EXPECT_EQ(cityOf(smallCity())->terrain(), nullptr);
}

TEST(CityTerrain, BuildingsStandOnTheHighestGroundOfTheirLotAndReachBelowTheLowest) {
    const city::CityPlan plan = city::makePlan(hillyCity());
    const auto city = cityOf(hillyCity());
    double steepest = 0.0;
    for (std::size_t u = 0; u < plan.units.size(); ++u) {
        const SourceMesh mesh = city->load(u)->mesh;
        for (const city::Building& b : plan.units[u].buildings) {
            const city::Rect& f = b.footprint;
            double lowest = 1e300, highest = -1e300;
            for (double z = f.z0; z <= f.z1; z += 0.5) {
                for (double x = f.x0; x <= f.x1; x += 0.5) {
                    const double ground = plan.hills.heightAt(x, z);
                    lowest = std::min(lowest, ground);
                    highest = std::max(highest, ground);
                }
            }
            steepest = std::max(steepest, highest - lowest);
            EXPECT_NEAR(b.baseY, highest, 0.05);
            // The building's lowest vertices: its foundation, below all ground around it, but no cellar.
            double bottom = 1e300;
            for (const glm::dvec3& p : mesh.positions) {
                const bool inside =
                    p.x > f.x0 + 0.01 && p.x < f.x1 - 0.01 && p.z > f.z0 + 0.01 && p.z < f.z1 - 0.01;
                if (inside) bottom = std::min(bottom, p.y);
            }
            EXPECT_LT(bottom, lowest - 0.3);
            EXPECT_GT(bottom, lowest - 1.0);
        }
    }
    EXPECT_GT(steepest, 0.2);  // the hills are some
}

TEST(CityTerrain, StreetsFollowTheHills) {
    const city::CityPlan plan = city::makePlan(hillyCity());
    const auto flat = cityOf(smallCity()), hilly = cityOf(hillyCity());
    // The ground of each unit: vertices within a kerb and the noise of the ground.
    for (std::size_t u = 0; u < plan.units.size(); ++u) {
        const SourceMesh mesh = hilly->load(u)->mesh;
        std::size_t ground = 0;
        for (const glm::dvec3& p : mesh.positions) {
            const double above = p.y - plan.hills.heightAt(p.x, p.z);
            if (std::abs(above) < 0.2) ++ground;
        }
        EXPECT_GT(ground, 100u);
    }
    const WalkHint &walk = hilly->info().walks.front(), &level = flat->info().walks.front();
    ASSERT_EQ(walk.points.size(), level.points.size());
    for (std::size_t i = 0; i < walk.points.size(); ++i) {
        const glm::dvec3& p = walk.points[i];
        EXPECT_EQ(p.y, level.points[i].y + plan.hills.heightAt(p.x, p.z));
    }
}

TEST(CityTerrain, TheCountryIsThreeCitiesWideAndLowerThanTheCityInsideIt) {
    const city::CityPlan plan = city::makePlan(hillyCity());
    const Country country = countryOf(*cityOf(hillyCity()));
    const TerrainInfo& info = country.info;
    ASSERT_EQ(country.heights.size(), std::size_t{info.columns} * info.rows);
    EXPECT_GE((info.columns - 1) * info.cellMetres.x, 3.0 * plan.ground.width());
    EXPECT_GE((info.rows - 1) * info.cellMetres.y, 3.0 * plan.ground.depth());
    std::size_t inside = 0, holes = 0;
    for (std::uint32_t r = 0; r + 1 < info.rows; ++r) {
        for (std::uint32_t c = 0; c + 1 < info.columns; ++c) {
            const double x = info.firstSample.x + c * info.cellMetres.x,
                         z = info.firstSample.z + r * info.cellMetres.y;
            const double cell = info.cellMetres.x;
            const bool crosses = x + cell > plan.ground.x0 && x < plan.ground.x1 &&
                                 z + cell > plan.ground.z0 && z < plan.ground.z1;
            if (!crosses) continue;
            for (const std::size_t at :
                 {std::size_t{r} * info.columns + c, std::size_t{r + 1} * info.columns + c + 1}) {
                const float height = country.heights[at];
                if (height != height) {
                    ++holes;
                    continue;
                }
                ++inside;
                const double px = info.firstSample.x + static_cast<double>(at % info.columns) * cell;
                const double pz = info.firstSample.z + static_cast<double>(at / info.columns) * cell;
                EXPECT_LT(height, plan.hills.heightAt(px, pz) - 0.4);
            }
        }
    }
    EXPECT_GT(inside, 50u);
    EXPECT_GT(holes, inside);
}

TEST(CityTerrain, ThePictureIsPaintedForEveryTexel) {
    const auto city = cityOf(hillyCity());
    const TerrainInfo& info = city->terrain()->info();
    std::uint64_t bytes = 0, dark = 0;
    ASSERT_TRUE(
        city->terrain()->readDrape([&](std::uint32_t, std::span<const std::uint8_t> rows) -> Result<void> {
            bytes += rows.size();
            for (std::size_t i = 0; i < rows.size(); i += 3)
                dark += rows[i] + rows[i + 1] + rows[i + 2] < 60 ? 1 : 0;
            return {};
        }));
    EXPECT_EQ(bytes, std::uint64_t(info.drapeWidth) * std::uint64_t(info.drapeHeight) * 3);
    EXPECT_EQ(dark, 0u);
}

}  // namespace
}  // namespace fb
