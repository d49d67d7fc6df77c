// Facades: one design for shape and paint.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "import/city_paint.h"

namespace fb::city {
namespace {

constexpr double kTop = 8.0;

// 10 m of red plaster along x, facing +z, with one window [4, 6] x [2, 4] m, half a metre deep.
Facade redWall() {
    Facade facade;
    facade.line = {{0.0, 0.0}, {10.0, 0.0}};
    facade.starts = {0.0, 10.0};
    facade.normals = {{0.0, 1.0}};
    facade.bottom = 0.0;
    facade.top = kTop;
    facade.wrapDown = kTop - 0.6;
    facade.flaps = true;
    facade.openings = {{0, {40, 60, 20, 40}, 0.5, OpeningKind::window, 77u, false}};
    facade.style.wallColour = {200, 0, 0};
    facade.style.trim = {200, 0, 0};
    facade.style.frame = {0, 220, 220};
    facade.style.blind = {0, 180, 180};
    facade.style.grime = 0.0f;
    facade.seed = 5;
    return facade;
}

SourceMesh meshOf(const Facade& facade, Detail detail, double spacing) {
    MeshBuilder mesh;
    addFacade(facade, fillGrid(featureGrid(facade, detail), spacing, 1), detail, 0, true, mesh);
    return mesh.finish();
}

TEST(CityFacade, TheWindowIsPaintedWhereTheMeshIsSetBack) {
    const Facade facade = redWall();
    const SourceMesh mesh = meshOf(facade, Detail::coarse, 0.1);
    const FacadeGrid features = featureGrid(facade, Detail::coarse);
    const Image image = paintFacade(facade, features, {400, 300});
    int inside = 0, outside = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 p = mesh.positions[v];
        const glm::dvec2 fromEdge(std::abs(std::abs(p.x - 5.0) - 1.0), std::abs(std::abs(p.y - 3.0) - 1.0));
        if (p.y == facade.wrapDown) continue;  // behind the parapet
        if (fromEdge.x < 0.1 || fromEdge.y < 0.1 || p.x < 0.1 || p.x > 9.9 || p.y > kTop - 0.05) continue;
        const bool window = p.x > 4.0 && p.x < 6.0 && p.y > 2.0 && p.y < 4.0;
        EXPECT_NEAR(p.z, window ? -0.5 : 0.0, 0.03) << p.x << " " << p.y;
        const int column = std::min(399, static_cast<int>(mesh.uvs[v].x * 400.0f));
        const int row = std::min(299, static_cast<int>(mesh.uvs[v].y * 300.0f));
        const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(3 * (row * 400 + column))];
        const bool red = pixel[0] > pixel[2] + 60;
        EXPECT_EQ(red, !window) << p.x << " " << p.y << ": " << int{pixel[0]} << " " << int{pixel[2]};
        ++(window ? inside : outside);
    }
    EXPECT_GT(inside, 200);
    EXPECT_GT(outside, 2000);
}

TEST(CityFacade, AFlatWallHasItsAreaAndFacesOutward) {
    const SourceMesh mesh = meshOf(redWall(), Detail::flat, 0.5);
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const glm::dvec3 n = glm::cross(b - a, c - a) * 0.5;
        if (n.z > 0.9 * glm::length(n)) area += n.z;
    }
    EXPECT_NEAR(area, 10.0 * kTop, 1e-6);
}

TEST(CityFacade, BothWallsOfACornerMeetInOneColumnOfVertices) {
    Facade facade = redWall();
    facade.line.push_back({10.0, -6.0});
    facade.starts.push_back(16.0);
    facade.normals.push_back({1.0, 0.0});
    // A ledge of 0.4 m runs around the corner: its edge is at (10.4, 0.4).
    facade.reliefs.push_back({kAllRound, {0, 0, 60, 64}, 0.4, 0.4, ReliefKind::cornice, 0u, false});
    const SourceMesh mesh = meshOf(facade, Detail::coarse, 0.3);
    double furthest = 0.0;
    for (const glm::dvec3& p : mesh.positions) furthest = std::max(furthest, std::min(p.x - 10.0, p.z));
    EXPECT_NEAR(furthest, 0.4, 0.02);
}

RC_GTEST_PROP(CityFacadeProperty, HasAsManyTrianglesAsWereCounted, ()) {
    Facade facade = redWall();
    facade.reliefs.push_back({kAllRound, {0, 0, 60, 64}, 0.4, 0.4, ReliefKind::cornice, 0u, false});
    facade.reliefs.push_back({0, {39, 61, 19, 20}, 0.1, 0.1, ReliefKind::sill, 0u, true});
    const auto detail = *rc::gen::element(Detail::flat, Detail::coarse, Detail::all);
    const double spacing = *rc::gen::inRange(5, 400) / 100.0;
    const FacadeGrid features = featureGrid(facade, detail);
    const FacadeGrid filled = fillGrid(features, spacing, 3);
    RC_ASSERT(countFilled(features, spacing) == filled.triangles());
    RC_ASSERT(meshOf(facade, detail, spacing).triangles.size() == filled.triangles());
    for (std::size_t i = 2; i + 1 < filled.columns.size(); ++i) {
        RC_ASSERT(filled.columns[i].at > filled.columns[i - 1].at);
        RC_ASSERT(filled.columns[i].at - filled.columns[i - 1].at < spacing * 1.31);
        RC_ASSERT(filled.columns[i].textureAt > filled.columns[i - 1].textureAt);
    }
}

// Two edge columns and the bottom, the top and the way over the parapet: nothing else in a flat wall.
TEST(CityFacade, DetailDecidesWhichEdgesGetLines) {
    Facade facade = redWall();
    facade.flaps = false;
    facade.reliefs.push_back({0, {39, 61, 19, 20}, 0.1, 0.1, ReliefKind::sill, 0u, true});
    EXPECT_EQ(featureGrid(facade, Detail::flat).columns.size(), 2u);
    EXPECT_EQ(featureGrid(facade, Detail::flat).rows.size(), 4u);
    EXPECT_EQ(featureGrid(facade, Detail::coarse).columns.size(), 2u + 4u);
    EXPECT_EQ(featureGrid(facade, Detail::coarse).rows.size(), 4u + 4u);
    EXPECT_EQ(featureGrid(facade, Detail::all).columns.size(), 2u + 8u);
    EXPECT_EQ(featureGrid(facade, Detail::all).rows.size(),
              4u + 6u);  // the sill's upper edge is the window's lower one
}

// A house in a row: streets to the south and east, a yard to the north, a lower neighbour to the west.
TEST(CityFacade, AHouseOnACornerHasOneFrontOneBackAndOneBareWall) {
    Building house;
    house.footprint = {0.0, 0.0, 12.0, 14.0};
    house.walls = {WallUse::street, WallUse::street, WallUse::back, WallUse::party};
    house.wallFrom = {0.0, 0.0, 0.0, 6.5};
    house.chamfer = {2.0, 0.0, 0.0, 0.0};
    house.floors = 4;
    house.seed = 9;
    const std::vector<Facade> facades = designFacades(house);
    ASSERT_EQ(facades.size(), 3u);
    EXPECT_EQ(facades[0].role, FacadeRole::front);
    EXPECT_EQ(facades[0].segments(), 3);  // south, the cut-off corner, east
    EXPECT_NEAR(facades[0].length(), 10.0 + 2.0 * std::sqrt(2.0) + 12.0, 1e-9);
    EXPECT_EQ(facades[1].role, FacadeRole::back);
    EXPECT_NEAR(facades[1].length(), 12.0, 1e-9);
    EXPECT_EQ(facades[2].role, FacadeRole::party);
    EXPECT_EQ(facades[2].bottom, 6.5);
    EXPECT_TRUE(facades[2].openings.empty());
    for (const Facade& facade : facades) {
        for (int k = 0; k < facade.segments(); ++k) {  // outward: away from the middle of the house
            const glm::dvec2 middle = (facade.line[k] + facade.line[k + 1]) * 0.5;
            EXPECT_GT(glm::dot(facade.normals[k], middle - glm::dvec2(6.0, 7.0)), 0.0);
        }
        EXPECT_EQ(facade.top, house.top());
    }
}

TEST(CityFacade, StoreysAndDoorsHaveTheSizeOfReality) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Building house;
        house.footprint = {0.0, 0.0, 14.0, 13.0};
        house.walls = {WallUse::street, WallUse::party, WallUse::back, WallUse::party};
        house.floors = 2 + static_cast<int>(seed % 5);
        house.shop = seed % 2 == 0;
        house.groundFloorDecimetres = house.shop ? 42 : 34;
        house.seed = seed;
        const Facade front = designFacades(house).front();
        int doors = 0;
        for (const Opening& o : front.openings) {
            EXPECT_GE(o.at.s0, 2);
            EXPECT_LE(o.at.s1, 138);
            EXPECT_LT(o.at.y1 / 10.0, house.top());
            if (o.kind != OpeningKind::door) continue;
            ++doors;
            EXPECT_EQ(o.at.y0, 1);             // the pavement is at 0.14 m
            EXPECT_GE(o.at.y1 - o.at.y0, 21);  // room for a leaf of 2.1 m
            EXPECT_GE(o.at.s1 - o.at.s0, 9);
        }
        EXPECT_EQ(doors, 1) << "seed " << seed;
    }
}

}  // namespace
}  // namespace fb::city
