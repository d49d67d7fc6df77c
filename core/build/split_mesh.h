// Cuts the pieces of one level into those of the next (thesis 3.2 and fig. 3.2): c_levelFactor - 1 planes
// across the longest axis of each piece's box, equally spaced; a triangle across a plane becomes three with
// two new vertices. Comes from quantise_block or an earlier cut, goes to simplify_level (inner levels) or
// finish_node (leaves). The cuts leave no T-junction, within a piece or between pieces: an edge that two
// pieces share is cut for both.
#pragma once

#include <span>

#include "build/block_mesh.h"

namespace fb {

struct SplitCounters {
    std::uint64_t emptyPieces = 0;
    std::uint64_t degenerateTriangles = 0;  // dropped: narrower than a grid step where they were cut
};

// The coordinates of the planes, between the ends of the box, in rising order; fewer than levelFactor - 1
// where the box is only a few grid steps long.
[[nodiscard]] std::vector<std::int32_t> cuttingPlanes(std::int32_t low, std::int32_t high, int levelFactor);

// The pieces of the next level in the order of their parents, then along the axis. Pieces without triangles
// are left out. New vertices and wedges are added to `mesh`.
[[nodiscard]] Level splitLevel(BlockMesh& mesh, const Level& level, int levelFactor, SplitCounters& counters);

}  // namespace fb
