#include "measure/built_in_path.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

namespace fb {
namespace {

SceneInfo sceneOf(const glm::dvec3& low, const glm::dvec3& high, UpAxis up = UpAxis::y) {
    SceneInfo scene;
    scene.bounds = {low, high};
    scene.up = up;
    return scene;
}

// A street of 60 m to the east and one of 60 m to the south, in a scene of 200 m.
SceneInfo streetScene() {
    SceneInfo scene = sceneOf({-100, -1, -100}, {100, 24, 100});
    scene.walks.push_back({{{0, 0.5, 0}, {60, 0.5, 0}, {60, 0.5, 60}}});
    return scene;
}

CameraPath pathOf(std::string_view name, const SceneInfo& scene) {
    Result<CameraPath> path = loadPath(name, scene);
    EXPECT_TRUE(path.has_value()) << name;
    return path ? *path : CameraPath{};
}

double difference(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b);
}

// Whether the picture of the given shape holds the point.
bool sees(const Camera& camera, const glm::dvec3& point, double aspect) {
    const glm::dvec3 seen = glm::inverse(camera.orientation) * (point - camera.eye);
    const double half = std::tan(camera.fovyRadians / 2.0);
    return seen.z < 0.0 && std::abs(seen.y) <= -seen.z * half && std::abs(seen.x) <= -seen.z * half * aspect;
}

bool seesAll(const Camera& camera, const Box3d& box, double aspect) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        if (!sees(camera, p, aspect)) return false;
    }
    return true;
}

TEST(BuiltInPath, NamesAreThoseOfTheDesign) {
    EXPECT_EQ(builtInPathNames(), (std::vector<std::string_view>{"still", "walk", "drive", "fly",
                                                                 "walk-to-fly", "shake", "jump"}));
}

TEST(BuiltInPath, EachLastsThirtySecondsWithAFieldOfViewOf60Degrees) {
    for (const SceneInfo& scene : {streetScene(), sceneOf({0, 0, 0}, {1, 2, 3})}) {
        for (std::string_view name : builtInPathNames()) {
            const CameraPath path = pathOf(name, scene);
            EXPECT_EQ(path.name, name);
            ASSERT_FALSE(path.keys.empty());
            EXPECT_EQ(path.keys.front().timeSeconds, 0.0) << name;
            EXPECT_DOUBLE_EQ(path.durationSeconds(), 30.0) << name;
            for (const PathKey& key : path.keys) EXPECT_DOUBLE_EQ(key.camera.fovyRadians, glm::radians(60.0));
        }
    }
}

// The hint is straight for 60 m, the walk covers 42: key k lies at 0.35 k metres.
TEST(BuiltInPath, WalkFollowsTheHintAtEyeHeightAndWalkingSpeed) {
    const CameraPath walk = pathOf("walk", streetScene());
    ASSERT_EQ(walk.keys.size(), 121u);
    for (int k = 0; k <= 120; ++k) {
        EXPECT_LT(difference(walk.keys[std::size_t(k)].camera.eye, {0.35 * k, 2.2, 0}), 1e-9) << k;
    }
    for (double t = 0.1; t < 29.9; t += 0.7) {
        EXPECT_LT(difference(walk.velocityAt(t), {1.4, 0, 0}), 1e-5) << t;
    }
}

TEST(BuiltInPath, WalkLooksAheadAndTurnsTheHeadGently) {
    const CameraPath walk = pathOf("walk", streetScene());
    double furthest = 0.0;
    for (double t = 0.0; t <= 30.0; t += 1.0 / 30.0) {
        const glm::dvec3 forward = walk.at(t).forward(), next = walk.at(t + 1.0 / 30.0).forward();
        furthest = std::max(furthest, std::acos(std::min(1.0, forward.x)));
        EXPECT_LT(glm::degrees(std::acos(std::min(1.0, glm::dot(forward, next)))) * 30.0, 15.0)
            << t;                                              // degrees/s
        EXPECT_LT(std::abs(walk.at(t).right().y), 1e-4) << t;  // no roll
    }
    EXPECT_NEAR(glm::degrees(furthest), 15.0, 1.0);
}

TEST(BuiltInPath, DriveIsTheWalkAtTenTimesTheSpeed) {
    for (const SceneInfo& scene : {streetScene(), sceneOf({-3, -3, 0}, {3, 3, 5}, UpAxis::z)}) {
        const CameraPath walk = pathOf("walk", scene), drive = pathOf("drive", scene);
        // The walk's last step has no key behind it; up to there both are one curve.
        for (double t = 0.0; t < 29.75; t += 0.173) {
            const Camera slow = walk.at(t), fast = drive.at(t / 10.0);
            EXPECT_LT(difference(slow.eye, fast.eye), 1e-9) << t;
            EXPECT_LT(difference(slow.forward(), fast.forward()), 1e-9) << t;
            EXPECT_LT(difference(walk.velocityAt(t) * 10.0, drive.velocityAt(t / 10.0)), 1e-8) << t;
        }
    }
}

TEST(BuiltInPath, DriveGoesBackAndForthWhereTheStreetIsShort) {
    const CameraPath drive = pathOf("drive", streetScene());
    // 14 m/s: after 20 s 280 m of a way of 120 m, so 40 m from the start again.
    EXPECT_LT(difference(drive.at(20.0).eye, {40, 2.2, 0}), 1e-6);
    EXPECT_LT(difference(drive.velocityAt(20.0), {14, 0, 0}), 1e-3);
}

TEST(BuiltInPath, FlySeesTheWholeSceneAtFirstAndCrossesCloseAboveIt) {
    for (UpAxis up : {UpAxis::y, UpAxis::z}) {
        const SceneInfo scene = sceneOf({-100, -80, -10}, {100, 120, 15}, up);
        const CameraPath fly = pathOf("fly", scene);
        EXPECT_TRUE(seesAll(fly.at(0.0), scene.bounds, 4.0 / 3.0));
        EXPECT_TRUE(seesAll(fly.at(15.0), scene.bounds, 1.0));
        EXPECT_FALSE(seesAll(fly.at(7.5), scene.bounds, 16.0 / 9.0));
        const double top = up == UpAxis::y ? scene.bounds.max.y : scene.bounds.max.z;
        for (double t = 0.0; t <= 30.0; t += 0.25) {
            const glm::dvec3 eye = fly.at(t).eye, down = -scene.upVector();
            EXPECT_GT(glm::dot(eye, scene.upVector()), top);
            EXPECT_GT(glm::dot(fly.at(t).forward(), down), 0.3) << t;  // obliquely
            EXPECT_LT(glm::dot(fly.at(t).forward(), down), 0.95) << t;
        }
    }
}

TEST(BuiltInPath, WalkToFlyBeginsAsTheWalkAndEndsWithTheWholeSceneInView) {
    for (const SceneInfo& scene : {streetScene(), sceneOf({0, 0, 0}, {2, 5, 1})}) {
        const CameraPath walk = pathOf("walk", scene), path = pathOf("walk-to-fly", scene);
        for (double t = 0.0; t < 7.75; t += 0.21) {
            EXPECT_LT(difference(path.at(t).eye, walk.at(t).eye), 1e-6) << t;
            EXPECT_LT(difference(path.at(t).forward(), walk.at(t).forward()), 1e-6) << t;
        }
        EXPECT_TRUE(seesAll(path.at(30.0), scene.bounds, 4.0 / 3.0));
        double height = path.at(8.0).eye.y;
        for (double t = 8.5; t <= 20.0; t += 0.5) {
            EXPECT_GT(path.at(t).eye.y, height) << t;
            height = path.at(t).eye.y;
        }
        // The way back does not begin below the roofs.
        EXPECT_GT(path.at(16.0).eye.y, scene.bounds.max.y);
    }
}

TEST(BuiltInPath, ShakeStaysWithinAFewDecimetres) {
    const CameraPath shake = pathOf("shake", streetScene());
    const Camera rest = shake.at(0.0);
    double reach = 0.0, turn = 0.0;
    int reversals = 0;
    for (double t = 0.0; t < 30.0; t += 1.0 / 30.0) {
        reach = std::max(reach, difference(shake.at(t).eye, rest.eye));
        turn = std::max(
            turn, glm::degrees(std::acos(std::min(1.0, glm::dot(shake.at(t).forward(), rest.forward())))));
        const double before = glm::dot(shake.velocityAt(t), rest.right());
        const double after = glm::dot(shake.velocityAt(t + 1.0 / 30.0), rest.right());
        reversals += before * after < 0.0 ? 1 : 0;
    }
    EXPECT_GT(reach, 0.25);
    EXPECT_LT(reach, 0.36);
    EXPECT_NEAR(turn, 3.0, 0.05);
    EXPECT_NEAR(reversals, 2 * 1.25 * 30, 2);  // 1.25 Hz to the side
}

TEST(BuiltInPath, StillRests) {
    for (const SceneInfo& scene : {streetScene(), sceneOf({0, 0, 0}, {1, 1, 1})}) {
        const CameraPath still = pathOf("still", scene);
        for (double t = -1.0; t < 32.0; t += 0.5) {
            EXPECT_EQ(still.at(t).eye, still.at(0.0).eye);
            EXPECT_EQ(still.velocityAt(t), glm::dvec3(0.0));
        }
    }
    EXPECT_TRUE(
        seesAll(pathOf("still", sceneOf({0, 0, 0}, {1, 1, 1})).at(0.0), {glm::dvec3(0), glm::dvec3(1)}, 1.0));
}

TEST(BuiltInPath, JumpCutsEveryTwoSecondsBetweenDistantViews) {
    for (const SceneInfo& scene : {streetScene(), sceneOf({0, 0, 0}, {2, 3, 2})}) {
        const CameraPath jump = pathOf("jump", scene);
        ASSERT_EQ(jump.keys.size(), 16u);
        for (std::size_t k = 1; k < 15; ++k) {
            EXPECT_TRUE(jump.keys[k].cut);
            EXPECT_DOUBLE_EQ(jump.keys[k].timeSeconds, 2.0 * double(k));
            EXPECT_EQ(jump.at(2.0 * double(k) - 0.01).eye, jump.keys[k - 1].camera.eye);
            EXPECT_GT(difference(jump.keys[k].camera.eye, jump.keys[k - 1].camera.eye),
                      0.1 * scene.bounds.diagonal());
        }
        for (double t = 0.0; t < 30.0; t += 0.1) EXPECT_EQ(jump.velocityAt(t), glm::dvec3(0.0));
    }
}

TEST(BuiltInPath, IgnoresAHintThatIsNoWay) {
    SceneInfo scene = sceneOf({0, 0, 0}, {10, 10, 10});
    const CameraPath without = pathOf("walk", scene);
    scene.walks.push_back({{{1, 0, 1}}});
    EXPECT_EQ(pathOf("walk", scene).keys[7].camera.eye, without.keys[7].camera.eye);
}

TEST(BuiltInPath, TakesAnEmptyOrBrokenBoxForOneOfAMetre) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const CameraPath unit = pathOf("fly", sceneOf(glm::dvec3(-0.5), glm::dvec3(0.5)));
    for (const Box3d& box :
         {Box3d{}, Box3d{glm::dvec3(nan), glm::dvec3(nan)}, Box3d{glm::dvec3(3), glm::dvec3(3)},
          Box3d{glm::dvec3(-1e300), glm::dvec3(1e300)}}) {
        SceneInfo scene;
        scene.bounds = box;
        EXPECT_EQ(pathOf("fly", scene).keys[5].camera.eye, unit.keys[5].camera.eye);
    }
}

// A millimetre to a hundred kilometres, as flat or thin as it comes, anywhere, either axis up.
SceneInfo anyScene() {
    const double size = std::pow(10.0, *rc::gen::inRange(-30, 51) / 10.0);
    const auto part = [&] { return size * std::pow(10.0, -*rc::gen::inRange(0, 30) / 10.0); };
    const auto place = [&] { return size * *rc::gen::inRange(-100, 101) / 10.0; };
    const glm::dvec3 low(place(), place(), place());
    return sceneOf(low, low + glm::dvec3(part(), part(), part()), *rc::gen::element(UpAxis::y, UpAxis::z));
}

RC_GTEST_PROP(BuiltInPath, GivesUsableKeysInRisingOrderForAnyScene, ()) {
    const SceneInfo scene = anyScene();
    for (std::string_view name : builtInPathNames()) {
        const CameraPath path = *loadPath(name, scene);
        for (std::size_t k = 0; k < path.keys.size(); ++k) {
            RC_ASSERT(isUsable(path.keys[k].camera));
            RC_ASSERT((k == 0 ||
                       path.keys[k].timeSeconds > path.keys[k - 1].timeSeconds));  // RC_ASSERT overloads ||
            RC_ASSERT(path.keys[k].camera.nearMetres <= 0.001 * scene.bounds.diagonal());
        }
    }
}

RC_GTEST_PROP(BuiltInPath, StaysOutsideAnySceneWithoutHints, ()) {
    const SceneInfo scene = anyScene();
    for (std::string_view name : builtInPathNames()) {
        const CameraPath path = *loadPath(name, scene);
        for (double t = 0.0; t <= 30.0; t += 0.37) {
            const Camera camera = path.at(t);
            RC_ASSERT(isUsable(camera));
            RC_ASSERT(scene.bounds.distance(camera.eye) > 0.05 * scene.bounds.diagonal());
            RC_ASSERT(scene.bounds.distance(camera.eye) < 2.0 * scene.bounds.diagonal());
        }
    }
}

RC_GTEST_PROP(BuiltInPath, LooksAtASceneWithoutHintsAllTheTime, ()) {
    const SceneInfo scene = anyScene();
    for (std::string_view name : builtInPathNames()) {
        const CameraPath path = *loadPath(name, scene);
        for (double t = 0.0; t <= 30.0; t += 0.61) {
            const Camera camera = path.at(t);
            const glm::dvec3 nearest = glm::clamp(camera.eye, scene.bounds.min, scene.bounds.max);
            RC_ASSERT((sees(camera, scene.bounds.centre(), 16.0 / 9.0) || sees(camera, nearest, 16.0 / 9.0) ||
                       sees(camera, (scene.bounds.centre() + nearest) / 2.0, 16.0 / 9.0)));
        }
    }
}

// Same shape, other size: the same path, scaled (to the rounding of keys).
TEST(BuiltInPath, ScalesWithTheSceneWithoutHints) {
    for (std::string_view name : builtInPathNames()) {
        const CameraPath small = pathOf(name, sceneOf({-0.5, 0, -1}, {0.5, 2, 1}));
        const CameraPath large = pathOf(name, sceneOf({-500, 0, -1000}, {500, 2000, 1000}));
        for (double t = 0.0; t <= 30.0; t += 1.3) {
            EXPECT_LT(difference(small.at(t).eye * 1000.0, large.at(t).eye), 0.01) << name << " " << t;
            EXPECT_LT(difference(small.at(t).forward(), large.at(t).forward()), 1e-5) << name << " " << t;
        }
    }
}

TEST(BuiltInPath, RoundsItsKeys) {
    for (std::string_view name : builtInPathNames()) {
        for (const PathKey& key : pathOf(name, streetScene()).keys) {
            for (int i = 0; i < 3; ++i) {
                const double micrometres = key.camera.eye[i] * 1e6;
                EXPECT_NEAR(micrometres, std::round(micrometres), 1e-3) << name;
            }
        }
    }
}

}  // namespace
}  // namespace fb
