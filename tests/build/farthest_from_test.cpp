#include "build/farthest_from.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/random.h"

namespace fb {
namespace {

glm::vec2 insideTriangle(glm::vec2 uv) {
    uv = glm::clamp(uv, glm::vec2(0.0f), glm::vec2(1.0f));
    return uv.x + uv.y > 1.0f ? glm::vec2(1.0f) - uv : uv;
}

// The largest distance of the corners and of many random points of `from`, climbing from the best of each
// triangle.
double sampled(const MeasuredSurface& from, const TriangleTree& to, Random& random, int pointsEach) {
    const auto uniform2 = [&] { return glm::vec2(random.uniform(), random.uniform()); };
    float worst = 0.0f;
    for (const TriangleCorners& t : from.tree().triangles()) {
        glm::vec2 best(0.0f);
        float bestDistance = -1.0f;
        const auto look = [&](const glm::vec2& uv) {
            const float distance =
                to.closest(t[0] + uv.x * (t[1] - t[0]) + uv.y * (t[2] - t[0])).squaredDistance;
            if (distance > bestDistance) bestDistance = distance, best = uv;
        };
        for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}) look(corner);
        for (int i = 0; i < pointsEach; ++i) look(insideTriangle(uniform2()));
        float radius = 0.25f;
        for (int i = 0; i < pointsEach; ++i, radius *= 0.95f)
            look(insideTriangle(best + radius * (2.0f * uniform2() - 1.0f)));
        worst = std::max(worst, bestDistance);
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
        triangles.push_back(
            {randomPoint(random, size), randomPoint(random, size), randomPoint(random, size)});
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
    const MeasuredSurface plane =
        surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(900, 0, 0), glm::vec3(0, 900, 0)}});
    const MeasuredSurface raised =
        surfaceOf({{glm::vec3(100, 100, 10), glm::vec3(200, 100, 30), glm::vec3(100, 200, 20)}});
    EXPECT_NEAR(farthestFrom(raised, plane, 0.0), 30.0 * (1.0 + kFarthestRelative), 1e-2);
    EXPECT_NEAR(farthestFrom(raised, plane, 50.0), 50.0, 1e-2);
}

// A ridge between two corners that lie on the plane: no corner of `from` is far, its middle is.
TEST(FarthestFrom, FindsWhatLiesBetweenCorners) {
    const MeasuredSurface flat =
        surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(800, 0, 0), glm::vec3(400, 800, 0)}});
    const MeasuredSurface far =
        surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)},
                   {glm::vec3(800, 0, 0), glm::vec3(799, 0, 0), glm::vec3(799, 1, 0)},
                   {glm::vec3(400, 800, 0), glm::vec3(400, 799, 0), glm::vec3(401, 799, 0)}});
    Random random(1);
    const double truth = sampled(flat, far.tree(), random, 20000);
    EXPECT_GT(truth, 400.0);
    EXPECT_GE(farthestFrom(flat, far, 0.0), truth);
    EXPECT_LE(farthestFrom(flat, far, 0.0), truth * 1.03);
}

TEST(FarthestFrom, IsNothingWhereSurfacesCoincide) {
    const MeasuredSurface fine = terrain(64, 4096.0f, [](float, float) { return 7.0f; });
    const MeasuredSurface coarse = terrain(3, 4096.0f, [](float, float) { return 7.0f; });
    EXPECT_LE(farthestFrom(fine, coarse, 0.0), kFarthestUnits);
    EXPECT_LE(farthestFrom(coarse, fine, 0.0), kFarthestUnits);
}

RC_GTEST_PROP(FarthestFrom, IsNotExceededOnRandomTriangles, (std::uint64_t seed)) {
    Random random(seed);
    const glm::vec3 size(1e6f, random.uniform() < 0.5 ? 1e6f : 1e3f, 1e6f);
    const MeasuredSurface a = soup(random, 1 + random.index(20), size),
                          b = soup(random, 1 + random.index(60), size);
    RC_ASSERT(farthestFrom(a, b, 0.0) + kFarthestUnits >= sampled(a, b.tree(), random, 300));
}

// A roof over a floor, a wall between them: below the roof the nearest face is not the one that the walk
// comes to.
TEST(FarthestFrom, FindsTheNearestOfSeveralLayers) {
    const auto square = [](float x0, float x1, float z) {
        return std::vector<TriangleCorners>{
            {glm::vec3(x0, 0, z), glm::vec3(x1, 0, z), glm::vec3(x1, 1000, z)},
            {glm::vec3(x0, 0, z), glm::vec3(x1, 1000, z), glm::vec3(x0, 1000, z)}};
    };
    std::vector<TriangleCorners> layers = square(0, 1000, 0);
    const std::vector<TriangleCorners> roof = square(400, 1000, 300);
    layers.insert(layers.end(), roof.begin(), roof.end());
    layers.push_back({glm::vec3(400, 0, 0), glm::vec3(400, 1000, 0), glm::vec3(400, 1000, 300)});
    layers.push_back({glm::vec3(400, 0, 0), glm::vec3(400, 1000, 300), glm::vec3(400, 0, 300)});
    // At height 200 the floor is 200 below, the roof 100 above, the wall at x = 400.
    EXPECT_NEAR(farthestFrom(surfaceOf(square(500, 900, 200)), surfaceOf(layers), 0.0), 100.0, 6.1);
    EXPECT_NEAR(farthestFrom(surfaceOf(square(0, 1000, 200)), surfaceOf(layers), 0.0), 200.0, 8.1);
    EXPECT_NEAR(farthestFrom(surfaceOf(square(250, 900, 200)), surfaceOf(layers), 0.0), 150.0, 7.1);
}

TEST(FarthestFrom, LooksPastATriangleFoldedBack) {
    const MeasuredSurface folded =
        surfaceOf({{glm::vec3(0, 0, 0), glm::vec3(1000, 0, 0), glm::vec3(0, 1000, 0)},
                   {glm::vec3(1000, 0, 0), glm::vec3(0, 0, 0), glm::vec3(500, 900, 10)}});
    const MeasuredSurface flat =
        surfaceOf({{glm::vec3(0, 0, 4), glm::vec3(1000, 0, 4), glm::vec3(500, 500, 4)}});
    EXPECT_LE(farthestFrom(flat, folded, 0.0), 4.0 * (1.0 + kFarthestRelative) + 1e-3);
}

// The same hills with many cells and with few.
struct Hills {
    MeasuredSurface fine, coarse;
};

Hills hills(Random& random, double lowest, double highest, double shortest, int fewest) {
    const auto rough = static_cast<float>(random.uniform(lowest, highest)),
               wave = static_cast<float>(random.uniform(1e-5, shortest));
    const auto height = [&](float x, float y) {
        return rough * std::sin(x * wave) * std::cos(y * wave * 1.3f);
    };
    const int few = fewest + static_cast<int>(random.index(8));
    return {terrain(12, 1e5f, height), terrain(few, 1e5f, height)};
}

TEST(FarthestFrom, IsCloseToWhatIsReachedOnHills) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        const auto [fine, coarse] = hills(random, 1e3, 1e4, 2e-4, 1);
        const double most = 1.0 + kFarthestRelative + 0.01;  // what samples miss
        EXPECT_LE(farthestFrom(fine, coarse, 0.0),
                  most * sampled(fine, coarse.tree(), random, 200) + kFarthestUnits);
        EXPECT_LE(farthestFrom(coarse, fine, 0.0),
                  most * sampled(coarse, fine.tree(), random, 400) + kFarthestUnits);
    }
}

RC_GTEST_PROP(FarthestFrom, IsNotExceededOnHills, (std::uint64_t seed)) {
    Random random(seed);
    const auto [fine, coarse] = hills(random, 1.0, 3e4, 1e-3, 2);
    RC_ASSERT(farthestFrom(fine, coarse, 0.0) + kFarthestUnits >= sampled(fine, coarse.tree(), random, 15));
    RC_ASSERT(farthestFrom(coarse, fine, 0.0) + kFarthestUnits >= sampled(coarse, fine.tree(), random, 60));
}

}  // namespace
}  // namespace fb
