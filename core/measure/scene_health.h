// What a scene is made of, level by level, and whether anything about it will hinder a walk. Comes from openScene();
// printed by `frontbench info`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenefile/scene.h"

namespace fb {

// Sums and extremes over the nodes of one level.
struct LevelFacts {
    std::uint64_t nodes = 0, leaves = 0, stuckNodes = 0, untexturedNodes = 0;
    std::uint64_t texturedTriangles = 0, untexturedTriangles = 0;  // with skirts
    std::uint64_t skirtTriangles = 0;                              // among them
    std::uint64_t texels = 0, diskBytes = 0, residentBytes = 0;
    std::uint64_t mostTriangles = 0;  // of one node, without skirts
    double errorSumMetres = 0.0, errorMaxMetres = 0.0;
    double gapMaxMetres = 0.0;  // to neighbours of other levels, were there no skirts
    double fillLow = 0.0, fillHigh = 0.0;  // of triangles without skirts / c_desiredTris: 5th and 95th percentile

    [[nodiscard]] std::uint64_t triangles() const { return texturedTriangles + untexturedTriangles; }
    [[nodiscard]] double meanError() const { return nodes > 0 ? errorSumMetres / static_cast<double>(nodes) : 0.0; }
    // Mean triangles without skirts over c_desiredTris; 0 when that is not known.
    [[nodiscard]] double fill(std::uint64_t desiredTriangles) const;
};

struct SceneHealth {
    std::vector<LevelFacts> objects, terrain;  // by level; empty when there are none
    std::uint64_t depth = 0;                   // levels below the roots
    std::uint64_t emptyPieces = 0;             // pieces of cut nodes that had no triangle, of objects
    std::uint64_t rootBytes = 0;               // resident, of all roots: the least memory budget
    double untexturedShare = 0.0;              // of the leaves' triangles
    bool errorIsMonotone = true;               // no child's exceeds its parent's
    std::vector<std::string> warnings;         // each with what to do about it
};
[[nodiscard]] SceneHealth measureHealth(const Scene& scene);

}  // namespace fb
