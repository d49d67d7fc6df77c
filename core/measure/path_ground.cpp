// What the built-in paths know of a scene, and the walker and the flyer in it.
#include <algorithm>
#include <cmath>

#include "measure/built_in_path.h"
#include "measure/sin_cos_turns.h"

namespace fb {
namespace {

// A walk is this many times the path's length in time: drive covers ten walks.
constexpr double kReachSeconds = 10.0 * kBuiltInPathSeconds;
constexpr double kMinimumHintMetres = 1.0;
constexpr double kMargin = 0.3;  // of the diagonal: how far from the bounds a walk without a hint stays

// A nanometre to a tenth of what a path file may hold.
constexpr double kSmallestMetres = 1e-9, kFarthestMetres = kPathCoordinateCap / 10.0;

Box3d usableBounds(const Box3d& bounds) {
    const Box3d world{glm::dvec3(-kFarthestMetres), glm::dvec3(kFarthestMetres)};
    const bool usable = !bounds.empty() && world.contains(bounds) && bounds.diagonal() >= kSmallestMetres;
    return usable ? bounds : Box3d{glm::dvec3(-0.5), glm::dvec3(0.5)};
}

double extentAlong(const Box3d& box, const glm::dvec3& axis) {
    return std::abs(glm::dot(box.size(), axis));
}

// A rectangle around the bounds at the height of the walker's eyes, from the middle of the front side round
// and back. The front is +z where y is up and -y where z is up: where models look to.
std::vector<glm::dvec3> wayAround(const Box3d& box, const GroundAxes& axes) {
    const double margin = kMargin * box.diagonal(), height = extentAlong(box, axes.up);
    const double a = extentAlong(box, axes.along) / 2.0 + margin,
                 b = extentAlong(box, axes.across) / 2.0 + margin;
    // Flat scenes are seen from above their top, obliquely.
    const double eye = std::max(0.6 * height, 0.25 * box.diagonal()) - height / 2.0;
    const glm::dvec3 middle = box.centre() + axes.up * eye;
    const auto corner = [&](double x, double y) { return middle + axes.along * x + axes.across * y; };
    return {corner(0, -b), corner(a, -b), corner(a, b), corner(-a, b), corner(-a, -b), corner(0, -b)};
}

double aroundLength(const Box3d& box, const GroundAxes& axes) {
    const double margin = kMargin * box.diagonal();
    return 2.0 * (extentAlong(box, axes.along) + extentAlong(box, axes.across) + 4.0 * margin);
}

}  // namespace

PathGround pathGround(const SceneInfo& scene) {
    const GroundAxes axes = scene.up == UpAxis::y ? GroundAxes{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}
                                                  : GroundAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Box3d box = usableBounds(scene.bounds);
    const double diagonal = box.diagonal();
    const bool hinted = !scene.walks.empty() && isWalkable(scene.walks.front().points, kMinimumHintMetres);
    // Without a hint a round takes a minute.
    const double speed = hinted ? 1.4 : aroundLength(box, axes) / 60.0;
    const double lookAhead = hinted ? 1.0 : 0.0;
    const double rounding = hinted ? 4.0 : 0.2 * diagonal, turning = hinted ? 6.0 : rounding;
    return {axes,
            box,
            box.centre(),
            extentAlong(box, axes.up),
            diagonal,
            hinted,
            hinted ? 1.7 : 0.0,
            speed,
            lookAhead,
            WalkLine(hinted ? scene.walks.front().points : wayAround(box, axes), axes,
                     kReachSeconds * speed + lookAhead, rounding, turning)};
}

Camera cameraOf(const WalkView& view, const PathGround& ground) {
    const glm::dvec2 yaw = circlePoint(view.yawTurns), pitch = circlePoint(view.pitchTurns);
    const glm::dvec3 level = ground.axes.along * yaw.x + ground.axes.across * yaw.y;
    Camera camera = lookAt(glm::dvec3(0.0), level * pitch.x + ground.axes.up * pitch.y, ground.axes.up);
    camera.eye = view.eye;
    return camera;
}

WalkView walkViewAt(const PathGround& ground, double metres, double headTurns) {
    WalkView view{ground.line.placeAt(metres) + ground.axes.up * ground.eyeHeightMetres, 0.0, 0.0};
    if (ground.hinted) {
        // A look of 15 degrees to each side every 8 s of walking, and a slower one of 3 degrees up and down.
        const double seconds = metres / ground.metresPerSecond;
        view.yawTurns = ground.line.headingAt(metres + ground.lookAheadMetres) +
                        headTurns * (15.0 / 360.0) * sinTurns(seconds / 8.0);
        view.pitchTurns = headTurns * (3.0 / 360.0) * sinTurns(seconds / 13.0);
        return view;
    }
    // Half-way between the scene's centre and its nearest point: a long scene is seen from the side, not end
    // on.
    const glm::dvec3 nearest = glm::clamp(view.eye, ground.bounds.min, ground.bounds.max);
    const glm::dvec3 way = (ground.centre + nearest) / 2.0 - view.eye;
    const glm::dvec2 level(glm::dot(way, ground.axes.along), glm::dot(way, ground.axes.across));
    view.yawTurns = turnsOf(level);
    view.pitchTurns = turnsOf({std::sqrt(glm::dot(level, level)), glm::dot(way, ground.axes.up)});
    return view;
}

Camera flyCameraAt(const PathGround& ground, double fraction) {
    const double wave = circlePoint(2.0 * fraction).x;  // 1 far, -1 close
    const glm::dvec2 round = circlePoint(fraction - 0.25);
    const double out = ground.diagonalMetres * (0.52 + 0.28 * wave);
    const double above = ground.heightMetres / 2.0 + ground.diagonalMetres * (0.33 + 0.15 * wave);
    const glm::dvec3 offset =
        (ground.axes.along * round.x + ground.axes.across * round.y) * out + ground.axes.up * above;
    Camera camera = lookAt(offset, glm::dvec3(0.0), ground.axes.up);
    camera.eye = ground.centre + offset;
    return camera;
}

}  // namespace fb
