// The constants of the cost model on this machine, or on the simulated device: measured and put into settings.
#pragma once

#include <string>
#include <vector>

#include "app/calibration_fronts.h"
#include "load/bytes_per_cost.h"

namespace fb {

// A constant, as measured and as it stood before.
struct CalibratedConstant {
    std::string knob;     // "select.c_textured"
    double value = 0.0;   // what the settings have now: the measured one, or the one from before
    double before = 0.0;  // 0 of a start value: measured when a scene is opened
    std::string spread;   // "+- 0.004", "exact", "620 .. 2400 in 90 % of 2298 nodes"; of a measured one
    std::string kept;     // why it could not be measured; empty: it was
};

struct Calibration {
    std::vector<CalibratedConstant> constants;  // c_textured, c_memory, v_time_start, overhead
    std::vector<std::string> facts;             // device, picture, scene, counts
    std::string warning;                        // the times are not to be trusted far; empty: they are
};

// Measures with an opened scene and sets the constants in the workbench's settings. Errors: as makeCalibrationFronts().
[[nodiscard]] Result<Calibration> measureConstants(Workbench& workbench, glm::ivec2 size, const Progress& progress);

}  // namespace fb
