#include "build/measured_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/random.h"
#include "build/convex_cell.h"
#include "build/highest_of_least.h"

namespace fb {
namespace {

constexpr std::uint32_t kNone = MeasuredSurface::kNoTriangle;

MeasuredSurface surfaceOf(std::vector<glm::uvec3> triangles) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 6; ++i) points.emplace_back(i, i * i, 0);
    return {points, std::move(triangles)};
}

TEST(MeasuredSurface, KnowsTheNeighbourOverEachEdge) {
    const MeasuredSurface strip = surfaceOf({{0, 1, 2}, {1, 3, 2}, {3, 1, 4}});
    EXPECT_EQ(strip.neighbour(0, 0), kNone);
    EXPECT_EQ(strip.neighbour(0, 1), 1u);
    EXPECT_EQ(strip.neighbour(1, 2), 0u);
    EXPECT_EQ(strip.neighbour(1, 0), 2u);
    EXPECT_EQ(strip.neighbour(2, 0), 1u);
    EXPECT_EQ(strip.neighbour(2, 1), kNone);
}

TEST(MeasuredSurface, PairsNeighboursWhereMoreThanTwoTrianglesMeet) {
    const MeasuredSurface fan = surfaceOf({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 5}, {2, 1, 0}});
    EXPECT_EQ(fan.neighbour(0, 0), 1u);
    EXPECT_EQ(fan.neighbour(1, 0), 0u);
    EXPECT_EQ(fan.neighbour(2, 0), 3u);
    EXPECT_EQ(fan.neighbour(3, 0), 2u);
    EXPECT_EQ(fan.neighbour(4, 1), kNone);  // the fifth at edge 0-1 has none left
}

RC_GTEST_PROP(HighestOfLeast, IsWhatAGridOfPointsComesClosestTo, (std::uint64_t seed)) {
    Random random(seed);
    std::array<glm::vec3, 3> values;
    for (glm::vec3& v : values) v = glm::vec3(random.uniform(), random.uniform(), random.uniform());
    if (random.uniform() < 0.2) values[1] = values[0];
    constexpr int kSide = 60;
    float highest = 0.0f;
    for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; i + j <= kSide; ++j) {
            const glm::vec3 at = glm::vec3(i, j, kSide - i - j) / static_cast<float>(kSide);
            highest = std::max(highest, std::min({glm::dot(values[0], at), glm::dot(values[1], at),
                                                  glm::dot(values[2], at)}));
        }
    }
    RC_ASSERT(highestOfLeast(values) >= highest - 1e-6f);
    RC_ASSERT(highestOfLeast(values) <= highest + 2.0f / static_cast<float>(kSide));
}

TEST(ConvexCell, ThatIsThinnerThanRoundingIsNotCut) {
    Cell cell;  // eleven corners along a line, whose distances to it change sign at each
    for (int i = 0; i < 11; ++i) cell.add({i, i % 2 == 0 ? 1e-9 : -1e-9, 0.0});
    const Cuts cuts(cell, glm::dvec3(0.0), {0, 1, 0}, 1e-12);
    EXPECT_FALSE(cuts.isInside());
    EXPECT_TRUE(cuts.isOutside());
}

double areaOf(const Cell& cell) {
    double area = 0.0;
    for (std::size_t i = 2; i < cell.count; ++i)
        area += 0.5 * glm::length(glm::cross(cell.corners[i - 1] - cell.corners[0],
                                             cell.corners[i] - cell.corners[0]));
    return area;
}

RC_GTEST_PROP(ConvexCell, BothPartsOfACutAreTheWhole, (std::uint64_t seed)) {
    Random random(seed);
    const auto point = [&] { return glm::dvec3(random.uniform(), random.uniform(), random.uniform()) * 1e5; };
    std::vector<Cell> cells(1);
    for (int k = 0; k < 3; ++k) cells[0].add(point());
    const double whole = areaOf(cells[0]);
    for (int cut = 0; cut < 12; ++cut) {
        const glm::dvec3 origin = point(), inwards = point() - point();
        std::vector<Cell> parts;
        for (const Cell& cell : cells) {
            const Cuts cuts(cell, origin, inwards, 1e-6);
            if (cuts.isInside() || cuts.isOutside()) {
                parts.push_back(cell);
                continue;
            }
            Cell inside, outside;
            cuts.split(cell, inside, outside);
            for (const glm::dvec3& p : inside.points()) RC_ASSERT(glm::dot(p - origin, inwards) >= -1e-3);
            for (const glm::dvec3& p : outside.points()) RC_ASSERT(glm::dot(p - origin, inwards) <= 1e-3);
            parts.push_back(inside);
            parts.push_back(outside);
        }
        cells = parts;
    }
    double sum = 0.0;
    for (const Cell& cell : cells) sum += areaOf(cell);
    RC_ASSERT(std::abs(sum - whole) <= 1e-9 * whole);
}

}  // namespace
}  // namespace fb
