// A camera that wanders through random worlds, or jumps.
#pragma once

#include "worlds/random_worlds.h"
#include "worlds/tiny_walk.h"

namespace fb {

inline void moveCamera(Random& r, TinyWalk& walk, bool cut) {
    Camera camera = walk.view.camera;
    if (cut) {
        const glm::dvec3 eye = randomPoint(r, 25.0), target = randomPoint(r, 10.0);
        camera = lookAt(eye, target, glm::dvec3(0, 1, 0));
    } else {
        camera.eye += randomPoint(r, 0.4);
        const glm::dvec3 axis = glm::normalize(randomPoint(r, 1.0) + glm::dvec3(1e-3));
        camera.orientation = glm::normalize(glm::angleAxis(r.uniform(-0.1, 0.1), axis) * camera.orientation);
    }
    walk.view = makeView(camera, randomPoint(r, 5.0), 160, 90);
}

}  // namespace fb
