// Blocks become hierarchies: shape, measures, borders, what is refused.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/random.h"
#include "build/simplify_level.h"
#include "built_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::build;
using test::makeSheet;
using test::makeSphere;
using test::nodesPerLevel;
using test::NodeView;
using test::paintImage;
using test::ripple;
using test::settingsOf;
using test::trianglesOf;

// 32 x 32 squares of 1 m, 16 triangles wanted: factors 128, 32, 8, 2, 1/2. Cuts across x, y, x, y at whole
// metres, so each of the 256 leaves is 2 x 2 squares and no triangle is cut.
TEST(BuildBlock, MakesTheHierarchyOfASheetOfSquares) {
    const BlockBuild built = build(blockOf(makeSheet({32, 32, 32.0, 32.0, {}})), settingsOf(16, 4));
    EXPECT_EQ(nodesPerLevel(built), (std::vector<int>{1, 4, 16, 64, 256}));
    EXPECT_EQ(built.report.nodes, 341u);
    EXPECT_EQ(built.report.leafTriangles, 2048u);
    EXPECT_EQ(built.report.sourceTriangles, 2048u);
    EXPECT_EQ(built.report.emptyPieces, 0u);
    EXPECT_EQ(built.report.stuckNodes, 0u);
    EXPECT_EQ(built.nodes.size(), 341u);
    for (const BuiltNode& node : built.block.nodes) {
        if (node.level == 4) {
            EXPECT_EQ(trianglesOf(node), 8u);
            EXPECT_EQ(node.vertices, 9u);
            EXPECT_EQ(node.childCount, 0u);
            EXPECT_EQ(node.areaSquareMetres, 4.0f);
            EXPECT_EQ(node.geometricErrorMetres, 0.0f);
        } else {
            EXPECT_LE(trianglesOf(node) - node.skirtTriangles, 24u);
            EXPECT_GE(trianglesOf(node) - node.skirtTriangles, 2u);
            EXPECT_EQ(node.childCount, 4u);
        }
    }
    // Breadth first, children contiguous.
    std::uint32_t next = 1;
    for (std::uint32_t i = 0; i < 341; ++i) {
        for (std::uint32_t c = 0; c < built.block.nodes[i].childCount; ++c, ++next) {
            EXPECT_EQ(built.block.nodes[next].parentInBlock, i);
        }
    }
    EXPECT_EQ(next, 341u);
}

TEST(BuildBlock, StopsWhenTheFactorFallsBelowOne) {
    // 1024 triangles, 16 wanted: factors 64, 16, 4, 1, 1/4 - the printed rule goes on at exactly 1.
    const BlockBuild built = build(blockOf(makeSheet({32, 16, 32.0, 16.0, {}})), settingsOf(16, 4));
    EXPECT_EQ(nodesPerLevel(built).size(), 5u);
    // 1023 and fewer would end one level higher; 1022 triangles (31 x 16 squares are 992):
    EXPECT_EQ(nodesPerLevel(build(blockOf(makeSheet({31, 16, 31.0, 16.0, {}})), settingsOf(16, 4))).size(),
              4u);
}

TEST(BuildBlock, MakesTheRootALeafWhenThereIsNothingToSimplify) {
    const BlockBuild built = build(blockOf(makeSheet({2, 4, 2.0, 4.0, {}})), settingsOf(16, 4));
    ASSERT_EQ(built.block.nodes.size(), 1u);
    EXPECT_EQ(trianglesOf(built.block.nodes[0]), 16u);
    EXPECT_EQ(built.block.nodes[0].geometricErrorMetres, 0.0f);
    EXPECT_EQ(built.block.nodes[0].childCount, 0u);
}

TEST(BuildBlock, CutsEachPieceAcrossTheLongestAxisOfItsOwnBox) {
    // 40 x 10 m: two halves of 20 x 10, quarters of 10 x 10, then (equal sides: x first) 5 x 10.
    const BlockBuild built = build(blockOf(makeSheet({40, 10, 40.0, 10.0, {}})), settingsOf(200, 2));
    ASSERT_EQ(nodesPerLevel(built), (std::vector<int>{1, 2, 4, 8}));
    for (const BuiltNode& node : built.block.nodes) {
        const glm::vec3 size = node.bounds.size();
        EXPECT_NEAR(size.x, 40.0f / static_cast<float>(1 << node.level), 1e-4f);
        EXPECT_NEAR(size.y, 10.0f, 1e-4f);
    }
}

TEST(BuildBlock, MeasuresWhatTheSelectionNeeds) {
    const BlockBuild sheet = build(blockOf(makeSheet({32, 32, 32.0, 32.0, {}})), settingsOf(16, 4));
    for (const BuiltNode& node : sheet.block.nodes) {
        EXPECT_EQ(node.averageNormal, glm::vec3(0, 0, 1));
        EXPECT_NEAR(node.normalCoherence, 1.0f, 1e-6f);
        EXPECT_NEAR(node.staticBenefit,
                    std::sqrt(static_cast<float>(trianglesOf(node) - node.skirtTriangles) * node.areaSquareMetres),
                    1e-3f);
        EXPECT_EQ(node.texturedTriangles, 0u);
    }
    EXPECT_NEAR(sheet.block.nodes[0].areaSquareMetres, 1024.0f, 1e-2f);
    // A closed surface: directions cancel out.
    const BlockBuild sphere = build(blockOf(makeSphere(40, 20)), settingsOf(100000, 4));
    EXPECT_EQ(sphere.block.nodes[0].averageNormal, glm::vec3(0.0f));
    EXPECT_LT(sphere.block.nodes[0].normalCoherence, 1e-3f);
    // A right angle of two equal walls: the mean of (0,0,1) and (1,0,0), of length 1/sqrt(2).
    SourceMesh walls;
    walls.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    walls.triangles = {{0, 1, 2}, {0, 2, 3}};
    const BlockBuild corner = build(blockOf(walls), settingsOf(16, 4));
    EXPECT_NEAR(
        glm::length(corner.block.nodes[0].averageNormal - glm::vec3(std::sqrt(0.5f), 0, std::sqrt(0.5f))),
        0.0f, 1e-6f);
    EXPECT_NEAR(corner.block.nodes[0].normalCoherence, std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(corner.block.nodes[0].areaSquareMetres, 1.0f, 1e-6f);
    EXPECT_NEAR(corner.block.nodes[0].staticBenefit, std::sqrt(2.0f), 1e-6f);
}

TEST(BuildBlock, GivesAGeometricErrorThatBoundsTheDistanceOfTheSource) {
    // One bump of 0.5 m in a sheet that is otherwise flat: whatever drops it is wrong by about that much.
    const auto bump = [](double x, double y) {
        return std::abs(x - 15.0) < 0.1 && std::abs(y - 17.0) < 0.1 ? 0.5 : 0.0;
    };
    const BlockBuild built = build(blockOf(makeSheet({32, 32, 32.0, 32.0, bump})), settingsOf(16, 4));
    float rootTop = 0.0f;
    for (const NodeVertex& v : built.nodes[0].mesh.vertices) {
        rootTop =
            std::max(rootTop, static_cast<float>(built.block.grid.origin.z + built.block.grid.step * v.z));
    }
    EXPECT_GE(built.block.nodes[0].geometricErrorMetres, 0.5f - rootTop - 1e-4f);
    EXPECT_LE(built.block.nodes[0].geometricErrorMetres, 2.0f);
}

double meshArea(const BlockBuild& built, std::size_t node) {
    const NodeMesh& mesh = built.nodes[node].mesh;
    const auto at = [&](std::size_t i) {  // without the grid's origin, which may be large against the node
        const NodeVertex& v = mesh.vertices[mesh.indices[i]];
        return built.block.grid.step * glm::dvec3(v.x, v.y, v.z);
    };
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        if (mesh.isSkirt(static_cast<std::uint32_t>(i / 3))) continue;
        area += 0.5 * glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)));
    }
    return area;
}

// Exact: grid coordinates are whole numbers.
int trianglesWithoutArea(const NodeMesh& mesh) {
    int count = 0;
    const auto at = [&](std::size_t i) {
        const NodeVertex& v = mesh.vertices[mesh.indices[i]];
        return glm::dvec3(v.x, v.y, v.z);
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        count += glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)) == glm::dvec3(0.0) ? 1 : 0;
    return count;
}

// Walls that meet along straight lines, as houses do: collapses along such a line leave triangles without area.
TEST(BuildBlock, LeavesNoTriangleWithoutArea) {
    SourceMesh walls = makeSheet({40, 40, 40.0, 40.0, [](double x, double) { return x < 13.0 ? 0.0 : (x < 27.0 ? 9.0 : 3.0); }});
    for (const Simplifier simplifier : {Simplifier::meshoptimizer, Simplifier::openMesh}) {
        BuildSettings settings = settingsOf(32, 4);
        settings.simplifier = simplifier;
        const BlockBuild built = build(blockOf(walls), settings);
        for (std::size_t i = 0; i < built.nodes.size(); ++i)
            EXPECT_EQ(trianglesWithoutArea(built.nodes[i].mesh), 0) << "node " << i;
    }
}

TEST(BuildBlock, KeepsTheAreaOfTheSourceInItsLeaves) {
    const SourceMesh sheet = makeSheet({60, 50, 61.7, 48.3, ripple});
    for (const std::int64_t factor : {2, 3, 4, 7}) {
        const BlockBuild built = build(blockOf(sheet), settingsOf(64, factor));
        double area = 0.0;
        for (std::size_t i = 0; i < built.nodes.size(); ++i) {
            if (built.block.nodes[i].childCount == 0) area += meshArea(built, i);
        }
        EXPECT_NEAR(area, test::areaOf(sheet), 1e-6 * area);
        EXPECT_NEAR(built.report.leafAreaSquareMetres, area, 1e-6 * area);
        EXPECT_NEAR(built.report.sourceAreaSquareMetres, test::areaOf(sheet), 1e-9 * area);
    }
}

// The positions that a node has on the plane x = `metres`.
std::set<std::array<std::uint32_t, 3>> verticesOnPlane(const BlockBuild& built, std::size_t node,
                                                       double metres) {
    std::set<std::array<std::uint32_t, 3>> result;
    const NodeMesh& mesh = built.nodes[node].mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.isSkirt(static_cast<std::uint32_t>(i / 3))) continue;
        const NodeVertex& v = mesh.vertices[mesh.indices[i]];
        if (NodeView{built, node}.at(mesh.indices[i]).x == metres) result.insert({v.x, v.y, v.z});
    }
    return result;
}

TEST(BuildBlock, GivesSiblingsTheSameVerticesOnTheirCommonBorderAtEveryLevel) {
    for (const Simplifier simplifier : {Simplifier::meshoptimizer, Simplifier::openMesh}) {
        BuildSettings settings = settingsOf(64, 2);
        settings.simplifier = simplifier;
        const BlockBuild built = build(blockOf(makeSheet({61, 30, 64.0, 30.0, ripple})), settings);
        // The root is cut at x = 32; level 1 has two nodes, and below it each side's nodes that touch x = 32
        // are compared together.
        for (int level = 1; level < static_cast<int>(nodesPerLevel(built).size()); ++level) {
            std::set<std::array<std::uint32_t, 3>> left, right;
            for (std::size_t i = 0; i < built.nodes.size(); ++i) {
                if (built.block.nodes[i].level != level) continue;
                std::size_t top = i;
                while (built.block.nodes[top].level > 1) top = built.block.nodes[top].parentInBlock;
                (top == 1 ? left : right).merge(verticesOnPlane(built, i, 32.0));
            }
            EXPECT_GE(left.size(), 3u);
            EXPECT_EQ(left, right) << "level " << level;
        }
    }
}

TEST(BuildBlock, LeavesOutABlockWithoutTrianglesAndSaysSo) {
    SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    mesh.triangles = {{0, 1, 2}};
    const BlockBuild built = build(blockOf(mesh), settingsOf(16, 4));
    EXPECT_TRUE(built.nodes.empty());
    EXPECT_TRUE(built.block.nodes.empty());
    ASSERT_EQ(built.report.warnings.size(), 1u);
    EXPECT_NE(built.report.warnings[0].find("no triangles"), std::string::npos);
}

TEST(BuildBlock, RefusesBrokenBlocks) {
    SourceBlock block = blockOf(makeSheet({2, 2, 1.0, 1.0, {}}));
    block.mesh.triangles[0].x = 77;
    TextureStore store(0);
    EXPECT_FALSE(buildBlock(block, BuildSettings{}, store));
}

// Soups of every size and place, with slivers, flat, collinear and non-manifold triangles: what comes out is
// always a hierarchy that the rest of the program accepts, with all counts and bounds consistent.
RC_GTEST_PROP(BuildBlock, MakesASoundHierarchyOfEveryTriangleSoup, (std::uint64_t seed)) {
    Random random(seed);
    const double size = random.index(3) == 0 ? 1e-6 : (random.index(2) == 0 ? 1e7 : 30.0);
    const double offset = random.index(2) == 0 ? 0.0 : 1e7;
    const std::uint64_t shape = random.index(4);
    SourceMesh soup;
    const std::uint64_t points = 3 + random.index(60);
    for (std::uint64_t i = 0; i < points; ++i) {
        glm::dvec3 p(random.uniform(), random.uniform(), random.uniform());
        if (shape == 1) p.z = 0.25;  // flat
        if (shape == 2)
            p = glm::dvec3(p.x, p.x, p.x + (random.index(8) == 0 ? 1e-5 : 0.0));  // nearly collinear
        if (shape == 3) p *= glm::dvec3(1.0, 1e-4, 1.0);                          // slivers
        soup.positions.push_back(p * size + offset);
        soup.uvs.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2));
    }
    for (std::uint64_t i = 0; i < 1 + random.index(150); ++i) {
        soup.triangles.emplace_back(random.index(points), random.index(points), random.index(points));
    }
    const auto image = paintImage(8, 8, [](int x, int y) { return glm::u8vec3(x * 30, y * 30, 0); });
    BuildSettings settings = settingsOf(16, 2 + static_cast<std::int64_t>(random.index(4)));
    settings.simplifier = random.index(2) == 0 ? Simplifier::meshoptimizer : Simplifier::openMesh;
    TextureStore store(0);
    const Result<BlockBuild> built =
        buildBlock(blockOf(soup, random.index(2) == 0 ? image : nullptr), settings, store);
    RC_ASSERT(built.has_value());
    if (built->nodes.empty()) return;
    const Hierarchy hierarchy = joinBlocks({built->block});
    const Result<void> sound = checkHierarchy(hierarchy);
    if (!sound) RC_FAIL(sound.error().oneLine());
    RC_ASSERT(built->nodes.size() == built->block.nodes.size());
    double leafArea = 0.0;
    for (std::size_t i = 0; i < built->nodes.size(); ++i) {
        const BuiltNode& node = built->block.nodes[i];
        const NodeMesh& mesh = built->nodes[i].mesh;
        RC_ASSERT(trianglesOf(node) > 0u);
        RC_ASSERT(mesh.indices.size() == 3 * std::size_t{trianglesOf(node)});
        RC_ASSERT(mesh.vertices.size() == node.vertices);
        RC_ASSERT(node.texturedTriangles == 0 || node.textureWidth > 0);
        RC_ASSERT(std::isfinite(node.staticBenefit));
        RC_ASSERT(node.staticBenefit > 0.0f);
        RC_ASSERT(trianglesWithoutArea(mesh) == 0);
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
            const glm::dvec3 at = NodeView{*built, i}.at(v);
            RC_ASSERT((Box3d{node.bounds.min, node.bounds.max}.contains(at)));
        }
        if (node.childCount == 0) leafArea += meshArea(*built, i);
    }
    // The grid moves points by up to a step; nothing else may change the area.
    const double perimeter = 6.0 * size * std::sqrt(3.0) *
                             static_cast<double>(built->report.leafTriangles + soup.triangles.size());
    RC_ASSERT(std::abs(leafArea - built->report.sourceAreaSquareMetres) <=
              1e-6 * built->report.sourceAreaSquareMetres + built->block.grid.step * perimeter);
}

}  // namespace
}  // namespace fb
