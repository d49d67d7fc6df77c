#include "build/border_edges.h"

#include <algorithm>
#include <optional>

namespace fb {
namespace {

struct Candidate {
    std::uint32_t low, high;  // positions
    BorderEdge edge;
};

std::optional<BorderEdge> classify(const BlockMesh& mesh, const Piece& piece, std::uint32_t a, std::uint32_t b,
                                   bool clustered) {
    BorderEdge edge;
    if (clustered) {
        edge.kind = BorderKind::free;
        return edge;
    }
    const GridPoint &p = mesh.positions[a], &q = mesh.positions[b];
    for (const CutPlane& plane : piece.cuts) {
        if (p[plane.axis] != plane.at || q[plane.axis] != plane.at) continue;
        edge.plane = plane;
        return edge;
    }
    if (!mesh.isOnBlockBorder(a) || !mesh.isOnBlockBorder(b)) return std::nullopt;
    edge.kind = BorderKind::block;
    return edge;
}

}  // namespace

std::vector<BorderEdge> findBorderEdges(const BlockMesh& mesh, const Piece& piece,
                                        std::span<const glm::uvec3> drawn, bool clustered) {
    std::vector<Candidate> candidates;
    for (std::uint32_t t = 0; t < drawn.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = drawn[t][k], b = drawn[t][(k + 1) % 3];
            std::optional<BorderEdge> edge = classify(mesh, piece, a, b, clustered);
            if (!edge) continue;
            edge->triangle = t;
            edge->corner = k;
            candidates.push_back({std::min(a, b), std::max(a, b), *edge});
        }
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tuple(a.low, a.high, a.edge.triangle, a.edge.corner) <
               std::tuple(b.low, b.high, b.edge.triangle, b.edge.corner);
    });
    // A border is where only one triangle of the piece is.
    std::vector<BorderEdge> edges;
    for (std::size_t i = 0, next = 0; i < candidates.size(); i = next) {
        while (next < candidates.size() && candidates[next].low == candidates[i].low &&
               candidates[next].high == candidates[i].high) {
            ++next;
        }
        if (next == i + 1) edges.push_back(candidates[i].edge);
    }
    return edges;
}

}  // namespace fb
