// What `info` says of a scene, on hand-made hierarchies.
#include "measure/scene_health.h"

#include <gtest/gtest.h>

#include "worlds/tiny_worlds.h"

namespace fb {
namespace {

// `roots` blocks of a root with four leaves each; c_desiredTris is 100 and every node has as many triangles, textured.
Scene healthyScene(std::uint32_t roots = 10) {
    Scene scene;
    TinyNode root;
    root.cost = 50;
    root.children.assign(4, TinyNode{.cost = 50});
    scene.hierarchy = makeWorld(std::vector<TinyNode>(roots, root));
    for (NodeId n = 0; n < scene.hierarchy.size(); ++n) {
        scene.hierarchy.textureWidth[n] = scene.hierarchy.textureHeight[n] = 64;
        scene.hierarchy.residentBytes[n] = 1000;
    }
    scene.info.desiredTriangles = 100;
    scene.info.levelFactor = 4;
    return scene;
}

// The one warning, or a list of them.
std::string warningsOf(const Scene& scene) {
    std::string all;
    for (const std::string& line : measureHealth(scene).warnings) all += (all.empty() ? "" : "\n") + line;
    return all;
}

TEST(SceneHealth, CountsWhatEachLevelHas) {
    Scene scene = healthyScene();
    Hierarchy& h = scene.hierarchy;
    h.skirtTriangles[3] = 20;  // of 100
    h.geometricErrorMetres[3] = 2.0f;
    h.borderErrorMetres[3] = 0.25f;
    const SceneHealth health = measureHealth(scene);
    ASSERT_EQ(health.objects.size(), 2u);
    EXPECT_TRUE(health.terrain.empty());
    EXPECT_EQ(health.depth, 1u);
    EXPECT_EQ(health.rootBytes, 10'000u);
    EXPECT_EQ(health.untexturedShare, 0.0);
    EXPECT_TRUE(health.errorIsMonotone);
    EXPECT_EQ(health.emptyPieces, 0u);
    const LevelFacts& top = health.objects[0];
    EXPECT_EQ(top.nodes, 10u);
    EXPECT_EQ(top.leaves, 0u);
    EXPECT_EQ(top.triangles(), 1000u);
    EXPECT_EQ(top.skirtTriangles, 20u);
    EXPECT_DOUBLE_EQ(top.fill(100), 0.98);
    EXPECT_DOUBLE_EQ(top.fillLow, 0.8);
    EXPECT_DOUBLE_EQ(top.fillHigh, 1.0);
    EXPECT_DOUBLE_EQ(top.meanError(), (9 * 0.5 + 2.0) / 10);
    EXPECT_EQ(top.errorMaxMetres, 2.0);
    EXPECT_EQ(top.gapMaxMetres, 0.25);
    EXPECT_EQ(top.texels, 10u * 64 * 64);
    EXPECT_EQ(health.objects[1].leaves, 40u);
    EXPECT_EQ(warningsOf(scene), "");
}

TEST(SceneHealth, KeepsTerrainApart) {
    Scene scene = healthyScene();
    scene.hierarchy.kinds[9] = BlockKind::terrain;
    const SceneHealth health = measureHealth(scene);
    ASSERT_EQ(health.terrain.size(), 2u);
    EXPECT_EQ(health.terrain[0].nodes, 1u);
    EXPECT_EQ(health.objects[0].nodes, 9u);
}

TEST(SceneHealth, CountsPiecesThatWereEmpty) {
    Scene scene = healthyScene();
    scene.info.levelFactor = 6;
    EXPECT_EQ(measureHealth(scene).emptyPieces, 20u);
}

TEST(SceneHealth, SeesAnErrorThatGrowsDownwards) {
    Scene scene = healthyScene();
    scene.hierarchy.geometricErrorMetres[12] = 3.0f;
    EXPECT_FALSE(measureHealth(scene).errorIsMonotone);
}

TEST(SceneHealth, WarnsOfStuckNodes) {
    Scene scene = healthyScene();
    scene.hierarchy.stuck[3] = 1;
    EXPECT_NE(warningsOf(scene).find("level 0: 1 of 10 nodes could not be simplified enough"), std::string::npos);
}

TEST(SceneHealth, WarnsOfThinAndOfFatLevels) {
    Scene scene = healthyScene();
    scene.info.desiredTriangles = 1000;
    EXPECT_NE(warningsOf(scene).find("level 1: nodes hold 10 % of c_desiredTris"), std::string::npos);
    scene.info.desiredTriangles = 40;
    const std::string fat = warningsOf(scene);
    EXPECT_NE(fat.find("level 0: nodes hold 2.5 times"), std::string::npos);
    EXPECT_EQ(fat.find("level 1"), std::string::npos);  // leaves have what the source has
    scene.info.desiredTriangles = 0;                    // not known
    EXPECT_EQ(warningsOf(scene), "");
}

TEST(SceneHealth, WarnsWhereSkirtsAreManyOrTexturesAreLost) {
    Scene scene = healthyScene();
    for (NodeId n = 10; n < 50; ++n) scene.hierarchy.skirtTriangles[n] = 30;
    EXPECT_NE(warningsOf(scene).find("level 1: 30 % of the triangles are skirts"), std::string::npos);
    scene = healthyScene();
    scene.hierarchy.textureWidth[0] = 0;
    EXPECT_NE(warningsOf(scene).find("level 0: 1 of 10 nodes lost their texture"), std::string::npos);
    scene = healthyScene();
    for (NodeId n = 10; n < 20; ++n)
        std::swap(scene.hierarchy.texturedTriangles[n], scene.hierarchy.untexturedTriangles[n]);
    EXPECT_NE(warningsOf(scene).find("25 % of the leaves' triangles have no texture"), std::string::npos);
}

TEST(SceneHealth, WarnsWhereRefiningGainsNothing) {
    Scene scene;
    TinyNode leaf{.cost = 50}, middle{.cost = 50, .children = {leaf, leaf}};
    TinyNode root{.cost = 50, .children = {middle, middle}};
    scene.hierarchy = makeWorld({root});
    scene.info.desiredTriangles = 100;
    EXPECT_EQ(warningsOf(scene), "");  // the error halves
    scene.hierarchy.geometricErrorMetres[1] = scene.hierarchy.geometricErrorMetres[2] = 0.95f;
    EXPECT_NE(warningsOf(scene).find("refining from level 0 to 1 takes only 5 %"), std::string::npos);
}

TEST(SceneHealth, WarnsWhereNothingCanBeSelected) {
    Scene scene;
    scene.hierarchy = makeWorld({TinyNode{.cost = 50}});
    scene.info.desiredTriangles = 100;
    EXPECT_NE(warningsOf(scene).find("every block is one node"), std::string::npos);
}

}  // namespace
}  // namespace fb
