// What became of each load of a walk: loads.csv, and what the workbench's loader timeline shows.
#pragma once

#include <span>
#include <string>

#include "load/load_timeline.h"

namespace fb {

// One row a load, oldest first: node,level,bytes,missed_s,queued_s,first_read_s,read_s,decoded_s,uploaded_s,first_drawn_s,
// suspended,end,ended_s. Times in seconds since `beginSeconds`, empty where it did not come so far; missed_s: since when its parent
// was drawn for want of it; end: cancelled, failed, evicted, or empty while it is under way or resident.
[[nodiscard]] std::string loadsCsv(const Hierarchy& hierarchy, std::span<const LoadRecord> loads, double beginSeconds);

}  // namespace fb
