// Walks a path without a window, frame by frame: what `replay` does once and `compare` often.
#pragma once

#include <functional>

#include "app/frame.h"
#include "measure/camera_path.h"

namespace fb {

struct WalkPlan {
    CameraPath path;
    glm::ivec2 size{1280, 720};
    std::uint64_t frames = 0;
    bool settle = false;  // load what the first view wants before the walk starts
};

// `frames` of 0: the whole path at the rate of the settings.
[[nodiscard]] Result<WalkPlan> planWalk(const Workbench& workbench, const std::string& path, glm::ivec2 size,
                                        std::uint64_t frames, bool settle);
// Runs all frames; `afterFrame` (may be empty) hears the number of each, from 0. Stops at Ctrl-C, with an error.
[[nodiscard]] Result<void> walkPath(Workbench& workbench, const WalkPlan& plan,
                                    const std::function<Result<void>(std::uint64_t)>& afterFrame);

}  // namespace fb
