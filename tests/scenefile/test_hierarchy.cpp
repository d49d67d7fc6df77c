#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "scenefile/hierarchy.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/limits.h"
#include "scenefile/node_data.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::lineOf;
using test::says;

//      0       1        roots of blocks 0 and 1
//     / \      |
//    2   3     4
//        |
//        5
Hierarchy sixNodes() {
    Hierarchy h;
    h.resize(6);
    h.rootCount = 2;
    h.grids.resize(2);
    h.kinds.resize(2);
    h.parent = {kNoNode, kNoNode, 0, 0, 1, 3};
    h.firstChild = {2, 4, kNoNode, 5, kNoNode, kNoNode};
    h.childCount = {2, 1, 0, 1, 0, 0};
    h.level = {0, 0, 1, 1, 1, 2};
    h.block = {0, 1, 0, 0, 1, 0};
    h.geometricErrorMetres = {4, 3, 0, 2, 0, 0};
    for (NodeId n = 0; n < 6; ++n)
        h.bounds[n] = {glm::vec3(0.0f), glm::vec3(8.0f - static_cast<float>(h.level[n]))};
    return h;
}

TEST(CheckHierarchy, AcceptsSixSoundNodes) {
    EXPECT_EQ(lineOf(checkHierarchy(sixNodes())), "no error");
}

TEST(CheckHierarchy, NamesTheNodeThatBreaksARule) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    struct Case {
        std::function<void(Hierarchy&)> damage;
        std::string error;
    };
    const std::vector<Case> cases = {
        {[](Hierarchy& h) { h.resize(0); }, "no nodes"},
        {[](Hierarchy& h) { h.level.pop_back(); }, "differ in length"},
        {[](Hierarchy& h) { h.payload.emplace_back(); }, "differ in length"},
        {[](Hierarchy& h) { h.rootCount = 0; }, "number of roots"},
        {[](Hierarchy& h) { h.rootCount = 7; }, "number of roots"},
        {[](Hierarchy& h) { h.grids.pop_back(); }, "one root, one grid and one kind"},
        {[](Hierarchy& h) { h.kinds.pop_back(); }, "one root, one grid and one kind"},
        {[](Hierarchy& h) { h.grids[1].step = 0.3; }, "block 1: the grid's step is not a power of two"},
        {[](Hierarchy& h) { h.grids[1].step = -0.5; }, "block 1: the grid's step"},
        {[](Hierarchy& h) { h.grids[1].step = 0.0; }, "block 1: the grid's step"},
        {[&](Hierarchy& h) { h.grids[1].step = inf; }, "block 1: the grid's step"},
        {[&](Hierarchy& h) { h.grids[1].step = nan; }, "block 1: the grid's step"},
        {[](Hierarchy& h) { h.grids[0].step = std::ldexp(1.0, 41); },
         "block 0: the grid's step is out of range"},
        {[](Hierarchy& h) { h.grids[0].step = std::ldexp(1.0, -61); },
         "block 0: the grid's step is out of range"},
        {[&](Hierarchy& h) { h.grids[0].origin.y = nan; }, "block 0: the grid's origin"},
        {[](Hierarchy& h) { h.grids[0].origin.z = 1e13; }, "block 0: the grid's origin"},
        {[](Hierarchy& h) { h.parent[1] = 0; }, "node 1: roots must come first"},
        {[](Hierarchy& h) { h.parent[2] = kNoNode; }, "node 2: roots must come first"},
        {[](Hierarchy& h) { h.level[0] = 1; }, "node 0: a root must have level 0"},
        {[](Hierarchy& h) { h.block[1] = 0; }, "node 1: root and block"},
        {[](Hierarchy& h) { h.firstChild[2] = 4; }, "node 2: a leaf must not have"},
        {[](Hierarchy& h) { h.firstChild[0] = 3; }, "node 0: the children do not follow"},
        {[](Hierarchy& h) { h.childCount[1] = 2; }, "node 3: the children do not follow"},
        {[](Hierarchy& h) { h.childCount[3] = 2; }, "node 3: there are more children"},
        {[](Hierarchy& h) { h.childCount[3] = ~0u; }, "node 3: there are more children"},
        {[](Hierarchy& h) { h.childCount[3] = 0, h.firstChild[3] = kNoNode, h.geometricErrorMetres[3] = 0; },
         "node 5: the parent does not know this child"},
        {[](Hierarchy& h) { h.parent[2] = 1; }, "node 2: the parent does not know this child"},
        {[](Hierarchy& h) { h.parent[2] = 2; }, "node 2: the parent must come before"},
        {[](Hierarchy& h) { h.parent[5] = 4'000'000'000u; }, "node 5: the parent must come before"},
        {[](Hierarchy& h) { h.level[5] = 3; }, "node 5: the level must be one more"},
        {[](Hierarchy& h) { h.block[4] = 0; }, "node 4: the block must be the parent's"},
        {[](Hierarchy& h) { h.payload[4].pack = 9; }, "node 4: the pack must be the parent's"},
        {[](Hierarchy& h) { h.bounds[5].max.x = 7.5f; }, "node 5: the bounds must lie inside"},
        {[](Hierarchy& h) { h.bounds[5].min.z = -1e-30f; }, "node 5: the bounds must lie inside"},
        {[](Hierarchy& h) { h.bounds[5] = {}; }, "node 5: the bounds are empty"},
        {[&](Hierarchy& h) { h.bounds[0].max.y = inf; }, "node 0: the bounds are empty or not finite"},
        {[&](Hierarchy& h) { h.bounds[0].min.y = nan; }, "node 0: the bounds are empty or not finite"},
        {[](Hierarchy& h) { h.geometricErrorMetres[3] = 4.5f; }, "node 3: the error must not exceed"},
        {[](Hierarchy& h) { h.geometricErrorMetres[5] = 1.0f; }, "node 5: the error of a leaf"},
        {[&](Hierarchy& h) { h.geometricErrorMetres[0] = nan; },
         "node 0: the error is negative or not finite"},
        {[](Hierarchy& h) { h.staticBenefit[3] = -1.0f; }, "node 3: the benefit"},
        {[&](Hierarchy& h) { h.areaSquareMetres[3] = inf; }, "node 3: the area"},
        {[](Hierarchy& h) { h.normalCoherence[3] = 1.0001f; }, "node 3: the coherence"},
        {[&](Hierarchy& h) { h.normalCoherence[3] = nan; }, "node 3: the coherence"},
        {[](Hierarchy& h) {
             h.averageNormal[3] = {0.0f, 0.5f, 0.0f};
         },
         "node 3: the average normal is neither"},
        {[&](Hierarchy& h) { h.averageNormal[3].x = nan; }, "node 3: the average normal is not finite"},
        {[](Hierarchy& h) { h.vertices[4] = kMaxNodeVertices + 1; }, "node 4: there are more vertices"},
        {[](Hierarchy& h) { h.texturedTriangles[4] = kMaxNodeTriangles, h.untexturedTriangles[4] = 1; },
         "node 4: there are more triangles"},
        {[](Hierarchy& h) { h.texturedTriangles[4] = ~0u, h.untexturedTriangles[4] = 1; },
         "node 4: there are more triangles"},
        {[](Hierarchy& h) { h.skirtTriangles[4] = h.triangles(4) + 1; }, "node 4: there are more skirts"},
        {[&](Hierarchy& h) { h.borderErrorMetres[4] = nan; }, "node 4: the border error"},
        {[](Hierarchy& h) { h.textureWidth[4] = 10, h.textureHeight[4] = 8; }, "node 4: a texture side"},
        {[](Hierarchy& h) { h.textureWidth[4] = 8; }, "node 4: a texture side"},
        {[](Hierarchy& h) { h.textureWidth[4] = 24576, h.textureHeight[4] = 4; }, "node 4: a texture side"},
    };
    for (const Case& each : cases) {
        Hierarchy h = sixNodes();
        each.damage(h);
        EXPECT_TRUE(says(lineOf(checkHierarchy(h)), each.error))
            << each.error << "\nfound: " << lineOf(checkHierarchy(h));
    }
}

TEST(CheckHierarchy, AcceptsEveryCountAtItsCap) {
    Hierarchy h = sixNodes();
    h.vertices[4] = kMaxNodeVertices;
    h.texturedTriangles[4] = kMaxNodeTriangles;
    h.textureWidth[4] = kMaxTextureSide;
    h.textureHeight[4] = 12288;  // 3 * 2^12
    h.grids[0].step = std::ldexp(1.0, kMaxGridExponent);
    h.grids[1].step = std::ldexp(1.0, kMinGridExponent);
    h.normalCoherence[4] = 1.0f;
    h.averageNormal[4] = {0.6f, 0.8f, 0.0f};
    EXPECT_EQ(lineOf(checkHierarchy(h)), "no error");
}

// A chain of one node a level.
Hierarchy chain(std::uint32_t nodes) {
    Hierarchy h;
    h.resize(nodes);
    h.rootCount = 1;
    h.grids.resize(1);
    h.kinds.resize(1);
    for (NodeId n = 0; n < nodes; ++n) {
        h.level[n] = static_cast<std::uint8_t>(n);
        h.bounds[n] = {glm::vec3(0.0f), glm::vec3(1.0f)};
        if (n > 0) h.parent[n] = n - 1;
        if (n + 1 < nodes) h.firstChild[n] = n + 1, h.childCount[n] = 1;
    }
    return h;
}

TEST(CheckHierarchy, AcceptsTheDeepestLevelAndRefusesTheNext) {
    EXPECT_EQ(lineOf(checkHierarchy(chain(kMaxLevel + 1))), "no error");
    EXPECT_TRUE(says(lineOf(checkHierarchy(chain(kMaxLevel + 2))), "node 64: the level is above 63"));
}

TEST(Hierarchy, KnowsNextSiblingsLevelsAndLeaves) {
    const Hierarchy h = sixNodes();
    EXPECT_EQ(h.nextSibling(0), kNoNode);  // roots are no siblings
    EXPECT_EQ(h.nextSibling(2), 3u);
    EXPECT_EQ(h.nextSibling(3), kNoNode);
    EXPECT_EQ(h.nextSibling(5), kNoNode);
    EXPECT_EQ(h.maxLevel(), 2);
    EXPECT_EQ(Hierarchy{}.maxLevel(), 0);
    EXPECT_TRUE(h.isLeaf(4));
    EXPECT_FALSE(h.isLeaf(3));
}

TEST(NodeCost, WeighsTexturedAgainstUntexturedTriangles) {
    Hierarchy h = sixNodes();
    h.texturedTriangles[2] = 1000;
    h.untexturedTriangles[2] = 100;
    EXPECT_DOUBLE_EQ(nodeCost(h, 2, 0.25), 1000 * 0.25 + 100 * 0.75);
    EXPECT_EQ(nodeCost(h, 3, 0.25), 1.0);  // empty nodes cost 1: nothing divides by 0
}

BuiltNode built(std::uint32_t parent, std::uint32_t children, std::uint8_t level, std::uint32_t vertices) {
    BuiltNode node;
    node.parentInBlock = parent;
    node.childCount = children;
    node.level = level;
    node.vertices = vertices;
    node.bounds = {glm::vec3(0.0f), glm::vec3(1.0f)};
    node.payload.offset = vertices;
    return node;
}

TEST(HierarchyFile, RefusesAKindOfBlockThatIsUnknown) {
    Hierarchy h = sixNodes();
    const auto lineWith = [&](BlockKind kind) {
        h.kinds[1] = kind;
        return lineOf(parseHierarchyFile(encodeHierarchyFile({h, {{0, 1000, 1}, {1, 1000, 2}}}), "h"));
    };
    EXPECT_TRUE(says(lineWith(static_cast<BlockKind>(2)), "h: block 1: its kind is unknown"));
    EXPECT_FALSE(says(lineWith(BlockKind::terrain), "kind"));
}

//  block A:  10          block B:  20          block C: no nodes      block D:  30
//           /  \                    |
//         11    12                 21
//                |
//               13
// joined:   0:10  1:20  2:30 | 3:11 4:12  5:21 | 6:13
TEST(JoinBlocks, GoesLevelByLevelThroughAllBlocks) {
    BuiltBlock a, b, c, d;
    a.nodes = {built(0, 2, 0, 10), built(0, 0, 1, 11), built(0, 1, 1, 12), built(2, 0, 2, 13)};
    b.nodes = {built(0, 1, 0, 20), built(0, 0, 1, 21)};
    d.nodes = {built(0, 0, 0, 30)};
    a.grid.step = 1.0, b.grid.step = 2.0, c.grid.step = 4.0, d.grid.step = 8.0;
    b.kind = c.kind = BlockKind::terrain;
    a.nodes[3].textureWidth = a.nodes[3].textureHeight = 4;
    a.nodes[3].texturedTriangles = 2, a.nodes[3].untexturedTriangles = 3;
    const Hierarchy h = joinBlocks({a, b, c, d});
    EXPECT_EQ(lineOf(checkHierarchy(h)), "no error");
    EXPECT_EQ(h.rootCount, 3u);
    EXPECT_EQ(h.vertices, (std::vector<std::uint32_t>{10, 20, 30, 11, 12, 21, 13}));
    EXPECT_EQ(h.parent, (std::vector<NodeId>{kNoNode, kNoNode, kNoNode, 0, 0, 1, 4}));
    EXPECT_EQ(h.firstChild, (std::vector<NodeId>{3, 5, kNoNode, kNoNode, 6, kNoNode, kNoNode}));
    EXPECT_EQ(h.childCount, (std::vector<std::uint32_t>{2, 1, 0, 0, 1, 0, 0}));
    EXPECT_EQ(h.level, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 1, 2}));
    EXPECT_EQ(h.block, (std::vector<std::uint32_t>{0, 1, 2, 0, 0, 1, 0}));
    ASSERT_EQ(h.grids.size(), 3u);
    EXPECT_EQ(h.grids[2].step, 8.0);
    EXPECT_EQ(h.kinds, (std::vector<BlockKind>{BlockKind::objects, BlockKind::terrain, BlockKind::objects}));
    EXPECT_TRUE(h.isTerrain(5));
    EXPECT_FALSE(h.isTerrain(6));
    EXPECT_EQ(h.residentBytes[6], 13u * 24u + 5u * 12u + 84u);
    EXPECT_EQ(h.payload[6].offset, 13u);
}

}  // namespace
}  // namespace fb
