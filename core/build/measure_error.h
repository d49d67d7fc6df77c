// The geometric error of each node: no point of the original lies farther from what is drawn, and no point of what is
// drawn farther from the original. Comes from make_levels' result, goes into the hierarchy; policies divide it by the
// distance to get pixels. Bounded from above by branch and bound (farthest_from.h), not sampled. From the original to a
// node it is measured directly; from a node to the original through its children: the distance to their surface plus
// the largest of theirs, which is never less than the distance itself.
#pragma once

#include "build/block_levels.h"

namespace fb {

// In grid units, by level and piece; never smaller in a parent than in its child; 0 in leaves.
[[nodiscard]] std::vector<std::vector<double>> measureErrors(const BlockMesh& mesh,
                                                             const std::vector<BlockLevel>& levels);

}  // namespace fb
