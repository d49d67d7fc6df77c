// The nodes of a terrain's quadtree, breadth first: which tiles have any cell, and how they hang together.
// Comes from the height pyramid, whose cell of a tile's size says whether there is any below; goes to
// build_terrain.
#pragma once

#include <vector>

#include "build/terrain_heights.h"
#include "build/terrain_layout.h"

namespace fb {

struct TerrainTree {
    struct Node {
        TerrainTile tile;
        std::uint32_t parent = 0, firstChild = 0, childCount = 0;
    };
    std::vector<Node> nodes;
    std::vector<std::uint32_t> firstOfLevel;  // one more than there are levels

    [[nodiscard]] std::uint32_t countOfLevel(std::uint32_t level) const {
        return firstOfLevel[level + 1] - firstOfLevel[level];
    }
};

// Refused: more nodes than a scene may have.
[[nodiscard]] Result<TerrainTree> makeTerrainTree(const TerrainHeights& heights, const TerrainLayout& layout);

}  // namespace fb
