#include "build/farthest_from.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/random.h"

namespace fb {
namespace {

// The largest distance of many random points of `from`.
double sampled(const MeasuredSurface& from, const TriangleTree& to, Random& random, int pointsEach) {
    float worst = 0.0f;
    for (const TriangleCorners& t : from.tree().triangles()) {
        for (int i = 0; i < pointsEach; ++i) {
            auto u = static_cast<float>(random.uniform()), v = static_cast<float>(random.uniform());
            if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
            worst = std::max(worst, to.closest(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])).squaredDistance);
        }
    }
    return std::sqrt(static_cast<double>(worst));
}

// Equal corners are one point.
MeasuredSurface surfaceOf(const std::vector<TriangleCorners>& triangles) {
    std::vector<glm::vec3> points;
    std::vector<glm::uvec3> indices;
    for (const TriangleCorners& t : triangles) {
        glm::uvec3 index(0);
        for (int k = 0; k < 3; ++k) {
            const auto found = std::ranges::find(points, t[static_cast<std::size_t>(k)]);
            index[k] = static_cast<std::uint32_t>(found - points.begin());
            if (found == points.end()) points.push_back(t[static_cast<std::size_t>(k)]);
        }
        indices.push_back(index);
    }
    return {std::move(points), std::move(indices)};
}

glm::vec3 randomPoint(Random& random, const glm::vec3& size) {
    return size * glm::vec3(random.uniform(), random.uniform(), random.uniform());
}

MeasuredSurface soup(Random& random, std::size_t count, const glm::vec3& size) {
    std::vector<TriangleCorners> triangles;
    for (std::size_t i = 0; i < count; ++i)
        triangles.push_back({randomPoint(random, size), randomPoint(random, size), randomPoint(random, size)});
    return surfaceOf(triangles);
}

// Heights over a square of side * side cells, two triangles each.
MeasuredSurface terrain(int side, float width, const std::function<float(float, float)>& height) {
    std::vector<TriangleCorners> triangles;
    const auto at = [&](int x, int y) {
        const float u = width * static_cast<float>(x) / static_cast<float>(side);
        const float v = width * static_cast<float>(y) / static_cast<float>(side);
        return glm::vec3(u, v, height(u, v));
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    }
    return surfaceOf(triangles);
}

TEST(FarthestFrom, IsExactButForItsMarginWhereTheFarthestPointIsACorner) {
    const MeasuredSurface plane = surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(900, 0, 0), glm::vec3(0, 900, 0)}});
    const MeasuredSurface raised = surfaceOf({{glm::vec3(100, 100, 10), glm::vec3(200, 100, 30), glm::vec3(100, 200, 20)}});
    EXPECT_NEAR(farthestFrom(raised, plane.tree(), 0.0), 33.0, 1e-2);
    EXPECT_NEAR(farthestFrom(raised, plane.tree(), 50.0), 50.0, 1e-2);
}

// A ridge between two corners that lie on the plane: no corner of `from` is far, its middle is.
TEST(FarthestFrom, FindsWhatLiesBetweenCorners) {
    const MeasuredSurface flat = surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(800, 0, 0), glm::vec3(400, 800, 0)}});
    const MeasuredSurface far = surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)},
                            {glm::vec3(800, 0, 0), glm::vec3(799, 0, 0), glm::vec3(799, 1, 0)},
                            {glm::vec3(400, 800, 0), glm::vec3(400, 799, 0), glm::vec3(401, 799, 0)}});
    Random random(1);
    const double truth = sampled(flat, far.tree(), random, 20000);
    EXPECT_GT(truth, 400.0);
    EXPECT_GE(farthestFrom(flat, far.tree(), 0.0), truth);
    EXPECT_LE(farthestFrom(flat, far.tree(), 0.0), truth * 1.12);
}

TEST(FarthestFrom, TakesLittleWorkWhereSurfacesCoincide) {
    const MeasuredSurface fine = terrain(64, 4096.0f, [](float, float) { return 7.0f; });
    const MeasuredSurface coarse = terrain(3, 4096.0f, [](float, float) { return 7.0f; });
    EXPECT_LE(farthestFrom(fine, coarse.tree(), 0.0), kFarthestUnits);
    EXPECT_LE(farthestFrom(coarse, fine.tree(), 0.0), kFarthestUnits);
}

RC_GTEST_PROP(FarthestFrom, IsNotExceededOnRandomTriangles, (std::uint64_t seed)) {
    Random random(seed);
    const glm::vec3 size(1e6f, random.uniform() < 0.5 ? 1e6f : 1e3f, 1e6f);
    const MeasuredSurface a = soup(random, 1 + random.index(20), size), b = soup(random, 1 + random.index(60), size);
    RC_ASSERT(farthestFrom(a, b.tree(), 0.0) + kFarthestUnits >= sampled(a, b.tree(), random, 300));
}

RC_GTEST_PROP(FarthestFrom, IsNotExceededOnHills, (std::uint64_t seed)) {
    Random random(seed);
    const auto rough = static_cast<float>(random.uniform(1.0, 3e4)), wave = static_cast<float>(random.uniform(1e-5, 1e-3));
    const auto height = [&](float x, float y) { return rough * std::sin(x * wave) * std::cos(y * wave * 1.3f); };
    const MeasuredSurface fine = terrain(24, 1e5f, height);
    const MeasuredSurface coarse = terrain(static_cast<int>(2 + random.index(20)), 1e5f, height);
    RC_ASSERT(farthestFrom(fine, coarse.tree(), 0.0) + kFarthestUnits >= sampled(fine, coarse.tree(), random, 20));
    RC_ASSERT(farthestFrom(coarse, fine.tree(), 0.0) + kFarthestUnits >= sampled(coarse, fine.tree(), random, 100));
}

}  // namespace
}  // namespace fb
