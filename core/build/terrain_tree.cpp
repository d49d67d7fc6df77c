#include "build/terrain_tree.h"

#include "base/check.h"
#include "scenefile/limits.h"

namespace fb {

Result<TerrainTree> makeTerrainTree(const TerrainHeights& heights, const TerrainLayout& layout) {
    TerrainTree tree;
    tree.nodes.push_back({});
    tree.firstOfLevel = {0, 1};
    for (std::uint32_t level = 1; level <= layout.depth; ++level) {
        const std::uint32_t side = layout.sideExponent(level);
        HeightWindow cells{0, 0, heights.columns(side), heights.rows(side), {}};
        if (Result<void> read = heights.read(side, cells); !read) return passOn(read);
        for (std::uint32_t p = tree.firstOfLevel[level - 1]; p < tree.firstOfLevel[level]; ++p) {
            const TerrainTile parent = tree.nodes[p].tile;
            tree.nodes[p].firstChild = static_cast<std::uint32_t>(tree.nodes.size());
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::uint32_t x = parent.x * 2 + k % 2, y = parent.y * 2 + k / 2;
                if (x >= cells.columns || y >= cells.rows || !cells.at(x, y).cell()) continue;
                tree.nodes.push_back({{level, x, y}, p, 0, 0});
                ++tree.nodes[p].childCount;
            }
            FB_CHECK(tree.nodes[p].childCount > 0u);
        }
        if (tree.nodes.size() > kMaxNodes) {
            return failure("terrain", {}, "has more nodes than " + std::to_string(kMaxNodes),
                           "raise build.desired_triangles");
        }
        tree.firstOfLevel.push_back(static_cast<std::uint32_t>(tree.nodes.size()));
    }
    return tree;
}

}  // namespace fb
