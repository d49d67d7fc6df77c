// Flying with 6 degrees of freedom: mouse and keys move the camera, at any speed, without restriction.
#pragma once

#include "base/bounds.h"
#include "base/camera.h"

namespace fb {

// What the user's hands did since the last frame.
struct FlyInput {
    glm::dvec3 move{0.0};   // -1 to 1: right, up, forward
    glm::dvec2 look{0.0};   // radians: to the right, upward
    double roll = 0.0;      // radians, clockwise
    double wheel = 0.0;     // notches: each one multiplies the speed
    glm::dvec2 orbit{0.0};  // radians around the pivot
    glm::dvec2 pan{0.0};    // parts of the picture's height
};

struct FlyCamera {
    Camera camera;
    glm::dvec3 up{0.0, 1.0, 0.0};      // looking right turns around this while the camera is not rolled
    double speedMetresPerSecond = 10.0;
    glm::dvec3 pivot{0.0};             // for orbiting
    glm::dvec3 velocity{0.0};          // m/s of the last step
};

// Moves by one frame; false when the input asked for nothing.
bool fly(FlyCamera& camera, const FlyInput& input, double dtSeconds);

// Looks at the whole of `bounds` from an oblique angle above.
void frameBounds(FlyCamera& camera, const Box3d& bounds);

}  // namespace fb
