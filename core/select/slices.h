// How siblings share time (thesis eq. 4.1), and the effect `redistribution`: what a node cannot use goes to its siblings
// (thesis 6.6, future work; algorithms 2 item 4).
#pragma once

#include "select/select.h"

namespace fb {

// The slices of state.group into state.slices: shareMs * p_i / sum of p. With redistribution on,
// clamp(lambda * p_i, need_i, 1.25 times what all leaves below would take), lambda such that they add up to shareMs; where even the
// needs are more than that, or all leaves less, in proportion to those. Finite and > 0 for a share > 0.
void shareOut(const SelectInput& input, double shareMs, SelectState& state, SelectCounters& counters);

}  // namespace fb
