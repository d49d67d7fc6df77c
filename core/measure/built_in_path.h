// The camera paths that every scene has, made from its bounds, its up axis and its walk hints; each lasts 30
// s. Sizes come from the scene: with a walk hint they are a person's (eye 1.7 m above the ground, 1.4 m/s,
// the walk of thesis ch. 6), without one they scale with the diagonal of the bounds, so that a coin and a
// mountain look alike. Only + - * / and square roots are used: a path is the same numbers on every machine.
#pragma once

#include "measure/camera_path.h"
#include "measure/walk_line.h"

namespace fb {

inline constexpr double kBuiltInPathSeconds = 30.0;

// What the paths know of a scene. Bounds that are empty or not finite count as a box of 1 m around the
// origin.
struct PathGround {
    GroundAxes axes;
    Box3d bounds;
    glm::dvec3 centre{0.0};
    double heightMetres = 1.0, diagonalMetres = 1.0;
    bool hinted = false;
    double eyeHeightMetres = 1.7;  // above `line`
    double metresPerSecond = 1.4;  // of the walk
    double lookAheadMetres = 1.0;  // the head turns before the feet do
    WalkLine line;  // the first hint, or a rectangle around the bounds a fifth of the diagonal away
};
[[nodiscard]] PathGround pathGround(const SceneInfo& scene);

// A camera by yaw and pitch in turns, without roll: yaw from axes.along towards axes.across, pitch upward.
struct WalkView {
    glm::dvec3 eye;
    double yawTurns, pitchTurns;
};
[[nodiscard]] Camera cameraOf(const WalkView& view, const PathGround& ground);

// The walker after `metres` of way. With a hint the walker looks along the way and turns the head gently
// (`headTurns` 1; 0 looks straight on); without one the walker looks at the object.
[[nodiscard]] WalkView walkViewAt(const PathGround& ground, double metres, double headTurns);

// A closed round above the scene, looking down at its centre: from far enough to see the whole scene
// (fraction 0 and 1/2) over close crossings (1/4 and 3/4).
[[nodiscard]] Camera flyCameraAt(const PathGround& ground, double fraction);

// `name` is one of builtInPathNames().
[[nodiscard]] CameraPath makeBuiltInPath(std::string_view name, const SceneInfo& scene);

}  // namespace fb
