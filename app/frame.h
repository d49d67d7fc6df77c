// One frame, the same for the window and the headless replay (design section 3).
#pragma once

#include "app/workbench.h"
#include "base/camera.h"

namespace fb {

struct FrameInput {
    Camera camera;
    glm::dvec3 velocity{0.0};  // m/s
    double dtSeconds = 1.0 / 30.0;
    int width = 1280, height = 720;
};

// Takes finished loads, plans loads and evictions, selects, draws, measures, feeds back and records. A record enters
// workbench.history when its time is known: in the same frame, or some frames later on a GPU.
void runFrame(Workbench& workbench, const FrameInput& input);

}  // namespace fb
