#include "base/triangle_tree.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"

namespace fb {
namespace {

const TriangleCorners kCorner = {glm::vec3(0, 0, 0), glm::vec3(4, 0, 0), glm::vec3(0, 4, 0)};

TEST(ClosestOnTriangle, FindsFaceEdgesAndCorners) {
    EXPECT_EQ(closestOnTriangle({1, 1, 3}, kCorner).squaredDistance, 9.0f);   // above the face
    EXPECT_EQ(closestOnTriangle({2, -2, 0}, kCorner).squaredDistance, 4.0f);  // beside an edge
    EXPECT_EQ(closestOnTriangle({4, 4, 0}, kCorner).squaredDistance, 8.0f);  // beside the long edge, at (2,2)
    EXPECT_EQ(closestOnTriangle({-3, -4, 0}, kCorner).squaredDistance, 25.0f);  // beyond the right angle
    EXPECT_EQ(closestOnTriangle({7, -4, 0}, kCorner).squaredDistance, 25.0f);
    const glm::vec3 weights = closestOnTriangle({1, 2, -5}, kCorner).weights;
    EXPECT_NEAR(glm::length(weights - glm::vec3(0.25f, 0.25f, 0.5f)), 0.0f, 1e-6f);
}

glm::vec3 randomPoint(Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

// A slow and independent answer: the triangle is walked over in ever smaller steps around the best point so
// far.
double searchDistance(const glm::dvec3& p, const TriangleCorners& corners) {
    const glm::dvec3 a(corners[0]), ab(corners[1] - corners[0]), ac(corners[2] - corners[0]);
    double u = 1.0 / 3, v = 1.0 / 3, best = 1e300;
    for (double reach = 1.0; reach > 1e-9; reach *= 0.7) {
        const double cu = u, cv = v;
        for (int i = -6; i <= 6; ++i) {
            for (int j = -6; j <= 6; ++j) {
                double nu = std::clamp(cu + reach * i / 6, 0.0, 1.0),
                       nv = std::clamp(cv + reach * j / 6, 0.0, 1.0);
                if (nu + nv > 1.0) {
                    const double over = (nu + nv - 1.0) / 2;
                    nu = std::clamp(nu - over, 0.0, 1.0);
                    nv = 1.0 - nu;
                }
                const double distance = glm::length(p - (a + nu * ab + nv * ac));
                if (distance < best) {
                    best = distance;
                    u = nu;
                    v = nv;
                }
            }
        }
    }
    return best;
}

RC_GTEST_PROP(ClosestOnTriangle, AgreesWithASearchOverTheTriangle, (std::uint64_t seed)) {
    Random random(seed);
    const TriangleCorners corners = {randomPoint(random, 10), randomPoint(random, 10),
                                     randomPoint(random, 10)};
    const glm::vec3 p = randomPoint(random, 20);
    const ClosestPoint found = closestOnTriangle(p, corners);
    RC_ASSERT(std::abs(found.weights.x + found.weights.y + found.weights.z - 1.0f) < 1e-4f);
    RC_ASSERT(found.weights.x > -1e-4f);
    RC_ASSERT(found.weights.y > -1e-4f);
    RC_ASSERT(found.weights.z > -1e-4f);
    RC_ASSERT(std::abs(std::sqrt(static_cast<double>(found.squaredDistance)) -
                       searchDistance(glm::dvec3(p), corners)) < 2e-3);
}

RC_GTEST_PROP(TriangleTree, FindsWhatComparingAllTrianglesFinds, (std::uint64_t seed)) {
    Random random(seed);
    std::vector<TriangleCorners> triangles;
    for (std::uint64_t i = 0; i <= random.index(60); ++i) {
        const glm::vec3 at = randomPoint(random, 50);
        triangles.push_back({at, at + randomPoint(random, 8), at + randomPoint(random, 8)});
    }
    const TriangleTree tree(triangles);
    for (int i = 0; i < 10; ++i) {
        const glm::vec3 p = randomPoint(random, 70);
        float best = std::numeric_limits<float>::infinity(), bestEven = best;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const float distance = closestOnTriangle(p, triangles[t]).squaredDistance;
            best = std::min(best, distance);
            if (t % 2 == 0) bestEven = std::min(bestEven, distance);
        }
        RC_ASSERT(tree.closest(p).squaredDistance == best);
        RC_ASSERT(tree.closest(p, {}, -1.0f, [](std::uint32_t t) { return t % 2 == 0; }).squaredDistance ==
                  bestEven);
        // A start that is as good already stays; a search that may stop early answers within its bound.
        RC_ASSERT(
            tree.closest(p, tree.closest(p), -1.0f, [](std::uint32_t) { return true; }).squaredDistance ==
            best);
        const ClosestPoint early = tree.closest(p, {}, best * 4.0f, [](std::uint32_t) { return true; });
        RC_ASSERT(early.squaredDistance <= best * 4.0f);
    }
}

TEST(TriangleTree, OfNothingFindsNothing) {
    const TriangleTree tree({});
    EXPECT_EQ(tree.closest(glm::vec3(0)).triangle, ~std::uint32_t{0});
}

}  // namespace
}  // namespace fb
