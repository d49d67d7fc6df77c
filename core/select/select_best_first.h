// Best gain for its time first, from the visible roots on, until nothing more fits: what `greedy` draws and what
// `maciel-shirley` wishes for.
#pragma once

#include "select/select.h"

namespace fb {

// Into state.tree.
void refineBestFirst(const SelectInput& input, SelectState& state, Selection& selection);

}  // namespace fb
