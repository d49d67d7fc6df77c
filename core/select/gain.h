// What drawing a node's visible children in its place brings (algorithms 2.1 and 3, Gain). The node is `parent`, its visible
// children and their priorities stand in state.group and state.priorities.
#pragma once

#include "select/select.h"

namespace fb {

// Benefits of the visible children (thesis 4.2), less what their parent's part of the same region has already. Above 0.
[[nodiscard]] double benefitGain(const SelectInput& input, NodeId parent, const SelectState& state);

// By how many pixels how many pixels are wrong by less: pixels times pixels. 0 only where nothing gets finer.
[[nodiscard]] double errorGain(const SelectInput& input, const SelectState& state);

// The part of it that one child brings, seen from `distance` metres.
[[nodiscard]] double childErrorGain(const Hierarchy& hierarchy, NodeId child, double distance, const View& view);

}  // namespace fb
