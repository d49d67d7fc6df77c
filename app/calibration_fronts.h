// What `frontbench calibrate` draws: several views of the scene, and in each the front of every level that is in view, so
// that fronts of one view cover the same pixels with more and more triangles. Loads the nodes, within the budget.
#pragma once

#include "app/time_fronts.h"

namespace fb {

struct CalibrationFronts {
    TimedFronts timed;  // the first front is empty: it times the overhead
    std::uint32_t levels = 0;
    bool repeats = false;  // there is one level only: it is drawn once and repeatedly
};

// Goes down a level while the finest fronts are drawn in a moment and the next level fits into the budget. Errors: a node
// cannot be read, drawn or uploaded; the progress says stop.
[[nodiscard]] Result<CalibrationFronts> makeCalibrationFronts(Workbench& workbench, glm::ivec2 size,
                                                              const Progress& progress);

}  // namespace fb
