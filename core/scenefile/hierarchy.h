// The hierarchy of HLOD nodes in memory: structure of arrays, indexed by NodeId, immutable after opening.
// Order: breadth first over the whole scene. Roots (one a block, level 0) come first, the children of a node are
// contiguous and stand after it: a node's next sibling is the next id while it has the same parent.
// Lengths are metres relative to Scene::origin (thesis 3.3, algorithms section 1).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/ids.h"
#include "base/result.h"

namespace fb {

// Where a node's payload lies on disk.
struct PayloadRef {
    std::uint32_t pack = 0;  // blocks/NNNNN.pack
    std::uint64_t offset = 0;
    std::uint32_t sizeBytes = 0;
    std::uint64_t checksum = 0;  // XXH3-64 of these bytes
};

// Vertices of a block lie on one integer grid, so that the cut borders of its nodes meet exactly:
// position = origin + step * (x, y, z), x, y, z < 2^24. step is a power of two, so the float product is exact.
struct BlockGrid {
    glm::dvec3 origin{0.0};  // relative to the scene's origin
    double step = 1.0;       // metres
};

// What a block's nodes were made from. Every block has one root; a terrain's nodes are squares of a quadtree.
enum class BlockKind : std::uint8_t { objects, terrain };

struct Hierarchy {
    std::uint32_t rootCount = 0;
    std::vector<NodeId> parent;      // kNoNode for roots
    std::vector<NodeId> firstChild;  // kNoNode for leaves
    std::vector<std::uint32_t> childCount;
    std::vector<std::uint8_t> level;
    std::vector<std::uint8_t> stuck;  // 1: has many more triangles than it should, since shapes would be lost
    std::vector<std::uint32_t> block;
    std::vector<Box3f> bounds;  // contains the bounds of all descendants
    std::vector<std::uint32_t> texturedTriangles, untexturedTriangles, vertices;
    std::vector<std::uint32_t> skirtTriangles;  // of the triangles: see NodeMesh
    std::vector<float> staticBenefit;         // sqrt(triangles * area)
    std::vector<glm::vec3> averageNormal;     // unit, or (0,0,0) where directions cancel out
    std::vector<float> normalCoherence;       // |sum of n*area| / area in [0, 1]
    std::vector<float> areaSquareMetres;
    std::vector<float> geometricErrorMetres;  // never larger in a child than in its parent; 0 in leaves
    std::vector<float> borderErrorMetres;  // widest gap to a neighbour of another level, were there no skirts
    std::vector<std::uint16_t> textureWidth, textureHeight;  // 0 without texture
    std::vector<std::uint32_t> residentBytes;  // mesh + texture with mip levels, as uploaded
    std::vector<PayloadRef> payload;
    std::vector<BlockGrid> grids;  // by block
    std::vector<BlockKind> kinds;  // by block

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(parent.size()); }
    [[nodiscard]] bool isLeaf(NodeId n) const { return childCount[n] == 0; }
    [[nodiscard]] bool isTerrain(NodeId n) const { return kinds[block[n]] == BlockKind::terrain; }
    [[nodiscard]] std::uint32_t triangles(NodeId n) const { return texturedTriangles[n] + untexturedTriangles[n]; }
    // As uploaded, with mip levels.
    [[nodiscard]] std::uint64_t textureBytes(NodeId n) const;
    [[nodiscard]] NodeId nextSibling(NodeId n) const {
        return n + 1 < size() && parent[n + 1] == parent[n] && parent[n] != kNoNode ? n + 1 : kNoNode;
    }
    [[nodiscard]] std::uint8_t maxLevel() const;
    void resize(std::size_t nodes);
};

// Weighted triangles: max(1, nTex * w + nUntex * (1 - w)), w = c_textured (thesis eq. 3.1).
[[nodiscard]] double nodeCost(const Hierarchy& hierarchy, NodeId node, double cTextured);

// Everything that the rest of the program believes of a hierarchy: links, contiguous children, levels, finite and
// ordered numbers, bounds and errors that contain the children's. The error names the first node that breaks a rule.
[[nodiscard]] Result<void> checkHierarchy(const Hierarchy& hierarchy);

}  // namespace fb
