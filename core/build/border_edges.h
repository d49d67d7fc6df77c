// Where a piece was parted from what it belongs to: the edges at which its neighbours, drawn at another level, may
// leave a gap. Comes from make_levels; skirts.h hangs triangles from them.
#pragma once

#include <span>
#include <vector>

#include "build/block_levels.h"

namespace fb {

// What lies on the other side. `free`: clustering moved the border, even pieces of one level do not meet there.
enum class BorderKind : std::uint8_t { cut, block, free };

struct BorderEdge {
    std::uint32_t triangle = 0;  // of the drawn triangles
    int corner = 0;              // the edge goes from this corner to the next one
    BorderKind kind = BorderKind::cut;
    CutPlane plane;  // of a cut
};

// `drawn` as BlockLevel::drawn() gives it.
[[nodiscard]] std::vector<BorderEdge> findBorderEdges(const BlockMesh& mesh, const Piece& piece,
                                                      std::span<const glm::uvec3> drawn, bool clustered);

}  // namespace fb
