// Timing fronts by drawing them: what the calibration at the start of a walk and `frontbench calibrate` share. In: views
// and fronts of resident nodes. Out: FrontTimes, from which control/fit_costs.h makes the constants of the cost model.
#pragma once

#include "app/workbench.h"
#include "control/fit_costs.h"
#include "import/source_scene.h"
#include "measure/camera_path.h"

namespace fb {

struct TimedFronts {
    struct Front {
        std::uint32_t view;  // one of `views`
        std::vector<NodeId> nodes;
    };
    std::vector<View> views;
    std::vector<Front> fronts;
};

struct TimingPlan {
    int leastRounds = 5, mostRounds = 5;
    double enoughSeconds = 0.0;    // no further round after that, once there are leastRounds
    bool withoutTextures = false;  // draw each front without its textures too, in turn
};

// The view at a time of a path, as a walk with the workbench's settings has it.
[[nodiscard]] View viewAlong(const Workbench& workbench, const CameraPath& path, double seconds, glm::ivec2 size);

// The nodes over and over, until there are triangles enough to rise above the overhead. The repetitions cover the same
// pixels: what they add is the time of triangles.
[[nodiscard]] std::vector<NodeId> repeated(const Hierarchy& hierarchy, const std::vector<NodeId>& nodes);

// Draws all fronts in rounds, after one round that is not counted. Costs are those of the settings' c_textured. Errors:
// Ctrl-C; a front cannot be drawn; its time does not arrive.
[[nodiscard]] Result<std::vector<FrontTimes>> timeFronts(Workbench& workbench, const TimedFronts& fronts,
                                                         const TimingPlan& plan, const Progress& progress = {});

// Sums up the fronts' costs anew, for another c_textured.
void countCosts(const Workbench& workbench, const TimedFronts& fronts, std::vector<FrontTimes>& times);

// One front once, without textures where `plain`; in ms. Errors as above.
[[nodiscard]] Result<double> timeFront(Workbench& workbench, const View& view, std::span<const NodeId> front, bool plain);

}  // namespace fb
