// Between which marks policy `frontbench` keeps the time of a frame (algorithms section 3, step 3).
#pragma once

#include "select/select.h"

namespace fb {

struct FrontbenchMarks {
    double totalMs = 0.0;   // of what is drawn, as fast as the device is held to be
    double middleMs = 0.0;  // up to which time is spent and given back
    double scale = 1.0;     // total over the estimate of now
    bool tooMuch = false;   // given back is what is above the middle; otherwise spent what is below it
};

// nowMs: what is drawn and what is fixed, by the device's speed right now; finite, >= 0. patience >= 1.
[[nodiscard]] FrontbenchMarks frontbenchMarks(const SelectInput& input, double nowMs, double patience);

}  // namespace fb
