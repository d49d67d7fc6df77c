#include "build/quantise_block.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "block_worlds.h"
#include "build/check_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::makeSheet;

QuantisedBlock quantise(const SourceBlock& block) {
    return quantiseBlock(block, decodeTextures(block));
}

TEST(GridFor, TakesTheFinestPowerOfTwoWhosePointsHoldTheBox) {
    // 2^24 - 2 steps of 1 m just hold this box with a 32nd of room on both sides, one metre more does not fit:
    // (2^24 - 2) / 1.0625 = 15790319.06.
    EXPECT_EQ(gridFor({glm::dvec3(0), glm::dvec3(15790319, 5, 5)}).step, 1.0);
    EXPECT_EQ(gridFor({glm::dvec3(0), glm::dvec3(15790320, 5, 5)}).step, 2.0);
    EXPECT_EQ(gridFor({glm::dvec3(0), glm::dvec3(100, 0, 0)}).step,
              std::ldexp(1.0, -17));  // 106.25 / 2^24 = 6.33e-6
}

TEST(GridFor, PutsItsOriginOnAMultipleOfTheStepBelowTheBox) {
    const BlockGrid grid = gridFor({glm::dvec3(-0.3, 1000.7, 5), glm::dvec3(55.7, 1020, 7)});
    EXPECT_EQ(grid.step, std::ldexp(1.0, -18));
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(grid.origin[axis] / grid.step, std::floor(grid.origin[axis] / grid.step));
    }
    EXPECT_LE(grid.origin.x, -0.3 - 56.0 / 32.0);
    EXPECT_GT(grid.origin.x, -0.3 - 56.0 / 32.0 - 2.0 * grid.step);
}

TEST(QuantiseBlock, MovesNoVertexByMoreThanHalfAStepAlongAnAxis) {
    SourceMesh sheet = makeSheet({5, 4, 37.3, 11.1, [](double x, double y) { return std::sin(x + y); }});
    for (glm::dvec3& p : sheet.positions) p += glm::dvec3(6.5e6, 4.2e5, 113.0);
    const SourceBlock block = blockOf(sheet);
    const QuantisedBlock result = quantise(block);
    ASSERT_EQ(result.triangles.size(), 40u);
    const BlockGrid& grid = result.mesh.grid;
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 at =
                grid.origin + grid.step * glm::dvec3(result.mesh.at(result.triangles[t].wedges[k]));
            const glm::dvec3 moved = glm::abs(at - sheet.positions[sheet.triangles[t][k]]);
            EXPECT_LE(std::max(moved.x, std::max(moved.y, moved.z)), 0.5 * grid.step + 1e-9);  // ulp of 6.5e6
        }
    }
}

TEST(QuantiseBlock, GivesTouchingBlocksTheSamePointsOnTheirCommonBorder) {
    // Both blocks are 64 m wide and have the same step; the border at x = 64 m has awkward coordinates.
    SourceMesh left = makeSheet({7, 9, 64.0, 63.7, {}}), right = left;
    for (glm::dvec3& p : right.positions) p.x += 64.0;
    const QuantisedBlock a = quantise(blockOf(left)), b = quantise(blockOf(right));
    ASSERT_EQ(a.mesh.grid.step, b.mesh.grid.step);
    const auto border = [](const QuantisedBlock& block) {
        std::vector<double> ys;
        for (const GridPoint& p : block.mesh.positions) {
            const glm::dvec3 at = block.mesh.grid.origin + block.mesh.grid.step * glm::dvec3(p);
            if (at.x == 64.0) ys.push_back(at.y);
        }
        std::sort(ys.begin(), ys.end());
        return ys;
    };
    EXPECT_EQ(border(a).size(), 10u);
    EXPECT_EQ(border(a), border(b));
}

TEST(QuantiseBlock, DropsAndCountsTrianglesThatTheGridMakesDegenerate) {
    SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {50, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 1, 5}, {2, 2, 1}};
    const QuantisedBlock result = quantise(blockOf(mesh));
    EXPECT_EQ(result.triangles.size(), 1u);
    EXPECT_EQ(result.degenerateTriangles, 3u);
    EXPECT_NEAR(result.sourceAreaSquareMetres, 5000.0, 1e-6);
}

TEST(QuantiseBlock, MakesOneWedgeOfVerticesThatDifferInNormalOnly) {
    SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const QuantisedBlock result = quantise(blockOf(mesh));
    EXPECT_EQ(result.mesh.positions.size(), 4u);
    EXPECT_EQ(result.mesh.wedges.size(), 4u);
    EXPECT_EQ(result.triangles[0].wedges.x, result.triangles[1].wedges.x);
    EXPECT_NE(result.triangles[0].normals.x, result.triangles[1].normals.x);
}

TEST(QuantiseBlock, MultipliesBaseColourAndVertexColour) {
    SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.colours.assign(3, glm::u8vec4(255, 128, 0, 128));
    mesh.triangles = {{0, 1, 2}};
    SourceBlock block = blockOf(mesh);
    block.materials[0].baseColour = {0.5f, 0.5f, 1.0f, 1.0f};
    const QuantisedBlock opaque = quantise(block);
    EXPECT_EQ(opaque.mesh.wedges[0].colour,
              glm::u8vec4(128, 64, 0, 255));  // alpha counts only where a material masks
    block.materials[0].alphaMask = true;
    EXPECT_EQ(quantise(block).mesh.wedges[0].colour, glm::u8vec4(128, 64, 0, 128));
}

TEST(QuantiseBlock, DrawsTrianglesWithAbsurdTextureCoordinatesUntextured) {
    const auto image = test::paintImage(4, 4, [](int, int) { return glm::u8vec3(9); });
    SourceMesh sheet = makeSheet({2, 1, 2.0, 1.0, {}});
    sheet.uvs[0].x = std::numeric_limits<float>::quiet_NaN();  // corner of both triangles of the first square
    const SourceBlock block = blockOf(sheet, image);
    const QuantisedBlock result = quantise(block);
    EXPECT_EQ(result.unusableUvs, 2u);
    int textured = 0;
    for (const MeshTriangle& t : result.triangles) {
        textured += result.mesh.surfaces[result.mesh.wedges[t.wedges.x].surface].texture == 0 ? 1 : 0;
    }
    EXPECT_EQ(textured, 2);
}

TEST(QuantiseBlock, DrawsTrianglesUntexturedWhoseTextureIsMissingAndSaysSoOnce) {
    SourceBlock block = blockOf(makeSheet({3, 1, 3.0, 1.0, {}}),
                                test::paintImage(1, 1, [](int, int) { return glm::u8vec3(0); }));
    block.textures[0].image = nullptr;
    block.textures[0].file = "/nowhere/wall.png";
    const BlockTextures textures = decodeTextures(block);
    ASSERT_EQ(textures.warnings.size(), 1u);
    EXPECT_NE(textures.warnings[0].find("6 triangles"), std::string::npos) << textures.warnings[0];
    const QuantisedBlock result = quantiseBlock(block, textures);
    EXPECT_EQ(result.mesh.surfaces.size(), 1u);
}

TEST(CheckBlock, RefusesBlocksThatContradictThemselves) {
    const SourceBlock sound = blockOf(makeSheet({2, 2, 1.0, 1.0, {}}));
    SourceBlock block = sound;
    block.mesh.triangles[3].y = 9;
    EXPECT_FALSE(checkBlock(block));
    block = sound;
    block.mesh.materials[0] = 1;
    EXPECT_FALSE(checkBlock(block));
    block = sound;
    block.mesh.normals.resize(8);
    EXPECT_FALSE(checkBlock(block));
    block = sound;
    block.mesh.positions[4].z = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(checkBlock(block));
    block = sound;
    block.mesh.positions[4].z = -6e11;
    EXPECT_FALSE(checkBlock(block));
    EXPECT_TRUE(checkBlock(sound));
}

RC_GTEST_PROP(QuantiseBlock, PutsEverySizeAndOffsetOntoTheGrid, (std::uint64_t seed)) {
    Random random(seed);
    SourceMesh mesh;
    const double size = std::pow(10.0, random.uniform(-9.0, 9.0)),
                 offset = std::pow(10.0, random.uniform(-3.0, 11.0));
    for (int i = 0; i < 30; ++i) {
        mesh.positions.emplace_back(offset + size * random.uniform(), size * random.uniform(),
                                    -offset + size * random.uniform());
    }
    for (std::uint32_t i = 0; i < 30; i += 3) mesh.triangles.emplace_back(i, i + 1, i + 2);
    const QuantisedBlock result = quantise(blockOf(mesh));
    const BlockGrid& grid = result.mesh.grid;
    Box3d bounds;
    for (const glm::dvec3& p : mesh.positions) bounds.grow(p);
    const glm::dvec3 extent = bounds.size();
    const double longest = std::max(extent.x, std::max(extent.y, extent.z));
    RC_ASSERT(longest <= grid.step * (kGridSize - 2));
    RC_ASSERT(longest * 1.0625 > 0.5 * grid.step * (kGridSize - 2));  // with room on both sides
    for (const GridPoint& p : result.mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            RC_ASSERT(p[axis] >= 0);
            RC_ASSERT(p[axis] < kGridSize);
        }
    }
}

}  // namespace
}  // namespace fb
