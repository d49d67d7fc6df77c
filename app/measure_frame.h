// The times of frames: taken as they arrive, fed back to the control, and each frame's record finished with its own.
#pragma once

#include "app/workbench.h"

namespace fb {

void measureFrame(Workbench& workbench);

// After the last frame: takes in times that a GPU still owes.
void waitForTimes(Workbench& workbench);

}  // namespace fb
