#include "select/view.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "worlds/tiny_worlds.h"

namespace fb {
namespace {

using V = glm::dvec3;

Box3f pointBox(float x, float y, float z) {
    return boxOf({x, y, z}, {x, y, z});
}

TEST(MakeView, KnowsHowManyPixelsAMetreOneMetreAwayTakes) {
    EXPECT_NEAR(tinyView().pixelsPerUnit, 50.0, 1e-12);  // 100 pixels see 2 m
    Camera camera;                                       // 60 degrees: 720 / 2 / tan 30 = 360 * sqrt 3
    EXPECT_NEAR(makeView(camera, V(0), 1280, 720).pixelsPerUnit, 623.5382907247958, 1e-9);
}

TEST(MakeView, PlanesPointInwardAndHaveUnitLength) {
    const View view = makeView(lookAt(V(3, 4, 5), V(-6, 2, 1), V(0, 1, 0)), V(0), 300, 200);
    const V inside = view.camera.eye + 7.0 * view.forward;
    for (const glm::dvec4& plane : view.planes) {
        EXPECT_NEAR(glm::length(V(plane)), 1.0, 1e-12);
        EXPECT_GT(glm::dot(V(plane), inside) + plane.w, 0.0);
    }
}

TEST(MakeView, TakesAWindowOfNoPixelsForOnePixel) {
    const View view = makeView(tinyCamera(), V(0), 0, 0);
    EXPECT_EQ(view.width, 1);
    EXPECT_EQ(view.height, 1);
    EXPECT_TRUE(meetsView(view, ahead()));
    EXPECT_FALSE(meetsView(view, behind()));
}

TEST(OutsideDistance, IsZeroForWhatIsAheadAndForABoxAroundTheEye) {
    EXPECT_EQ(outsideDistance(tinyView(), ahead()), 0.0);
    EXPECT_EQ(outsideDistance(tinyView(), boxOf({-1, -1, -1}, {1, 1, 1})), 0.0);
    EXPECT_EQ(outsideDistance(tinyView(), boxOf({-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f})), 0.0);
}

TEST(OutsideDistance, IsTheDistanceToTheNearPlaneForWhatIsBehindOrTooNear) {
    EXPECT_NEAR(outsideDistance(tinyView(), behind()), 1.05, 1e-12);
    EXPECT_NEAR(outsideDistance(tinyView(), pointBox(0, 0, 8)), 8.05, 1e-12);
    EXPECT_NEAR(outsideDistance(tinyView(), pointBox(0, 0, -0.03125f)), 0.05 - 0.03125, 1e-12);
}

TEST(OutsideDistance, IsTheDistanceToTheSidePlanesOfAxisAlignedCameras) {
    const double root = std::sqrt(2.0);
    EXPECT_NEAR(outsideDistance(tinyView(), aside()), 98.0 / root, 1e-12);
    for (float sign : {-1.0f, 1.0f}) {
        EXPECT_NEAR(outsideDistance(tinyView(), pointBox(sign * 5, 0, -3)), 2.0 / root, 1e-12);
        EXPECT_NEAR(outsideDistance(tinyView(), pointBox(0, sign * 5, -3)), 2.0 / root, 1e-12);
    }
    // A window twice as wide sees to x = 2 z: the plane's normal is (-1, 0, -2) / sqrt 5.
    const View wide = makeView(tinyCamera(), V(0), 200, 100);
    EXPECT_NEAR(outsideDistance(wide, pointBox(3, 0, -1)), 1.0 / std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(outsideDistance(wide, pointBox(0, 3, -1)), 2.0 / root, 1e-12);
    // Looking along +x from (10, 0, 0): z is to the right.
    const View turned = makeView(
        [] {
            Camera camera = lookAt(V(10, 0, 0), V(11, 0, 0), V(0, 1, 0));
            camera.fovyRadians = tinyCamera().fovyRadians;
            return camera;
        }(),
        V(0), 100, 100);
    EXPECT_NEAR(outsideDistance(turned, pointBox(13, 0, 5)), 2.0 / root, 1e-12);
    EXPECT_NEAR(outsideDistance(turned, pointBox(8, 0, 0)), 2.05, 1e-12);
    EXPECT_EQ(outsideDistance(turned, pointBox(13, 0, 2)), 0.0);
}

TEST(OutsideDistance, TakesTheLargestOfSeveralPlanes) {
    // Behind the near plane by 1.05 and beside the right one by (6 + 1) / sqrt 2.
    EXPECT_NEAR(outsideDistance(tinyView(), pointBox(6, 0, 1)), 7.0 / std::sqrt(2.0), 1e-12);
}

TEST(OutsideDistance, IsNeverZeroForABoxBehindAPlaneByALittle) {
    EXPECT_EQ(outsideDistance(tinyView(), pointBox(1.0f, 0, -1.0000001f)), 0.0);
    EXPECT_GT(outsideDistance(tinyView(), pointBox(1.0000001f, 0, -1)), 0.0);
}

TEST(OutsideDistance, IsTheSameTenKilometresFromTheOrigin) {
    Camera far = tinyCamera();
    far.eye = V(10000, -20000, 30000);
    const View farView = makeView(far, V(0), 100, 100);
    for (Box3f box : {ahead(), aside(), behind()}) {
        const double near = outsideDistance(tinyView(), box);
        const glm::vec3 shift(10000, -20000, 30000);
        EXPECT_NEAR(outsideDistance(farView, {box.min + shift, box.max + shift}), near, 1e-9);
    }
}

// The same question asked in the camera's own axes, with slopes instead of planes.
double outsideBySlopes(const View& view, const std::vector<V>& points) {
    const double tanY = std::tan(0.5 * view.camera.fovyRadians);
    const double tanX = tanY * view.width / view.height;
    double nearest[5] = {1e300, 1e300, 1e300, 1e300, 1e300};
    for (const V& p : points) {
        const V c = glm::inverse(view.camera.orientation) * (p - view.camera.eye);
        const double depth = -c.z;
        const double outside[5] = {
            (-c.x - depth * tanX) / std::hypot(1.0, tanX), (c.x - depth * tanX) / std::hypot(1.0, tanX),
            (-c.y - depth * tanY) / std::hypot(1.0, tanY), (c.y - depth * tanY) / std::hypot(1.0, tanY),
            view.camera.nearMetres - depth};
        for (int i = 0; i < 5; ++i) nearest[i] = std::min(nearest[i], outside[i]);
    }
    return std::max(0.0, *std::max_element(nearest, nearest + 5));
}

struct Guess {
    View view;
    Box3f box;
    Random random;
};

Guess anyViewAndBox(std::uint64_t seed) {
    Random r(seed);
    const auto at = [&](double s) { return V(r.uniform(-s, s), r.uniform(-s, s), r.uniform(-s, s)); };
    Camera camera = lookAt(at(20), at(20), at(1));
    camera.fovyRadians = r.uniform(0.2, 2.6);
    camera.nearMetres = r.uniform(0.01, 2.0);
    const int width = 1 + static_cast<int>(r.index(2000)), height = 1 + static_cast<int>(r.index(2000));
    const glm::vec3 low(at(20)), size(glm::abs(at(10)));
    return {makeView(camera, V(0), width, height), {low, low + size}, r};
}

std::vector<V> samplesOf(const Box3f& box, Random& random, int count) {
    std::vector<V> points;
    for (int i = 0; i < 8; ++i) {
        points.emplace_back(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                            i & 4 ? box.max.z : box.min.z);
    }
    for (int i = 0; i < count; ++i) {
        points.emplace_back(random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y),
                            random.uniform(box.min.z, box.max.z));
    }
    return points;
}

RC_GTEST_PROP(OutsideDistance, AgreesWithSamplesOfTheBoxInCameraAxes, ()) {
    Guess g = anyViewAndBox(*rc::gen::arbitrary<std::uint64_t>());
    const double slow = outsideBySlopes(g.view, samplesOf(g.box, g.random, 100));
    RC_ASSERT(std::abs(outsideDistance(g.view, g.box) - slow) < 1e-9);
}

RC_GTEST_PROP(OutsideDistance, IsNeverMoreThanTheWayFromTheBoxToAPointInView, ()) {
    Guess g = anyViewAndBox(*rc::gen::arbitrary<std::uint64_t>());
    const double outside = outsideDistance(g.view, g.box);
    const Box3d box{V(g.box.min), V(g.box.max)};
    const double tanY = std::tan(0.5 * g.view.camera.fovyRadians);
    const double tanX = tanY * g.view.width / g.view.height;
    for (int i = 0; i < 100; ++i) {
        const double depth = g.view.camera.nearMetres + g.random.uniform(0.0, 40.0);
        const V inView(g.random.uniform(-1, 1) * depth * tanX, g.random.uniform(-1, 1) * depth * tanY,
                       -depth);
        const V point = g.view.camera.eye + g.view.camera.orientation * inView;
        RC_ASSERT(box.distance(point) >= outside - 1e-9);
    }
}

}  // namespace
}  // namespace fb
