// Says where a level deviates most, so that the cause can be looked for: the node, whether it was welded,
// clustered or stuck, whether the triangle there touches a cut or another block, and what became of that part
// of the source.
#pragma once

#include "prepare_blocks.h"
#include "sample_distance.h"

namespace fb::bench {

struct MeasuredLevel {
    const std::vector<PreparedBlock>& blocks;
    const glm::dvec3& centre;
    double scale;  // from metres to what is printed
    std::size_t level;
    const NodeSurface& source;
    const NodeSurface& drawn;
};

void tellDeviation(const MeasuredLevel& measured, const TwoSided& distances);

}  // namespace fb::bench
