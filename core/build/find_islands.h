// The connected parts of a node's textured triangles, in their textures. Comes from node_triangles; make_charts turns
// islands into charts. An island whose rectangle it fills badly (an oblique strip, a ring) is cut between its triangles
// into parts that together need less room.
#pragma once

#include <span>
#include <vector>

#include "build/joiner.h"
#include "build/node_triangles.h"

namespace fb {

struct Island {
    std::uint32_t surface = 0;
    glm::dvec2 low{0.0},
        high{0.0};          // source texels, moved by whole repeats so that `low` lies in the picture
    glm::dvec2 shift{0.0};  // what was subtracted
};

[[nodiscard]] glm::dvec2 textureSize(const Surface& surface, const BlockTextures& textures);

// Whole texels.
[[nodiscard]] TexelRect rectOf(const glm::dvec2& low, const glm::dvec2& high);

// Grown to blocks of kMipBlock texels.
[[nodiscard]] TexelRect alignedToBlocks(const TexelRect& rect);

// Room that a rectangle of texels takes in an atlas, with gutters.
[[nodiscard]] double atlasTexels(const TexelRect& rect, double scale);

// Sets each textured triangle's chart to the number of its island.
[[nodiscard]] std::vector<Island> findIslands(std::span<NodeTriangle> triangles, const BlockMesh& mesh,
                                              const BlockTextures& textures, double scale);

}  // namespace fb
