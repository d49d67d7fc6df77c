#include <algorithm>

#include "base/check.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

std::size_t nodeCount(const std::vector<BuiltBlock>& blocks) {
    std::size_t count = 0;
    for (const BuiltBlock& block : blocks) count += block.nodes.size();
    return count;
}

void setNode(Hierarchy& h, NodeId id, const BuiltNode& node) {
    h.childCount[id] = node.childCount;
    h.level[id] = node.level;
    h.stuck[id] = node.stuck ? 1 : 0;
    h.bounds[id] = node.bounds;
    h.texturedTriangles[id] = node.texturedTriangles;
    h.untexturedTriangles[id] = node.untexturedTriangles;
    h.skirtTriangles[id] = node.skirtTriangles;
    h.vertices[id] = node.vertices;
    h.staticBenefit[id] = node.staticBenefit;
    h.averageNormal[id] = node.averageNormal;
    h.normalCoherence[id] = node.normalCoherence;
    h.areaSquareMetres[id] = node.areaSquareMetres;
    h.geometricErrorMetres[id] = node.geometricErrorMetres;
    h.borderErrorMetres[id] = node.borderErrorMetres;
    h.textureWidth[id] = node.textureWidth;
    h.textureHeight[id] = node.textureHeight;
    const std::uint64_t bytes =
        residentBytes(node.vertices, node.texturedTriangles + node.untexturedTriangles, node.textureWidth,
                      node.textureHeight);
    h.residentBytes[id] = static_cast<std::uint32_t>(std::min<std::uint64_t>(bytes, ~std::uint32_t{0}));
    h.payload[id] = node.payload;
}

// A block on its way into the hierarchy.
struct Joining {
    const BuiltBlock* block;
    std::vector<NodeId> ids;  // of the nodes that are in already
};

// Appends the block's nodes of one level; their parents are in already.
void appendLevel(Hierarchy& h, Joining& from, std::uint32_t block, std::uint32_t level, NodeId& id) {
    const std::vector<BuiltNode>& nodes = from.block->nodes;
    for (std::size_t i = from.ids.size(); i < nodes.size() && nodes[i].level == level; ++i, ++id) {
        FB_CHECK((i == 0) == (level == 0));
        setNode(h, id, nodes[i]);
        h.block[id] = block;
        from.ids.push_back(id);
        if (i == 0) continue;
        FB_CHECK(nodes[i].parentInBlock < i);
        const NodeId parent = from.ids[nodes[i].parentInBlock];
        h.parent[id] = parent;
        if (h.firstChild[parent] == kNoNode) h.firstChild[parent] = id;
    }
}

}  // namespace

// Breadth first over the scene = level by level, and within a level block by block: a block's own
// breadth-first order is kept, so children stay contiguous. Blocks without nodes are left out; a pack keeps
// the number it was written with.
Hierarchy joinBlocks(const std::vector<BuiltBlock>& blocks) {
    Hierarchy h;
    h.resize(nodeCount(blocks));
    std::vector<Joining> joining;
    for (const BuiltBlock& block : blocks) {
        if (block.nodes.empty()) continue;
        joining.push_back({&block, {}});
        h.grids.push_back(block.grid);
        h.kinds.push_back(block.kind);
    }
    h.rootCount = static_cast<std::uint32_t>(joining.size());
    NodeId id = 0;
    for (std::uint32_t level = 0; id < h.size(); ++level) {
        const NodeId before = id;
        for (std::uint32_t b = 0; b < h.rootCount; ++b) appendLevel(h, joining[b], b, level, id);
        FB_CHECK(id > before);  // else the nodes of some block are not in order of level
    }
    return h;
}

}  // namespace fb
