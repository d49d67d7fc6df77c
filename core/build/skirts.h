// Skirts against cracks: nodes of different levels do not meet exactly where the original was cut, so from each such
// border hangs a strip of triangles, behind the surface, as deep as the gap to any other level's border can be there.
// On a cut it lies in the cutting plane, in which all levels' borders lie: seen from in front, whatever lies between
// two of them is covered by the skirt of the one above. Between blocks, where borders are no plane lines and the other
// block is not known, it leans outward at 45 degrees and is twice as deep. Where levels agree but for how a straight
// border is divided, the coarser one has a narrow one against pinholes; where they agree altogether there is none. Comes
// from make_levels and measure_error, goes to finish_node.
#pragma once

#include <vector>

#include "build/block_levels.h"
#include "build/node_triangles.h"

namespace fb {

struct SkirtEdge {
    std::uint32_t triangle = 0;  // of the node's triangles
    int corner = 0;              // the edge goes from this corner to the next one
    std::uint32_t belowFirst = 0, belowSecond = 0;  // positions
};

struct Skirts {
    std::vector<SkirtEdge> edges;
    double gapGridUnits = 0.0;  // the widest that would show without them
};

// By level and piece; `errors` as measureErrors() gives them. Adds the lower ends to the mesh's positions.
[[nodiscard]] std::vector<std::vector<Skirts>> planSkirts(BlockMesh& mesh, const std::vector<BlockLevel>& levels,
                                                          const std::vector<std::vector<double>>& errors);

// Appends a node's skirts; they look as the triangles that they hang from, texels included.
void addSkirts(std::vector<NodeTriangle>& triangles, const BlockMesh& mesh, const Skirts& skirts);

}  // namespace fb
