#include "measure/camera_path.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <limits>

#include "measure/sin_cos_turns.h"
#include "measure/slerp_by_halving.h"

namespace fb {
namespace {

PathKey keyAt(double seconds, const glm::dvec3& eye, bool cut = false) {
    PathKey key;
    key.timeSeconds = seconds;
    key.camera.eye = eye;
    key.cut = cut;
    return key;
}

double difference(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b);
}

TEST(CameraPath, PassesThroughItsKeysAtTheirTimes) {
    const CameraPath path{
        "", {keyAt(1, {0, 0, 0}), keyAt(2, {1, 5, 0}), keyAt(4, {2, 0, -3}), keyAt(4.5, {9, 0, 0})}};
    for (const PathKey& key : path.keys) {
        EXPECT_LT(difference(path.at(key.timeSeconds).eye, key.camera.eye), 1e-12);
        EXPECT_LT(difference(path.at(key.timeSeconds - 1e-9).eye, key.camera.eye), 1e-6);
    }
}

TEST(CameraPath, RestsBeforeTheFirstKeyAndAfterTheLast) {
    const CameraPath path{"", {keyAt(1, {1, 2, 3}), keyAt(2, {4, 5, 6})}};
    for (double t : {-1e9, 0.0, 0.999}) {
        EXPECT_EQ(path.at(t).eye, glm::dvec3(1, 2, 3));
        EXPECT_EQ(path.velocityAt(t), glm::dvec3(0.0));
    }
    for (double t : {2.0, 3.0, 1e9}) {
        EXPECT_EQ(path.at(t).eye, glm::dvec3(4, 5, 6));
        EXPECT_EQ(path.velocityAt(t), glm::dvec3(0.0));
    }
    EXPECT_EQ(path.at(std::numeric_limits<double>::quiet_NaN()).eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(path.velocityAt(std::numeric_limits<double>::quiet_NaN()), glm::dvec3(0.0));
}

TEST(CameraPath, WithoutKeysIsTheDefaultCamera) {
    const CameraPath path;
    EXPECT_EQ(path.at(1.0).eye, glm::dvec3(0.0));
    EXPECT_EQ(path.velocityAt(1.0), glm::dvec3(0.0));
    EXPECT_EQ(path.durationSeconds(), 0.0);
}

TEST(CameraPath, MovesEvenlyAlongEvenKeysOnALine) {
    const CameraPath path{
        "", {keyAt(0, {0, 0, 0}), keyAt(1, {2, 0, 0}), keyAt(2, {4, 0, 0}), keyAt(3, {6, 0, 0})}};
    for (double t = 0.0; t < 3.0; t += 0.125) {
        EXPECT_LT(difference(path.at(t).eye, {2.0 * t, 0, 0}), 1e-12) << t;
        EXPECT_LT(difference(path.velocityAt(t), {2, 0, 0}), 1e-12) << t;
    }
}

// Barry and Goldman's pyramid for the spline through p[0..3] with knots s[0..3], between s[1] and s[2].
glm::dvec3 pyramid(const glm::dvec3 (&p)[4], const double (&s)[4], double x) {
    const auto mix = [x](const glm::dvec3& a, double sa, const glm::dvec3& b, double sb) {
        return a * ((sb - x) / (sb - sa)) + b * ((x - sa) / (sb - sa));
    };
    const glm::dvec3 a1 = mix(p[0], s[0], p[1], s[1]), a2 = mix(p[1], s[1], p[2], s[2]),
                     a3 = mix(p[2], s[2], p[3], s[3]);
    return mix(mix(a1, s[0], a2, s[2]), s[1], mix(a2, s[1], a3, s[3]), s[2]);
}

// Distances 4, 4, 4 in a zigzag: knots 2 apart, all alike, so that time runs evenly through them.
TEST(CameraPath, IsTheCentripetalSplineOfTheKeys) {
    const glm::dvec3 p[4] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 4, 4}};
    const double knots[4] = {0, 2, 4, 6};
    const CameraPath path{"", {keyAt(0, p[0]), keyAt(1, p[1]), keyAt(2, p[2]), keyAt(3, p[3])}};
    for (double u : {0.0, 0.1, 0.25, 0.5, 0.9}) {
        EXPECT_LT(difference(path.at(1.0 + u).eye, pyramid(p, knots, 2.0 + 2.0 * u)), 1e-12) << u;
    }
}

// Distances 1, 9, 1: knots 1, 3, 1 apart. In the middle of the middle segment time and knots are both
// halfway.
TEST(CameraPath, SpacesKnotsByTheRootOfTheDistance) {
    const glm::dvec3 p[4] = {{0, 0, 0}, {0, 1, 0}, {9, 1, 0}, {9, 0, 0}};
    const double knots[4] = {0, 1, 4, 5};
    const CameraPath path{"", {keyAt(0, p[0]), keyAt(1, p[1]), keyAt(2, p[2]), keyAt(3, p[3])}};
    EXPECT_LT(difference(path.at(1.5).eye, pyramid(p, knots, 2.5)), 1e-12);
}

TEST(CameraPath, RestsFromTheKeyBeforeACutUntilTheCut) {
    const CameraPath path{
        "", {keyAt(0, {0, 0, 0}), keyAt(1, {1, 0, 0}), keyAt(2, {50, 0, 0}, true), keyAt(3, {52, 0, 0})}};
    for (double t : {1.0, 1.5, 1.999999}) {
        EXPECT_EQ(path.at(t).eye, glm::dvec3(1, 0, 0)) << t;
        EXPECT_EQ(path.velocityAt(t), glm::dvec3(0.0)) << t;
    }
    EXPECT_EQ(path.at(2.0).eye, glm::dvec3(50, 0, 0));
    EXPECT_EQ(path.velocityAt(2.0), glm::dvec3(0.0));
    // Neither side of the cut bends towards the other.
    EXPECT_LT(difference(path.velocityAt(0.75), {1, 0, 0}), 1e-12);
    EXPECT_LT(difference(path.velocityAt(2.25), {2, 0, 0}), 1e-12);
}

TEST(CameraPath, ComesToRestWhereAKeyIsRepeated) {
    const CameraPath path{
        "", {keyAt(0, {0, 0, 0}), keyAt(1, {3, 0, 0}), keyAt(2, {3, 0, 0}), keyAt(3, {3, 4, 0})}};
    EXPECT_LT(glm::length(path.velocityAt(1.0 - 1e-7)), 1e-5);
    for (double t : {1.0, 1.3, 1.9}) {
        EXPECT_EQ(path.at(t).eye, glm::dvec3(3, 0, 0));
        EXPECT_EQ(path.velocityAt(t), glm::dvec3(0.0));
    }
    EXPECT_LT(glm::length(path.velocityAt(2.0 + 1e-7)), 1e-5);
    EXPECT_LT(difference(path.at(2.5).eye, {3, 2, 0}), 0.8);
}

TEST(CameraPath, InterpolatesFieldOfViewAndNearPlane) {
    CameraPath path{"", {keyAt(0, {0, 0, 0}), keyAt(4, {1, 0, 0})}};
    path.keys[0].camera.fovyRadians = 1.0;
    path.keys[1].camera.fovyRadians = 2.0;
    path.keys[0].camera.nearMetres = 0.1;
    path.keys[1].camera.nearMetres = 0.5;
    EXPECT_DOUBLE_EQ(path.at(1.0).fovyRadians, 1.25);
    EXPECT_DOUBLE_EQ(path.at(1.0).nearMetres, 0.2);
}

TEST(CameraPath, TurnsTheShortWayAtAnEvenRate) {
    CameraPath path{"", {keyAt(0, {0, 0, 0}), keyAt(3, {1, 0, 0})}};
    // 90 degrees about y, given with the sign that would make the arc long.
    path.keys[1].camera.orientation = -glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0));
    const glm::dvec3 third = glm::angleAxis(glm::radians(30.0), glm::dvec3(0, 1, 0)) * glm::dvec3(0, 0, -1);
    EXPECT_LT(difference(path.at(1.0).forward(), third), 1e-9);
}

// 3 to 8 keys, uneven times and places, some repeated, some cuts.
CameraPath anyPath() {
    CameraPath path;
    double time = 0.0;
    const int count = *rc::gen::inRange(3, 9);
    for (int i = 0; i < count; ++i) {
        const auto number = [] { return *rc::gen::inRange(-1000, 1000) / 10.0; };
        PathKey key = keyAt(time, {number(), number(), number()}, i > 0 && *rc::gen::inRange(0, 6) == 0);
        if (i > 0 && *rc::gen::inRange(0, 6) == 0) key.camera.eye = path.keys.back().camera.eye;
        path.keys.push_back(key);
        time += *rc::gen::inRange(1, 400) / 100.0;
    }
    return path;
}

RC_GTEST_PROP(CameraPath, HasTheVelocityOfItsMotion, ()) {
    const CameraPath path = anyPath();
    for (std::size_t i = 1; i < path.keys.size(); ++i) {
        const double from = path.keys[i - 1].timeSeconds, length = path.keys[i].timeSeconds - from;
        for (double u : {0.1, 0.37, 0.5, 0.83}) {
            const double t = from + u * length, h = 1e-5 * length;
            const glm::dvec3 slope = (path.at(t + h).eye - path.at(t - h).eye) / (2.0 * h);
            RC_ASSERT(difference(path.velocityAt(t), slope) <= 1e-5 * (1.0 + 200.0 / length));
        }
    }
}

RC_GTEST_PROP(CameraPath, HasNoJumpsInSpeedAtKeysThatAreNoCuts, ()) {
    const CameraPath path = anyPath();
    for (std::size_t i = 1; i + 1 < path.keys.size(); ++i) {
        if (path.keys[i].cut || path.keys[i + 1].cut) continue;
        const double t = path.keys[i].timeSeconds;
        RC_ASSERT(difference(path.velocityAt(t - 1e-9), path.velocityAt(t + 1e-9)) < 1e-2);
    }
}

TEST(SinCosTurns, AgreesWithTheLibrary) {
    for (int i = -2000; i <= 2000; ++i) {
        const double turns = i / 777.0, radians = 2.0 * std::numbers::pi * turns;
        const glm::dvec2 point = circlePoint(turns);
        EXPECT_NEAR(point.x, std::cos(radians), 4e-15) << turns;
        EXPECT_NEAR(point.y, std::sin(radians), 4e-15) << turns;
        EXPECT_NEAR(turnsOf(point * 3.5) - turns - std::round(turnsOf(point * 3.5) - turns), 0.0, 1e-15)
            << turns;
    }
}

TEST(SinCosTurns, IsExactAtQuarterTurns) {
    EXPECT_EQ(circlePoint(0.0), glm::dvec2(1, 0));
    EXPECT_EQ(circlePoint(0.25), glm::dvec2(0, 1));
    EXPECT_EQ(circlePoint(-0.5), glm::dvec2(-1, 0));
    EXPECT_EQ(circlePoint(7.75), glm::dvec2(0, -1));
    EXPECT_EQ(turnsOf({0.0, -2.0}), -0.25);
}

glm::dquat anyRotation() {
    const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const glm::dquat q(number(), number(), number(), number() + 1e-3);
    return glm::normalize(q);
}

RC_GTEST_PROP(SlerpByHalving, AgreesWithTheFormulaWithSines, ()) {
    const glm::dquat a = anyRotation(), b = anyRotation();
    const double t = *rc::gen::inRange(0, 1001) / 1000.0;
    const glm::dquat got = slerpByHalving(a, b, t), want = glm::slerp(a, b, t);
    RC_ASSERT(std::abs(std::abs(glm::dot(got, want)) - 1.0) < 1e-14);
    // 1 - dot is half the squared angle: compare the parts too.
    const glm::dquat aligned = glm::dot(got, want) < 0.0 ? -got : got;
    RC_ASSERT(glm::length(aligned - want) < 2e-10);
}

}  // namespace
}  // namespace fb
