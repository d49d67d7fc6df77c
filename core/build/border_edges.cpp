#include "build/border_edges.h"

#include <optional>

#include "base/edge_uses.h"

namespace fb {
namespace {

std::optional<BorderEdge> classify(const BlockMesh& mesh, const Piece& piece, const EdgeUse& use,
                                   bool clustered) {
    BorderEdge edge;
    edge.triangle = use.triangle;
    edge.corner = static_cast<int>(use.corner);
    if (clustered) {
        edge.kind = BorderKind::free;
        return edge;
    }
    const GridPoint &p = mesh.positions[use.low], &q = mesh.positions[use.high];
    for (const CutPlane& plane : piece.cuts) {
        if (p[plane.axis] != plane.at || q[plane.axis] != plane.at) continue;
        edge.plane = plane;
        return edge;
    }
    if (!mesh.isOnBlockBorder(use.low) || !mesh.isOnBlockBorder(use.high)) return std::nullopt;
    edge.kind = BorderKind::block;
    return edge;
}

}  // namespace

std::vector<BorderEdge> findBorderEdges(const BlockMesh& mesh, const Piece& piece,
                                        std::span<const glm::uvec3> drawn, bool clustered) {
    std::vector<EdgeUse> candidates;
    for (std::uint32_t t = 0; t < drawn.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const EdgeUse use = edgeUse(drawn[t], t, k);
            if (classify(mesh, piece, use, clustered)) candidates.push_back(use);
        }
    }
    // A border is where only one triangle of the piece is.
    std::vector<BorderEdge> edges;
    visitEdges(candidates, [&](std::span<const EdgeUse> of) {
        if (of.size() == 1) edges.push_back(*classify(mesh, piece, of[0], clustered));
    });
    return edges;
}

}  // namespace fb
