// The draws of a front, exactly.
#include <gtest/gtest.h>

#include "draw/draw_world.h"
#include "draw/order_draws.h"

namespace fb::draw_test {

namespace {

struct Expected {
    NodeId node;
    std::uint32_t variant, texturePage, meshPage, layer, firstIndex, indexCount, baseVertex;
};

std::vector<Expected> summary(const DrawLists& lists) {
    std::vector<Expected> all;
    for (const Draw& d : lists.draws) {
        all.push_back({d.node, d.variant, d.texturePage, d.meshPage, d.layer, d.firstIndex, d.indexCount,
                       d.baseVertex});
    }
    return all;
}

bool operator==(const Expected& a, const Expected& b) {
    return a.node == b.node && a.variant == b.variant && a.texturePage == b.texturePage &&
           a.meshPage == b.meshPage && a.layer == b.layer && a.firstIndex == b.firstIndex &&
           a.indexCount == b.indexCount && a.baseVertex == b.baseVertex;
}

std::ostream& operator<<(std::ostream& out, const Expected& e) {
    return out << "node " << e.node << " variant " << e.variant << " pages " << e.texturePage << " "
               << e.meshPage << " layer " << e.layer << " indices " << e.firstIndex << "+" << e.indexCount
               << " vertex " << e.baseVertex;
}

}  // namespace

// Node   distance   triangles (textured + plain)   texture page, layer   mesh page, unit, vertices   mask
//  0        9              2 + 0                        1, 5                  0,  0,  4
//  1        3              2 + 1                        0, 2                  0, 10,  7
//  2        6              2 + 0                        0, 1                  0, 20,  4
//  3        1              0 + 4                        -                     0, 30,  8
//  4        2              2 + 0                        0, 0                  1,  0,  4                yes
//  5        4              2 + 0, not resident
//  6        5              0 + 0
TEST(OrderDraws, GroupsByProgramTexturePageAndMeshPageNearestFirst) {
    World world;
    std::vector<GpuNode> gpu(7);
    const auto node = [&](NodeId n, float distance, std::uint32_t textured, std::uint32_t plain,
                          TextureSlot texture, MeshSlot mesh) {
        DecodedNode box;
        box.vertices.push_back(vertex({0, 0, -distance}, kRed));
        world.add(std::move(box));
        mesh.indices = (textured + plain) * 3;
        gpu[n] = {true, n == 4, textured * 3, plain * 3, mesh, texture, 0};
    };
    node(0, 9, 2, 0, {1, 5}, {0, 0, 5, 4, 0});
    node(1, 3, 2, 1, {0, 2}, {0, 10, 9, 7, 0});
    node(2, 6, 2, 0, {0, 1}, {0, 20, 5, 4, 0});
    node(3, 1, 0, 4, {}, {0, 30, 10, 8, 0});
    node(4, 2, 2, 0, {0, 0}, {1, 0, 5, 4, 0});
    node(5, 4, 2, 0, {0, 3}, {0, 40, 5, 4, 0});
    gpu[5].resident = false;
    node(6, 5, 0, 0, {}, {});

    const View view = viewAlongZ({}, 8, 8);
    DrawSettings settings;
    ActiveEffects effects;
    DrawLists lists;
    effects[Effect::texturing] = effects[Effect::lighting] = true;
    orderDraws({world.hierarchy, world.front, view, settings, effects}, gpu, lists);
    EXPECT_EQ(lists.nodes, (std::vector<NodeId>{0, 1, 2, 3, 4, 6}));
    EXPECT_EQ(lists.triangles, 2u + 3 + 2 + 4 + 2);
    // First index: 6 times (unit + vertices), after the textured ones of node 1 six further.
    EXPECT_EQ(summary(lists), (std::vector<Expected>{{3, kLit, kNoPage, 0, 0, 6 * 38, 12, 30},
                                                     {1, kLit, kNoPage, 0, 0, 6 * 17 + 6, 3, 10},
                                                     {1, kLit | kTextured, 0, 0, 2, 6 * 17, 6, 10},
                                                     {2, kLit | kTextured, 0, 0, 1, 6 * 24, 6, 20},
                                                     {0, kLit | kTextured, 1, 0, 5, 6 * 4, 6, 0},
                                                     {4, kLit | kTextured | kMask, 0, 1, 0, 6 * 4, 6, 0}}));
    ASSERT_EQ(lists.batches.size(), 4u);
    const std::array<std::array<std::uint32_t, 2>, 4> firstAndCount = {{{0, 2}, {2, 2}, {4, 1}, {5, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(lists.batches[i].first, firstAndCount[i][0]) << i;
        EXPECT_EQ(lists.batches[i].count, firstAndCount[i][1]) << i;
    }

    // Without texturing a node is one draw, whatever its textures; without light another program.
    effects = {};
    settings.colour = ColourMode::level;
    orderDraws({world.hierarchy, world.front, view, settings, effects}, gpu, lists);
    EXPECT_EQ(summary(lists), (std::vector<Expected>{{3, kLevel, kNoPage, 0, 0, 6 * 38, 12, 30},
                                                     {1, kLevel, kNoPage, 0, 0, 6 * 17, 9, 10},
                                                     {2, kLevel, kNoPage, 0, 0, 6 * 24, 6, 20},
                                                     {0, kLevel, kNoPage, 0, 0, 6 * 4, 6, 0},
                                                     {4, kLevel, kNoPage, 1, 0, 6 * 4, 6, 0}}));
    EXPECT_EQ(lists.batches.size(), 2u);
    EXPECT_EQ(lists.triangles, 13u);
}

}  // namespace fb::draw_test
