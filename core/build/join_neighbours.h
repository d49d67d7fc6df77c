// Joins parts with those beside them on a space-filling curve. Goes to stand_ins: each run gets one.
#pragma once

#include "build/separate_parts.h"

namespace fb {

// Of parts in the order of their curve: where each of the `count` runs ends (as an index of `parts`). Always
// the two neighbours whose common bounds are smallest are joined, so parts that lie apart stay alone as long
// as there is room.
[[nodiscard]] std::vector<std::size_t> joinNeighbours(const std::vector<const Part*>& parts, std::size_t count);

}  // namespace fb
