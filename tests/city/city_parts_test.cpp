// The parts that pictures and shapes are made of, against independent slow ones or by hand.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

#include "base/random.h"
#include "import/city_paint.h"

namespace fb::city {
namespace {

RC_GTEST_PROP(CityNoise, RowsInAnyOrderAreTheNoiseOfEachPoint, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const double period = *rc::gen::inRange(1, 80) / 16.0;
    std::vector<float> columns;
    double at = *rc::gen::inRange(-500, 500) / 8.0;
    for (int i = 0; i < 40; ++i) columns.push_back(static_cast<float>(at += *rc::gen::inRange(0, 9) / 16.0));
    NoiseOctave octave(columns, period, seed);
    for (int k = 0; k < 8; ++k) {
        const double y = *rc::gen::inRange(-400, 400) / 16.0;
        std::vector<float> row(columns.size(), 1.0f);
        octave.addRow(y, 0.5f, row);
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double expected = 1.0 + 0.5 * smoothNoise(seed, double{columns[i]}, y, period);
            RC_ASSERT(std::abs(row[i] - expected) < 1e-5);
        }
    }
}

TEST(CityNoiseParts, SmoothNoiseIsTheHashOnLatticePointsAndContinuousBetween) {
    EXPECT_DOUBLE_EQ(smoothNoise(9, 3.0, -2.0, 0.5), double{signedUnit(latticeHash(9, 6, -4))});
    for (double x = -1.0; x < 1.0; x += 0.001) {
        EXPECT_LT(std::abs(smoothNoise(9, x, 0.3, 0.5) - smoothNoise(9, x + 0.001, 0.3, 0.5)), 0.01);
    }
}

TEST(CityMasonry, JointsTakeTheirShareOfATexel) {
    // Joints 0.02 wide around multiples of 0.1.
    EXPECT_FLOAT_EQ(jointCoverAt(0.2, 0.1, 0.02, 0.04), 0.5f);     // wholly inside the texel
    EXPECT_FLOAT_EQ(jointCoverAt(0.2, 0.1, 0.02, 0.01), 1.0f);     // the texel wholly inside the joint
    EXPECT_NEAR(jointCoverAt(0.21, 0.1, 0.02, 0.02), 0.5f, 1e-6);  // the joint ends at the texel's middle
    EXPECT_FLOAT_EQ(jointCoverAt(0.25, 0.1, 0.02, 0.04), 0.0f);
    EXPECT_FLOAT_EQ(jointCoverAt(-0.3, 0.1, 0.02, 0.04), 0.5f);
}

TEST(CityText, LettersStandUprightInTheirCells) {
    // One texel a cell: "TL" from column 1 on, rows from the top.
    constexpr int kWidth = 9;
    std::vector<float> places, shade(kWidth, 1.0f), wave(kWidth, 0.0f);
    for (int i = 0; i < kWidth; ++i) places.push_back(static_cast<float>(i) + 0.5f);
    const char* expected[5] = {".###.#...", "..#..#...", "..#..#...", "..#..#...", "..#..###."};
    for (int line = 0; line < 5; ++line) {
        std::vector<std::uint8_t> pixels(3 * kWidth, 0);
        PaintRow row;
        row.at = 10.0 - line - 0.5;
        row.texel = 1.0;
        row.places = places;
        row.shade = shade;
        row.wave = wave;
        row.pixels = pixels.data();
        paintText(row, "TL", 1.0, 10.0, 1.0, {200, 200, 200}, 1.0f);
        std::string seen;
        for (int i = 0; i < kWidth; ++i) seen += pixels[static_cast<std::size_t>(3 * i)] > 100 ? '#' : '.';
        EXPECT_EQ(seen, expected[line]);
    }
    EXPECT_DOUBLE_EQ(textWidth("TL", 0.5), 3.5);
}

TEST(CityLines, AreFilledEvenlyAndNoWiderThanTheSpacing) {
    const std::vector<double> lines{0.0, 1.0, 4.0};
    EXPECT_EQ(fillEvenly(lines, 1.5), (std::vector<double>{0.0, 1.0, 2.5, 4.0}));
    EXPECT_EQ(countEvenly(lines, 1.5), 3u);
    EXPECT_EQ(countEvenly(lines, 100.0), 2u);
}

RC_GTEST_PROP(CityLumps, AreClosedSurfacesOfTheirSizeWithTheCountedTriangles, ()) {
    Lump lump;
    lump.shape = *rc::gen::element(LumpShape::box, LumpShape::ball, LumpShape::car);
    lump.base = {3.0, 1.0, -2.0};
    lump.size = {*rc::gen::inRange(2, 50) / 10.0, *rc::gen::inRange(2, 50) / 10.0,
                 *rc::gen::inRange(2, 50) / 10.0};
    lump.noiseMetres = 0.02;
    lump.seed = *rc::gen::arbitrary<std::uint32_t>();
    lump.underside = *rc::gen::arbitrary<bool>();
    const double spacing = *rc::gen::inRange(2, 60) / 10.0;
    MeshBuilder builder;
    addThing({lump}, spacing, 0, builder);
    const SourceMesh mesh = builder.finish();
    RC_ASSERT(mesh.triangles.size() == countThing({lump}, spacing));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        for (const auto& [a, b] : {std::pair{t.x, t.y}, std::pair{t.y, t.z}, std::pair{t.z, t.x}})
            ++edges[{a, b}];
        const glm::dvec3 a = mesh.positions[t.x] - lump.base, b = mesh.positions[t.y] - lump.base;
        volume += glm::dot(glm::cross(a, b), mesh.positions[t.z] - lump.base) / 6.0;
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
        RC_ASSERT(count == 1);
        open += edges.count({edge.second, edge.first}) == 0 ? 1 : 0;
    }
    RC_ASSERT((open == 0) == lump.underside);
    RC_ASSERT(volume > 0.0);  // faces outward: the open underside passes through the base and adds nothing
    for (const glm::dvec3& p : mesh.positions) {
        RC_ASSERT(std::abs(p.x - lump.base.x) < lump.size.x / 2.0 + 0.05);
        RC_ASSERT(std::abs(p.z - lump.base.z) < lump.size.z / 2.0 + 0.05);
        RC_ASSERT(p.y > lump.base.y - 0.05);
        RC_ASSERT(p.y < lump.base.y + lump.size.y + 0.05);
    }
}

Building houseAt(double x0, double x1, double z0, double z1, int floors) {
    Building house;
    house.footprint = {x0, z0, x1, z1};
    house.walls = {WallUse::street, WallUse::party, WallUse::back, WallUse::party};
    house.floors = floors;
    return house;
}

// From the west: 3 floors, 5 floors, a gap, 4 floors, 4 floors but a metre shallower; all facing south.
TEST(CityWalls, OfTwoNeighboursTheHigherHasTheWallBetweenThem) {
    Row south, north;
    south.buildings = {houseAt(0, 10, 0, 12, 3), houseAt(10, 20, 0, 12, 5), houseAt(28, 36, 0, 12, 4),
                       houseAt(36, 44, 1, 12, 4)};
    findSeenWalls(north, south);
    const auto& b = south.buildings;
    EXPECT_EQ(b[0].walls[kEast], WallUse::hidden);
    EXPECT_EQ(b[1].walls[kWest], WallUse::party);
    EXPECT_NEAR(b[1].wallFrom[kWest], b[0].roofY() - 0.4, 1e-12);
    EXPECT_EQ(b[1].walls[kEast], WallUse::back);  // looks over the gap
    EXPECT_EQ(b[2].walls[kWest], WallUse::back);
    EXPECT_EQ(b[2].walls[kEast], WallUse::party);  // seen behind the shallower neighbour
    EXPECT_EQ(b[2].wallFrom[kEast], 0.0);
    EXPECT_EQ(b[3].walls[kWest], WallUse::hidden);  // as high, and not the first
    EXPECT_EQ(b[0].walls[kNorth], WallUse::back);
    EXPECT_EQ(b[0].walls[kSouth], WallUse::street);
}

// A low house behind a high one of the same width, back to back.
TEST(CityWalls, BackToBackTheHigherHouseIsSeenAboveTheLower) {
    Row south, north;
    south.buildings = {houseAt(0, 10, 0, 12, 2)};
    north.buildings = {houseAt(0, 10, -12, 0, 6)};
    north.buildings[0].walls = {WallUse::back, WallUse::street, WallUse::street, WallUse::street};
    findSeenWalls(north, south);
    EXPECT_EQ(north.buildings[0].walls[kSouth], WallUse::party);
    EXPECT_NEAR(north.buildings[0].wallFrom[kSouth], south.buildings[0].roofY() - 0.4, 1e-12);
    EXPECT_EQ(south.buildings[0].walls[kNorth], WallUse::hidden);
}

}  // namespace
}  // namespace fb::city
