// A camera with 6 degrees of freedom, in metres relative to the scene origin. Comes from input, a recorded path or a
// built-in one; goes to the selection (as View, select/view.h) and to the renderer.
// The eye is in double precision: everything near it is computed relative to it, so that a georeferenced scene
// does not jitter.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace fb {

struct Camera {
    glm::dvec3 eye{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // camera axes to scene axes; the camera looks along its -z, y is up
    double fovyRadians = 1.0471975511965976;     // 60 degrees
    double nearMetres = 0.05;                    // there is no far plane: depth is reversed and infinite

    [[nodiscard]] glm::dvec3 forward() const { return orientation * glm::dvec3(0.0, 0.0, -1.0); }
    [[nodiscard]] glm::dvec3 right() const { return orientation * glm::dvec3(1.0, 0.0, 0.0); }
    [[nodiscard]] glm::dvec3 up() const { return orientation * glm::dvec3(0.0, 1.0, 0.0); }
};

// The camera at `eye` that looks at `target` with `up` upward as far as possible; where they coincide or are parallel
// it chooses some valid orientation.
[[nodiscard]] Camera lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

// Whether every number is finite, the orientation is a unit quaternion to 1e-3, and the angle of view is between 0 and
// half a turn.
[[nodiscard]] bool isUsable(const Camera& camera);

}  // namespace fb
