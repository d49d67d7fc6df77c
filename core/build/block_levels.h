// All levels of a block, from the root to the leaves, before any node is finished: what a node must fit to at its
// borders is known only when every level is there. Comes from quantise_block; measure_error, plan_skirts and
// build_block take it (thesis 3.2).
#pragma once

#include "build/simplify_level.h"
#include "build/split_mesh.h"
#include "settings/settings.h"

namespace fb {

struct BlockLevel {
    Level original;                           // cut, not simplified
    std::vector<SimplifiedPiece> simplified;  // by piece; empty at the leaves, which are drawn as they are
    double factor = 1.0;                      // source triangles for one of this level

    [[nodiscard]] bool isLeaves() const { return simplified.empty(); }
    [[nodiscard]] std::span<const MeshTriangle> piece(std::size_t i) const {
        return {original.triangles.data() + original.pieces[i].begin, original.pieces[i].size()};
    }
    // What is drawn of a piece: triangles of positions.
    [[nodiscard]] std::vector<glm::uvec3> drawn(const BlockMesh& mesh, std::size_t i) const;
};

[[nodiscard]] std::vector<glm::uvec3> positionsOf(const BlockMesh& mesh, std::span<const MeshTriangle> triangles);

// A level is simplified before it is cut for the next, so that only the planes that made it are locked.
[[nodiscard]] std::vector<BlockLevel> makeLevels(BlockMesh& mesh, Level root, const BuildSettings& settings,
                                                 SplitCounters& counters);

}  // namespace fb
