#include "measure/built_in_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "measure/sin_cos_turns.h"
#include "measure/slerp_by_halving.h"

namespace fb {
namespace {

constexpr double kKeySeconds = 0.25;  // between the keys of smooth paths
constexpr int kKeyCount = static_cast<int>(kBuiltInPathSeconds / kKeySeconds);
constexpr double kCutEverySeconds = 2.0;  // of jump

double smoothStep(double from, double to, double t) {
    const double u = std::min(1.0, std::max(0.0, (t - from) / (to - from)));
    return u * u * (3.0 - 2.0 * u);
}

// Eyes on a grid of a micrometre (finer for scenes below a metre) and orientations of 1e-9: short numbers in
// files.
Camera rounded(Camera camera, const PathGround& ground) {
    double step = 1e6;  // steps in a metre
    for (double size = ground.diagonalMetres; size < 1.0; size *= 2.0) step *= 2.0;
    for (int i = 0; i < 3; ++i) camera.eye[i] = std::round(camera.eye[i] * step) / step;
    glm::dquat& q = camera.orientation;
    for (double* part : {&q.w, &q.x, &q.y, &q.z}) *part = std::round(*part * 1e9) / 1e9;
    q = normalisedQuat(q);
    // A person's near plane, or a small part of a small scene.
    camera.nearMetres = ground.hinted ? 0.05 : std::min(0.05, ground.diagonalMetres / 2048.0);
    return camera;
}

struct Keys {
    const PathGround& ground;
    std::vector<PathKey> keys;

    void add(double timeSeconds, const Camera& camera, bool cut = false) {
        keys.push_back({timeSeconds, rounded(camera, ground), cut});
    }
};

// The walk at `pace` times its speed, with a key at the same places whatever the pace: drive is the walk, ten
// times as fast and as far.
void addWalk(Keys& out, double pace) {
    const int count = static_cast<int>(std::lround(kBuiltInPathSeconds * pace / kKeySeconds));
    for (int k = 0; k <= count; ++k) {
        const double walkSeconds = k * kKeySeconds;
        out.add(walkSeconds / pace,
                cameraOf(walkViewAt(out.ground, walkSeconds * out.ground.metresPerSecond, 1.0), out.ground));
    }
}

void addFly(Keys& out) {
    for (int k = 0; k <= kKeyCount; ++k) {
        out.add(k * kKeySeconds, flyCameraAt(out.ground, static_cast<double>(k) / kKeyCount));
    }
}

// Where the walk-to-fly is at a moment: the walker lifted and drawn back.
WalkView risingView(const PathGround& ground, const WalkView& last, double t) {
    const double size = ground.diagonalMetres;
    const double stopping = std::min(12.0, std::max(0.0, t - 8.0));
    const double walked = std::min(t, 8.0) + stopping - stopping * stopping / 24.0;
    // Low scenes are cleared sooner.
    const double clear = ground.heightMetres < 0.25 * size ? 13.0 : 16.0;
    const double rise = smoothStep(8.0, 20.0, t), retreat = smoothStep(clear, clear + 14.0, t);

    WalkView view = walkViewAt(ground, walked * ground.metresPerSecond, 1.0 - rise);
    const glm::dvec2 yaw = circlePoint(last.yawTurns);
    const glm::dvec3 back = (ground.axes.along * yaw.x + ground.axes.across * yaw.y) * (-0.62 * size);
    const double endHeight = ground.heightMetres / 2.0 + 0.45 * size;  // above the centre
    const double startHeight = glm::dot(view.eye - ground.centre, ground.axes.up);
    const glm::dvec3 start = view.eye - ground.centre - ground.axes.up * startHeight;
    const double height = startHeight + (endHeight - startHeight) * rise;
    const glm::dvec3 level = start * (1.0 - retreat) + back * retreat;
    view.eye = ground.centre + level + ground.axes.up * height;

    const double turnBy = last.yawTurns - view.yawTurns;
    view.yawTurns += (turnBy - std::floor(turnBy + 0.5)) * rise;
    // Down to the centre, though not steeply where the street lies right under it.
    const double away = std::max((ground.hinted ? 0.5 : 0.0) * size, std::sqrt(glm::dot(level, level)));
    view.pitchTurns += (turnsOf({away, -height}) - view.pitchTurns) * smoothStep(8.0, 16.0, t);
    return view;
}

// Figure 7 of the paper: 8 s of walking, then up while the walk comes to a stop within 12 s, then back until
// the whole scene is in view. The way back begins when the eye is above everything.
void addWalkToFly(Keys& out) {
    const WalkView last = walkViewAt(out.ground, 14.0 * out.ground.metresPerSecond, 0.0);
    for (int k = 0; k <= kKeyCount; ++k) {
        const double t = k * kKeySeconds;
        out.add(t, cameraOf(risingView(out.ground, last, t), out.ground));
    }
}

// Where shake and (with a hint) still are: ten seconds into the walk.
WalkView restingView(const PathGround& ground) {
    return walkViewAt(ground, 10.0 * ground.metresPerSecond, 0.0);
}

// 30 cm to each side at 1.25 Hz, 18 cm to and fro at 1 Hz, 3 degrees of yaw at 1.5 Hz; less of everything
// without a hint in proportion to the scene.
void addShake(Keys& out) {
    const PathGround& ground = out.ground;
    const double reach = ground.hinted ? 0.3 : ground.diagonalMetres / 200.0;
    const WalkView rest = restingView(ground);
    const Camera still = cameraOf(rest, ground);
    const int keysPerSecond = 32, count = static_cast<int>(kBuiltInPathSeconds) * keysPerSecond;
    for (int k = 0; k <= count; ++k) {
        const double t = static_cast<double>(k) / keysPerSecond;
        WalkView view = rest;
        view.eye +=
            still.right() * (reach * sinTurns(1.25 * t)) + still.forward() * (0.6 * reach * sinTurns(t));
        view.yawTurns += (3.0 / 360.0) * sinTurns(1.5 * t);
        out.add(t, cameraOf(view, ground));
    }
}

Camera stillCamera(const PathGround& ground) {
    if (ground.hinted) return cameraOf(restingView(ground), ground);
    // The whole object from the front, an eighth of a turn to the side and 20 degrees above.
    const glm::dvec2 side = circlePoint(-0.25 + 0.125), above = circlePoint(20.0 / 360.0);
    const glm::dvec3 offset =
        ((ground.axes.along * side.x + ground.axes.across * side.y) * above.x + ground.axes.up * above.y) *
        (1.1 * ground.diagonalMetres);
    Camera camera = lookAt(offset, glm::dvec3(0.0), ground.axes.up);
    camera.eye = ground.centre + offset;
    return camera;
}

void addStill(Keys& out) {
    const Camera camera = stillCamera(out.ground);
    out.add(0.0, camera);
    out.add(kBuiltInPathSeconds, camera);
}

// Two views from the way, one from above, and again. Golden-section steps along the way keep the views far
// apart.
void addJump(Keys& out) {
    const PathGround& ground = out.ground;
    const int views = static_cast<int>(std::lround(kBuiltInPathSeconds / kCutEverySeconds));
    const double reach =
        std::min(ground.line.lengthMetres(), 10.0 * kBuiltInPathSeconds * ground.metresPerSecond);
    for (int k = 0; k < views; ++k) {
        const double part = k * 0.6180339887498949;
        const double fraction = part - std::floor(part);
        const Camera camera = k % 3 == 2 ? flyCameraAt(ground, fraction)
                                         : cameraOf(walkViewAt(ground, fraction * reach, 0.0), ground);
        out.add(k * kCutEverySeconds, camera, k > 0);
    }
    out.keys.push_back({kBuiltInPathSeconds, out.keys.back().camera, false});
}

struct BuiltIn {
    std::string_view name;
    void (*add)(Keys&);
};
constexpr std::array<BuiltIn, 7> kBuiltIn = {{{"still", addStill},
                                              {"walk", [](Keys& out) { addWalk(out, 1.0); }},
                                              {"drive", [](Keys& out) { addWalk(out, 10.0); }},
                                              {"fly", addFly},
                                              {"walk-to-fly", addWalkToFly},
                                              {"shake", addShake},
                                              {"jump", addJump}}};

}  // namespace

std::vector<std::string_view> builtInPathNames() {
    std::vector<std::string_view> names;
    for (const BuiltIn& path : kBuiltIn) names.push_back(path.name);
    return names;
}

CameraPath makeBuiltInPath(std::string_view name, const SceneInfo& scene) {
    const PathGround ground = pathGround(scene);
    Keys out{ground, {}};
    for (const BuiltIn& path : kBuiltIn) {
        if (path.name == name) path.add(out);
    }
    FB_CHECK(out.keys.empty() == false);
    return {std::string(name), std::move(out.keys)};
}

}  // namespace fb
