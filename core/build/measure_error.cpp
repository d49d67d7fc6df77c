#include "build/measure_error.h"

#include <algorithm>

#include "build/farthest_from.h"
#include "build/numbering.h"

namespace fb {
namespace {

MeasuredSurface surfaceOf(const BlockMesh& mesh, std::vector<glm::uvec3> triangles, Numbering& numbering) {
    numbering.restart();
    std::vector<glm::vec3> points;
    for (glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const auto [number, isNew] = numbering.take(t[k]);
            if (isNew) points.emplace_back(mesh.positions[t[k]]);
            t[k] = number;
        }
    }
    return {std::move(points), std::move(triangles)};
}

// Pieces of some finer level: those of one parent stand together.
struct Range {
    std::size_t begin = 0, end = 0;
};

// Of one level: by piece, what is drawn, the pieces of the finest inner level that it contains, and how far
// it lies from the original.
struct Measured {
    std::vector<std::vector<glm::uvec3>> drawn;
    std::vector<Range> originals;
    std::vector<double> backward;
};

std::vector<Range> childrenOf(const Level& finer, std::size_t pieces) {
    std::vector<Range> children(pieces);
    for (std::size_t i = 0; i < finer.pieces.size(); ++i) {
        Range& range = children[finer.pieces[i].parent];
        if (range.end == 0) range.begin = i;
        range.end = i + 1;
    }
    return children;
}

}  // namespace

std::vector<std::vector<double>> measureErrors(const BlockMesh& mesh, const std::vector<BlockLevel>& levels) {
    std::vector<std::vector<double>> errors(levels.size());
    for (std::size_t l = 0; l < levels.size(); ++l) errors[l].assign(levels[l].original.pieces.size(), 0.0);
    if (levels.size() < 2) return errors;

    const std::size_t finest = levels.size() - 2;
    Numbering numbering(mesh.positions.size());
    std::vector<MeasuredSurface> originals;
    for (std::size_t i = 0; i < levels[finest].original.pieces.size(); ++i)
        originals.push_back(surfaceOf(mesh, positionsOf(mesh, levels[finest].piece(i)), numbering));

    Measured finer;
    for (std::size_t l = finest + 1; l-- > 0;) {
        const std::size_t pieces = levels[l].original.pieces.size();
        const std::vector<Range> children =
            l == finest ? std::vector<Range>{} : childrenOf(levels[l + 1].original, pieces);
        Measured here;
        for (std::size_t i = 0; i < pieces; ++i) {
            here.drawn.push_back(levels[l].drawn(mesh, i));
            const MeasuredSurface surface = surfaceOf(mesh, here.drawn.back(), numbering);
            double below = 0.0, behind = 0.0;
            std::vector<glm::uvec3> drawnBelow;  // by the children
            if (l == finest) {
                here.originals.push_back({i, i + 1});
            } else {
                const Range range = children[i];
                here.originals.push_back(
                    {finer.originals[range.begin].begin, finer.originals[range.end - 1].end});
                for (std::size_t c = range.begin; c < range.end; ++c) {
                    drawnBelow.insert(drawnBelow.end(), finer.drawn[c].begin(), finer.drawn[c].end());
                    behind = std::max(behind, finer.backward[c]);
                    below = std::max(below, errors[l + 1][c]);
                }
            }
            double forward = 0.0;
            for (std::size_t o = here.originals[i].begin; o < here.originals[i].end; ++o)
                forward = farthestFrom(originals[o], surface, forward);
            // Only what exceeds `forward` matters.
            const double left = std::max(0.0, forward - behind);
            const double backward =
                behind +
                (l == finest
                     ? farthestFrom(surface, originals[i], left)
                     : farthestFrom(surface, surfaceOf(mesh, std::move(drawnBelow), numbering), left));
            here.backward.push_back(backward);
            // Rounding of cuts finer than `finest` and of the distances themselves.
            errors[l][i] = std::max({forward, backward, below}) + kFarthestUnits;
        }
        finer = std::move(here);
    }
    return errors;
}

}  // namespace fb
