#include "build/block_levels.h"

namespace fb {

namespace {

glm::uvec3 positionsAt(const BlockMesh& mesh, const glm::uvec3& wedges) {
    return {mesh.wedges[wedges.x].position, mesh.wedges[wedges.y].position, mesh.wedges[wedges.z].position};
}

// Where the original has the corners that a simplified piece kept.
std::vector<glm::uvec3> keptPositions(const BlockMesh& mesh, const SimplifiedPiece& simplified) {
    if (simplified.welded) return simplified.triangles;
    std::vector<glm::uvec3> result;
    for (const glm::uvec3& wedges : simplified.triangles) result.push_back(positionsAt(mesh, wedges));
    return result;
}

void fitLevel(BlockMesh& mesh, BlockLevel& level) {
    Numbering numbering(mesh.positions.size());
    for (std::size_t i = 0; i < level.simplified.size(); ++i) {
        SimplifiedPiece& simplified = level.simplified[i];
        if (simplified.clustered) continue;
        simplified.moved = fitSurface(mesh, level.piece(i), keptPositions(mesh, simplified), numbering);
    }
}

}  // namespace

std::vector<glm::uvec3> positionsOf(const BlockMesh& mesh, std::span<const MeshTriangle> triangles) {
    std::vector<glm::uvec3> result;
    result.reserve(triangles.size());
    for (const MeshTriangle& t : triangles) result.push_back(positionsAt(mesh, t.wedges));
    return result;
}

std::vector<glm::uvec3> BlockLevel::drawn(const BlockMesh& mesh, std::size_t i) const {
    if (isLeaves()) return positionsOf(mesh, piece(i));
    std::vector<glm::uvec3> result = keptPositions(mesh, simplified[i]);
    for (glm::uvec3& t : result) {
        for (int k = 0; k < 3; ++k) t[k] = simplified[i].drawnAt(t[k]);
    }
    return result;
}

std::vector<BlockLevel> makeLevels(BlockMesh& mesh, Level root, const BuildSettings& settings,
                                   SplitCounters& counters) {
    std::vector<BlockLevel> levels(1);
    levels[0].original = std::move(root);
    const auto desired = static_cast<double>(settings.desiredTriangles);
    levels[0].factor = static_cast<double>(levels[0].original.triangles.size()) / desired;
    for (std::size_t depth = 0;; ++depth) {
        BlockLevel& level = levels[depth];
        // factor_0 <= 1: nothing to simplify; further down the printed rule, below 1.
        if (depth == 0 ? level.factor <= 1.0 : level.factor < 1.0) {
            level.factor = 1.0;
            return levels;
        }
        std::vector<std::size_t> aims;
        for (const Piece& piece : level.original.pieces)
            aims.push_back(simplificationAim(piece.size(), level.factor));
        level.simplified = simplifyLevel(mesh, level.original, aims, settings.simplifier);
        if (settings.fit) fitLevel(mesh, level);
        BlockLevel next;
        next.original = splitLevel(mesh, level.original, static_cast<int>(settings.levelFactor), counters);
        next.factor = level.factor / static_cast<double>(settings.levelFactor);
        levels.push_back(std::move(next));
    }
}

}  // namespace fb
