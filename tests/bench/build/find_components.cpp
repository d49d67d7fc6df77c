#include "find_components.h"

#include <algorithm>

namespace fb::bench {

Components::Components(const PreparedBlock& block)
    : block_(block), ofPosition_(block.mesh.positions.size()), triangles_(block.mesh.positions.size(), 0) {
    Joiner joiner(ofPosition_.size());
    // The last level has every position that a cut made.
    for (const BlockLevel* level : {&block.levels.front(), &block.levels.back()}) {
        for (const glm::uvec3& t : positionsOf(block.mesh, level->original.triangles))
            joiner.join(joiner.join(t.x, t.y), t.z);
    }
    for (std::uint32_t p = 0; p < ofPosition_.size(); ++p) ofPosition_[p] = joiner.find(p);
    for (const glm::uvec3& t : positionsOf(block.mesh, block.levels.front().original.triangles))
        ++triangles_[ofPosition_[t.x]];
}

double Components::longestSideMetres(std::uint32_t component) const {
    Box3d box;
    for (std::uint32_t p = 0; p < ofPosition_.size(); ++p) {
        if (ofPosition_[p] == component) box.grow(glm::dvec3(block_.mesh.positions[p]));
    }
    return box.size()[box.longestAxis()] * block_.mesh.grid.step;
}

std::vector<std::size_t> Components::drawnTriangles(std::size_t level) const {
    const BlockLevel& drawn = block_.levels[block_.levelFor(level)];
    std::vector<std::size_t> counts(ofPosition_.size(), 0);
    for (std::size_t i = 0; i < drawn.original.pieces.size(); ++i) {
        for (const glm::uvec3& t : drawn.drawn(block_.mesh, i)) ++counts[ofPosition_[t.x]];
    }
    return counts;
}

bool Components::isStoodFor(std::uint32_t component, std::size_t level) const {
    const auto isOfComponent = [&](std::uint32_t position) { return ofPosition_[position] == component; };
    return std::ranges::any_of(block_.levels[block_.levelFor(level)].simplified, [&](const SimplifiedPiece& piece) {
        return std::ranges::any_of(piece.replaced, isOfComponent);
    });
}

VanishedParts Components::vanishedAt(std::size_t level) const {
    VanishedParts result;
    const std::vector<std::size_t> drawn = drawnTriangles(level);
    for (std::size_t c = 0; c < drawn.size(); ++c) {
        if (triangles_[c] == 0) continue;
        ++result.parts;
        if (drawn[c] > 0) continue;
        if (isStoodFor(static_cast<std::uint32_t>(c), level)) {
            ++result.stoodFor;
            continue;
        }
        ++result.vanished;
        result.triangles += triangles_[c];
    }
    return result;
}

}  // namespace fb::bench
