#include "build/closest_of_few.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"

namespace fb {
namespace {

glm::vec3 randomPoint(Random& random, double size) {
    const auto one = [&] { return static_cast<float>(random.uniform(-size, size)); };
    return {one(), one(), one()};
}

// Some are needles, some have no area or no extent at all.
TriangleCorners randomTriangle(Random& random, const glm::dvec3& amid, double size) {
    const glm::vec3 a = glm::vec3(amid) + randomPoint(random, size);
    const glm::vec3 b = a + randomPoint(random, random.index(6) == 0 ? 1e-3 * size : size);
    switch (random.index(6)) {
        case 0: return {a, b, 0.5f * (a + b)};
        case 1: return {a, a, a};
        case 2: return {a, b, b + randomPoint(random, 1e-4 * size)};
        default: return {a, b, a + randomPoint(random, size)};
    }
}

double distanceOf(const ClosestOfFew::Hit& hit, const TriangleCorners& corners, const glm::dvec3& point) {
    glm::dvec3 way(0.0);  // weights add to 1 but for rounding, which far from the origin is much
    for (int k = 0; k < 3; ++k) {
        way += (glm::dvec3(corners[static_cast<std::size_t>(k)]) - point) * static_cast<double>(hit.weights[k]);
    }
    return glm::length(way);
}

// Far from the origin too: only differences count.
RC_GTEST_PROP(ClosestOfFew, FindsAPointAsCloseAsTheClosest, (std::uint64_t seed)) {
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(0.0, 4.0));
    const glm::dvec3 centre = random.index(2) == 0 ? glm::dvec3(0.0) : glm::dvec3(4e6, -7e6, 1e6);
    std::vector<TriangleCorners> triangles;
    for (std::size_t i = 0; i <= random.index(12); ++i) triangles.push_back(randomTriangle(random, centre, size));
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i <= random.index(30); ++i) points.push_back(centre + glm::dvec3(randomPoint(random, size)));
    ClosestOfFew search;
    for (int round = 0; round < 2; ++round) {  // the second forgets the first
        search.clear(centre);
        for (const glm::dvec3& point : points) search.add(point);
        search.search(triangles);
        for (std::size_t i = 0; i < points.size(); ++i) {
            double wanted = std::numeric_limits<double>::infinity();
            for (const TriangleCorners& t : triangles) {
                wanted = std::min(wanted, std::sqrt(double{closestOnTriangle(points[i], t).squaredDistance}));
            }
            const ClosestOfFew::Hit hit = search.hit(i);
            RC_ASSERT(hit.triangle < triangles.size());
            for (int k = 0; k < 3; ++k) RC_ASSERT(hit.weights[k] >= -1e-5f && hit.weights[k] <= 1.0f + 1e-5f);
            RC_ASSERT(distanceOf(hit, triangles[hit.triangle], points[i]) <= wanted + 1e-4 * size);
        }
        points.pop_back();
        if (points.empty()) break;
    }
}

TEST(ClosestOfFew, TakesTheFirstOfEquallyCloseTriangles) {
    const TriangleCorners t = {glm::vec3(0, 0, 0), glm::vec3(8, 0, 0), glm::vec3(0, 8, 0)};
    const TriangleCorners above = {glm::vec3(0, 0, 2), glm::vec3(8, 0, 2), glm::vec3(0, 8, 2)};
    ClosestOfFew search;
    search.clear(glm::dvec3(0.0));
    search.add({2, 2, 1});
    search.add({2, 2, 1.5});
    search.search(std::vector{t, above, t});
    EXPECT_EQ(search.hit(0).triangle, 0u);
    EXPECT_EQ(search.hit(1).triangle, 1u);
    EXPECT_EQ(search.hit(0).weights, glm::vec3(0.5f, 0.25f, 0.25f));
}

}  // namespace
}  // namespace fb
