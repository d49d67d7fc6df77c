#include "app/fly_camera.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

constexpr double kTiny = 1e-9;

FlyCamera levelCamera() {
    FlyCamera c;
    c.camera = lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0, 0, 0), c.up);
    c.speedMetresPerSecond = 2.0;
    return c;
}

TEST(FlyCamera, MovesForwardAtItsSpeed) {
    FlyCamera c = levelCamera();
    EXPECT_TRUE(fly(c, {.move = {0, 0, 1}}, 0.5));
    EXPECT_NEAR(glm::length(c.camera.eye - glm::dvec3(0, 0, 9)), 0.0, kTiny);
    EXPECT_NEAR(glm::length(c.velocity - glm::dvec3(0, 0, -2)), 0.0, kTiny);
}

TEST(FlyCamera, RestsWithoutInput) {
    FlyCamera c = levelCamera();
    EXPECT_FALSE(fly(c, {}, 0.5));
    EXPECT_EQ(c.camera.eye, glm::dvec3(0, 0, 10));
    EXPECT_EQ(c.velocity, glm::dvec3(0.0));
}

TEST(FlyCamera, LookingRightKeepsTheHorizonLevel) {
    FlyCamera c = levelCamera();
    fly(c, {.look = {0.7, 0.4}}, 0.1);
    EXPECT_NEAR(glm::dot(c.camera.right(), c.up), 0.0, kTiny);
    EXPECT_GT(c.camera.forward().x, 0.5);
    EXPECT_NEAR(std::asin(c.camera.forward().y), 0.4, 1e-6);
}

TEST(FlyCamera, NeverTurnsOverWhenLookingUp) {
    FlyCamera c = levelCamera();
    for (int i = 0; i < 100; ++i) fly(c, {.look = {0.0, 0.2}}, 0.1);
    EXPECT_GT(c.camera.up().y, 0.0);
    EXPECT_GT(c.camera.forward().y, 0.99);
}

TEST(FlyCamera, RollsClockwiseAroundTheWayItLooks) {
    FlyCamera c = levelCamera();
    fly(c, {.roll = 0.5}, 0.1);
    EXPECT_NEAR(glm::length(c.camera.forward() - glm::dvec3(0, 0, -1)), 0.0, kTiny);
    EXPECT_NEAR(c.camera.up().x, std::sin(0.5), kTiny);
}

TEST(FlyCamera, OrbitKeepsTheDistanceToThePivot) {
    FlyCamera c = levelCamera();
    fly(c, {.orbit = {1.0, -0.3}}, 0.1);
    EXPECT_NEAR(glm::length(c.camera.eye - c.pivot), 10.0, 1e-6);
    EXPECT_NEAR(glm::dot(glm::normalize(c.pivot - c.camera.eye), c.camera.forward()), 1.0, 1e-6);
}

TEST(FlyCamera, TheWheelChangesTheSpeedWithinItsLimits) {
    FlyCamera c = levelCamera();
    fly(c, {.wheel = 1.0}, 0.1);
    EXPECT_DOUBLE_EQ(c.speedMetresPerSecond, 2.5);
    for (int i = 0; i < 1000; ++i) fly(c, {.wheel = -5.0}, 0.1);
    EXPECT_GT(c.speedMetresPerSecond, 0.0);
}

TEST(FlyCamera, FramingShowsTheWholeBoxForEitherUpAxis) {
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        FlyCamera c;
        c.up = up;
        const Box3d box{glm::dvec3(-3, -2, 5), glm::dvec3(8, 4, 9)};
        frameBounds(c, box);
        EXPECT_GT(glm::dot(c.camera.eye - box.centre(), up), 0.0);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                               corner & 4 ? box.max.z : box.min.z);
            const double angle = std::acos(glm::dot(glm::normalize(p - c.camera.eye), c.camera.forward()));
            EXPECT_LT(angle, 0.5 * c.camera.fovyRadians + 1e-6);
        }
    }
}

}  // namespace
}  // namespace fb
