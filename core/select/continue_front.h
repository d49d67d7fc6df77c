// What policy `frontbench` draws before it looks at times: what it drew before, and what has come into view by the price
// (algorithms section 3, step 2).
#pragma once

#include "select/select.h"

namespace fb {

inline constexpr float kWaitedForData = 1e6f;  // seconds, as if: no wait is longer

// Expands state.tree, which holds the visible roots. Nodes are marked as new that were not in the picture before, or whose
// picture is another one. Refined and waited of all that is reached are set, and the frame in which it was seen.
void continueFront(const SelectInput& input, SelectState& state, Selection& selection);

}  // namespace fb
