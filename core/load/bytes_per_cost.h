// c_memory of a scene (thesis 4.3): true bytes of its nodes, as the budget counts them, over their cost. What the thesis
// takes for a constant spreads as much as textures do, which is why the budget does not use it.
#pragma once

#include "scenefile/hierarchy.h"

namespace fb {

struct BytesPerCost {
    double mean = 0.0;           // all bytes over all cost
    double p5 = 0.0, p95 = 0.0;  // of the nodes, each for itself
};

// The hierarchy has at least one node.
[[nodiscard]] BytesPerCost bytesPerCost(const Hierarchy& hierarchy, double cTextured);

}  // namespace fb
