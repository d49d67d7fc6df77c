#include "base/camera.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <numbers>

#include "base/random.h"

namespace fb {
namespace {

using V = glm::dvec3;

void expectNear(const V& a, const V& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(Camera, LooksAlongMinusZWithYUpwardWhenItIsNew) {
    const Camera camera;
    expectNear(camera.forward(), V(0, 0, -1));
    expectNear(camera.right(), V(1, 0, 0));
    expectNear(camera.up(), V(0, 1, 0));
    EXPECT_TRUE(isUsable(camera));
}

TEST(LookAt, TurnsTheAxesToTheTargetAndKeepsUpUpward) {
    const Camera camera = lookAt(V(1, 2, 3), V(5, 2, 3), V(0, 1, 0));
    EXPECT_EQ(camera.eye, V(1, 2, 3));
    expectNear(camera.forward(), V(1, 0, 0));
    expectNear(camera.up(), V(0, 1, 0));
    expectNear(camera.right(), V(0, 0, 1));
}

TEST(LookAt, LeansUpBackWhereItIsNotSquareToTheView) {
    const Camera camera = lookAt(V(0), V(0, -1, -1), V(0, 1, 0));
    const double h = std::sqrt(0.5);
    expectNear(camera.forward(), V(0, -h, -h));
    expectNear(camera.up(), V(0, h, -h));
    expectNear(camera.right(), V(1, 0, 0));
}

TEST(LookAt, ChoosesAValidOrientationWhereEyeAndTargetCoincide) {
    const Camera camera = lookAt(V(4, 4, 4), V(4, 4, 4), V(0, 1, 0));
    EXPECT_TRUE(isUsable(camera));
    expectNear(camera.forward(), V(0, 0, -1));
}

TEST(LookAt, KeepsTheDirectionWhereUpIsParallelToItOrNothing) {
    const V directions[] = {V(1, 0, 0), V(-1, 0, 0), V(0, 1, 0), V(0, -1, 0), V(0, 0, 1), V(0, 0, -1)};
    for (const V& d : directions) {
        for (const V& up : {d, -d, V(0.0)}) {
            const Camera camera = lookAt(V(7, 8, 9), V(7, 8, 9) + 3.0 * d, up);
            EXPECT_TRUE(isUsable(camera));
            expectNear(camera.forward(), d);
            EXPECT_NEAR(glm::dot(camera.up(), camera.forward()), 0.0, 1e-12);
        }
    }
}

RC_GTEST_PROP(LookAt, GivesRightHandedUnitAxesThatPointAtTheTarget, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto anywhere = [&](double r) {
        return V(random.uniform(-r, r), random.uniform(-r, r), random.uniform(-r, r));
    };
    const V eye = anywhere(1e4), target = eye + anywhere(100), up = anywhere(1);
    const Camera camera = lookAt(eye, target, up);
    RC_ASSERT(isUsable(camera));
    RC_ASSERT(glm::length(camera.forward() - glm::normalize(target - eye)) < 1e-9);
    RC_ASSERT(glm::length(glm::cross(camera.right(), camera.up()) + camera.forward()) < 1e-9);
    RC_ASSERT(glm::dot(camera.up(), up) > -1e-9);
}

TEST(IsUsable, RefusesEveryNumberThatIsNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (double bad : {nan, inf, -inf}) {
        for (int i = 0; i < 9; ++i) {
            Camera camera;
            double* const numbers[] = {&camera.eye.x,         &camera.eye.y,         &camera.eye.z,
                                       &camera.orientation.x, &camera.orientation.y, &camera.orientation.z,
                                       &camera.orientation.w, &camera.fovyRadians,   &camera.nearMetres};
            *numbers[i] = bad;
            EXPECT_FALSE(isUsable(camera)) << "number " << i << " = " << bad;
        }
    }
}

TEST(IsUsable, RefusesAnOrientationThatDoesNotTurn) {
    Camera camera;
    camera.orientation = glm::dquat(0.0, 0.0, 0.0, 0.0);
    EXPECT_FALSE(isUsable(camera));
    camera.orientation = glm::dquat(1.002, 0.0, 0.0, 0.0);
    EXPECT_FALSE(isUsable(camera));
    camera.orientation = glm::dquat(1.0005, 0.0, 0.0, 0.0);
    EXPECT_TRUE(isUsable(camera));
}

TEST(IsUsable, RefusesAnglesOfViewOfNothingOrOfHalfATurnAndMore) {
    Camera camera;
    for (double angle : {0.0, -1.0, std::numbers::pi, 4.0}) {
        camera.fovyRadians = angle;
        EXPECT_FALSE(isUsable(camera)) << angle;
    }
    camera.fovyRadians = 3.0;
    EXPECT_TRUE(isUsable(camera));
    camera.nearMetres = 0.0;
    EXPECT_FALSE(isUsable(camera));
}

}  // namespace
}  // namespace fb
