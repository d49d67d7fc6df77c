// What a frame leaves in its record, beside its time.
#pragma once

#include "app/frame.h"

namespace fb {

// Counts the frame and clears the record that waits for its time.
[[nodiscard]] FrameRecord& beginRecord(Workbench& workbench, const FrameInput& input);
// The front, why it is as it is and what it is wrong by; the control's values that it was chosen with.
void recordSelection(Workbench& workbench, const View& view, FrameRecord& record);
// What each effect did in selecting, loading and drawing, in the frame and over the walk.
void recordEffectWork(Workbench& workbench, const DrawCounters& drawn, FrameRecord& record);

}  // namespace fb
