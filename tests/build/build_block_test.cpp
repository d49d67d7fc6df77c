#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/random.h"
#include "block_worlds.h"
#include "build/build_scene.h"
#include "build/simplify_level.h"

namespace fb {
namespace {

using test::blockOf;
using test::makeSheet;
using test::makeSphere;
using test::paintImage;

BuildSettings settingsOf(std::int64_t desired, std::int64_t factor) {
    BuildSettings settings;
    settings.desiredTriangles = desired;
    settings.levelFactor = factor;
    return settings;
}

BlockBuild build(const SourceBlock& block, const BuildSettings& settings) {
    Result<BlockBuild> built = buildBlock(block, settings);
    EXPECT_TRUE(built) << built.error().oneLine();
    return built ? std::move(*built) : BlockBuild{};
}

std::uint32_t trianglesOf(const BuiltNode& node) {
    return node.texturedTriangles + node.untexturedTriangles;
}

std::vector<int> nodesPerLevel(const BlockBuild& built) {
    std::vector<int> counts;
    for (const BuiltNode& node : built.block.nodes) {
        counts.resize(std::max<std::size_t>(counts.size(), node.level + 1u), 0);
        ++counts[node.level];
    }
    return counts;
}

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
            EXPECT_LE(trianglesOf(node), 24u);
            EXPECT_GE(trianglesOf(node), 2u);
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
                    std::sqrt(static_cast<float>(trianglesOf(node)) * node.areaSquareMetres), 1e-3f);
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

double ripple(double x, double y) {
    return 0.3 * std::sin(1.3 * x) * std::cos(0.9 * y) + 0.05 * std::sin(11 * x + 5 * y);
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

struct NodeView {
    const BlockBuild& built;
    std::size_t node;

    [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const {
        const NodeVertex& v = built.nodes[node].mesh.vertices[vertex];
        return built.block.grid.origin + built.block.grid.step * glm::dvec3(v.x, v.y, v.z);
    }
};

double meshArea(const BlockBuild& built, std::size_t node) {
    const NodeMesh& mesh = built.nodes[node].mesh;
    const auto at = [&](std::size_t i) {  // without the grid's origin, which may be large against the node
        const NodeVertex& v = mesh.vertices[mesh.indices[i]];
        return built.block.grid.step * glm::dvec3(v.x, v.y, v.z);
    };
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        area += 0.5 * glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)));
    }
    return area;
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
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        if (NodeView{built, node}.at(i).x == metres)
            result.insert({mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z});
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

Image decode(const NodeData& node) {
    NodeData alone;
    alone.texture = node.texture;
    alone.mesh.vertices.resize(3);
    alone.mesh.indices = {0, 1, 2};
    alone.mesh.texturedTriangles = 1;
    const Result<DecodedNode> decoded = decodeNode(alone, BlockGrid{}, "test");
    EXPECT_TRUE(decoded) << decoded.error().oneLine();
    return {node.texture.width, node.texture.height, 4,
            decoded ? decoded->texels : std::vector<std::uint8_t>(), false};
}

glm::vec3 bilinear(const Image& image, const glm::dvec2& at) {
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 4; ++k) {
        const double cx = std::clamp(at.x - 0.5, 0.0, image.width - 1.0),
                     cy = std::clamp(at.y - 0.5, 0.0, image.height - 1.0);
        const int x = std::min(static_cast<int>(cx) + (k & 1), image.width - 1);
        const int y = std::min(static_cast<int>(cy) + (k >> 1), image.height - 1);
        const double fx = cx - std::floor(cx), fy = cy - std::floor(cy);
        const double weight = ((k & 1) != 0 ? fx : 1 - fx) * ((k >> 1) != 0 ? fy : 1 - fy);
        const std::size_t texel = (static_cast<std::size_t>(y) * image.width + x) * image.channels;
        for (int c = 0; c < 3; ++c) sum[c] += static_cast<float>(weight) * image.pixels[texel + c];
    }
    return sum;
}

// Random points on a node's triangles, with the colour that the node shows there.
template <class Visit>
void visitPoints(const BlockBuild& built, std::size_t node, Random& random, int count, Visit&& visit) {
    const NodeMesh& mesh = built.nodes[node].mesh;
    const Image atlas = mesh.texturedTriangles > 0 ? decode(built.nodes[node]) : Image{};
    for (int i = 0; i < count; ++i) {
        const std::size_t t = random.index(mesh.indices.size() / 3);
        double a = random.uniform(), b = random.uniform();
        if (a + b > 1.0) {
            a = 1.0 - a;
            b = 1.0 - b;
        }
        const double weights[3] = {1.0 - a - b, a, b};
        glm::dvec3 point(0.0);
        glm::dvec2 texel(0.0);
        glm::vec3 colour(0.0f);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t index = mesh.indices[3 * t + k];
            const NodeVertex& v = mesh.vertices[index];
            point += NodeView{built, node}.at(index) * weights[k];
            texel += glm::dvec2(v.u / 65535.0 * atlas.width, v.v / 65535.0 * atlas.height) * weights[k];
            colour += glm::vec3(v.colour[0], v.colour[1], v.colour[2]) * static_cast<float>(weights[k]);
        }
        if (t < mesh.texturedTriangles) colour *= bilinear(atlas, texel) / 255.0f;
        visit(point, colour);
    }
}

TEST(BuildBlock, ReproducesTheSourcesTexelsInLosslessLeaves) {
    // 64 x 64 texels over 16 x 16 squares; leaves of 4 x 16 and then 4 x 4 squares: cuts between texels.
    Random random(3);
    const auto image = paintImage(
        64, 64, [&](int, int) { return glm::u8vec3(random.bits(), random.bits(), random.bits()); });
    BuildSettings settings = settingsOf(64, 4);
    settings.textureCodec = TextureCodec::lossless;
    const BlockBuild built = build(blockOf(makeSheet({16, 16, 16.0, 16.0, {}}), image), settings);
    ASSERT_EQ(nodesPerLevel(built), (std::vector<int>{1, 4, 16}));
    std::size_t texels = 0;
    for (std::size_t i = 0; i < built.nodes.size(); ++i) {
        if (built.block.nodes[i].level != 2) continue;
        const NodeTexture& texture = built.nodes[i].texture;
        EXPECT_EQ(texture.codec, PayloadCodec::png);
        texels += static_cast<std::size_t>(texture.width) * texture.height;
        const Image atlas = decode(built.nodes[i]);
        // 4 x 4 squares of 4 x 4 texels each, at the place that the node's box has in the picture.
        const int left = static_cast<int>(built.block.nodes[i].bounds.min.x) * 4;
        const int top = static_cast<int>(built.block.nodes[i].bounds.min.y) * 4;
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 16; ++x) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_EQ(atlas.pixels[static_cast<std::size_t>(y * 16 + x) * 4 + c],
                              image->pixels[static_cast<std::size_t>((top + y) * 64 + left + x) * 3 + c]);
                }
            }
        }
        visitPoints(built, i, random, 20, [&](const glm::dvec3& point, const glm::vec3& colour) {
            const double dx = point.x * 4 - std::floor(point.x * 4),
                         dy = point.y * 4 - std::floor(point.y * 4);
            if (std::min(std::min(dx, 1 - dx), std::min(dy, 1 - dy)) < 0.01) return;
            // Away from the leaf's edge, where what the gutter holds does not matter.
            const glm::vec3 wanted = bilinear(*image, glm::dvec2(point.x * 4, point.y * 4));
            const double edgeX = std::min(point.x * 4 - left, left + 16 - point.x * 4);
            const double edgeY = std::min(point.y * 4 - top, top + 16 - point.y * 4);
            if (std::min(edgeX, edgeY) > 0.5) {
                EXPECT_LE(glm::length(colour - wanted), 1.0f);
            }
        });
    }
    EXPECT_EQ(texels, 64u * 64u);  // all texels of the source, once
}

TEST(BuildBlock, ShrinksTexturesByTheFactorOfTheirLevel) {
    const auto image = paintImage(256, 256, [](int x, int y) { return glm::u8vec3(x, y, 0); });
    const BlockBuild built = build(blockOf(makeSheet({32, 32, 32.0, 32.0, {}}), image), settingsOf(32, 4));
    // Factors 64, 16, 4, 1, 1/4: root 256/8 texels wide; a level-1 node 64 x 256 texels of the source / 4; …
    ASSERT_EQ(nodesPerLevel(built).size(), 5u);
    const std::vector<std::pair<int, int>> sides = {{32, 32}, {16, 64}, {32, 32}, {16, 64}, {16, 16}};
    for (const BuiltNode& node : built.block.nodes) {
        EXPECT_EQ(node.textureWidth, sides[node.level].first);
        EXPECT_EQ(node.textureHeight, sides[node.level].second);
    }
}

TEST(BuildBlock, ShowsTheSourcesColoursAtEveryLevel) {
    const auto paint = [](double x, double y) {
        return glm::vec3(30 + 6 * x, 20 + 7 * y, 100 + 3 * (x - y));
    };
    const auto image = paintImage(
        256, 256, [&](int x, int y) { return glm::u8vec3(paint((x + 0.5) / 8, (y + 0.5) / 8) + 0.5f); });
    BuildSettings settings = settingsOf(64, 4);
    settings.textureCodec = TextureCodec::lossless;
    for (const Simplifier simplifier : {Simplifier::meshoptimizer, Simplifier::openMesh}) {
        settings.simplifier = simplifier;
        const BlockBuild built = build(blockOf(makeSheet({32, 32, 32.0, 32.0, ripple}), image), settings);
        Random random(11);
        for (std::size_t i = 0; i < built.nodes.size(); ++i) {
            EXPECT_EQ(built.nodes[i].mesh.untexturedTriangles, 0u);
            visitPoints(built, i, random, 40, [&](const glm::dvec3& point, const glm::vec3& colour) {
                // Half a texel of the root, 8 source texels of 1/8 m, is 3.5 at the edges of the picture.
                EXPECT_LE(glm::length(colour - paint(point.x, point.y)),
                          built.block.nodes[i].level == 0 ? 6.0f : 4.5f);
            });
        }
    }
}

// Every square shows a tile of its own, anywhere in the texture: no chart is larger than two triangles, so
// coarse levels cannot use the source's texture coordinates. What they show must be right all the same.
TEST(BuildBlock, ShowsTheRightColoursWhereTheTextureIsAllSeams) {
    constexpr int kTiles = 32, kTile = 8;
    const auto paint = [](double x, double y) {
        return glm::vec3(30 + 6 * x, 20 + 7 * y, 100 + 3 * (x - y));
    };
    const auto placeOf = [](int square) {
        return (square * 389) % (kTiles * kTiles);
    };  // 389 and 1024 have no common factor
    std::vector<int> squareAt(kTiles * kTiles);
    for (int s = 0; s < kTiles * kTiles; ++s) squareAt[static_cast<std::size_t>(placeOf(s))] = s;
    const auto image = paintImage(kTiles * kTile, kTiles * kTile, [&](int x, int y) {
        const int square = squareAt[static_cast<std::size_t>(y / kTile * kTiles + x / kTile)];
        // The outermost ring of each tile repeats its neighbours, as padding does.
        const double fx = std::clamp((x % kTile - 0.5) / (kTile - 2), 0.0, 1.0),
                     fy = std::clamp((y % kTile - 0.5) / (kTile - 2), 0.0, 1.0);
        return glm::u8vec3(paint(square % kTiles + fx, square / kTiles + fy) + 0.5f);
    });
    const SourceMesh sheet = makeSheet({kTiles, kTiles, double(kTiles), double(kTiles), ripple});
    SourceMesh torn;
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        const int square = static_cast<int>(t / 2), place = placeOf(square);
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = sheet.positions[sheet.triangles[t][k]];
            torn.positions.push_back(p);
            const glm::dvec2 in(p.x - square % kTiles, p.y - square / kTiles);
            const glm::dvec2 at =
                glm::dvec2(place % kTiles, place / kTiles) * double(kTile) + 1.0 + in * double(kTile - 2);
            torn.uvs.emplace_back(at / double(kTiles * kTile));
        }
        const auto first = static_cast<std::uint32_t>(3 * t);
        torn.triangles.emplace_back(first, first + 1, first + 2);
    }
    BuildSettings settings = settingsOf(128, 4);  // 2048 triangles: factors 16, 4, 1
    settings.textureCodec = TextureCodec::lossless;
    const BlockBuild built = build(blockOf(torn, image), settings);
    EXPECT_EQ(built.report.stuckNodes, 0u);
    Random random(5);
    for (std::size_t i = 0; i < built.nodes.size() && built.block.nodes[i].level < 2; ++i) {
        EXPECT_EQ(built.nodes[i].mesh.untexturedTriangles, 0u);
        double sum = 0.0;
        int count = 0, far = 0;
        visitPoints(built, i, random, 400, [&](const glm::dvec3& point, const glm::vec3& colour) {
            const float off = glm::length(colour - paint(point.x, point.y));
            far += off > 25.0f ? 1 : 0;
            sum += off;
            ++count;
        });
        EXPECT_LE(sum / count, 4.0) << "node " << i;
        // On slivers thinner than a texel, at the border.
        EXPECT_LE(far, 2) << "node " << i;
    }
}

TEST(BuildBlock, CarriesVertexColoursWithoutTexture) {
    SourceMesh sheet = makeSheet({32, 32, 32.0, 32.0, ripple});
    sheet.uvs.clear();
    for (const glm::dvec3& p : sheet.positions) sheet.colours.emplace_back(p.x * 7, p.y * 7, 50, 255);
    const BlockBuild built = build(blockOf(sheet), settingsOf(64, 4));
    Random random(2);
    for (std::size_t i = 0; i < built.nodes.size(); ++i) {
        visitPoints(built, i, random, 20, [&](const glm::dvec3& point, const glm::vec3& colour) {
            EXPECT_LE(glm::length(colour - glm::vec3(point.x * 7, point.y * 7, 50)), 2.0f);
        });
    }
}

TEST(BuildBlock, ChoosesTheCodecByWhatTheTextureNeeds) {
    const auto codecs = [](const SourceBlock& block, TextureCodec wanted) {
        BuildSettings settings = settingsOf(64, 4);
        settings.textureCodec = wanted;
        std::set<PayloadCodec> found;
        for (const NodeData& node : build(block, settings).nodes) found.insert(node.texture.codec);
        return found;
    };
    SourceBlock block = blockOf(makeSheet({16, 16, 16.0, 16.0, {}}),
                                paintImage(32, 32, [](int x, int) { return glm::u8vec3(x, 0, 0); }));
    EXPECT_EQ(codecs(block, TextureCodec::automatic), std::set{PayloadCodec::jpeg});  // generated
    EXPECT_EQ(codecs(block, TextureCodec::jpeg), std::set{PayloadCodec::jpeg});
    EXPECT_EQ(codecs(block, TextureCodec::lossless), std::set{PayloadCodec::png});
    auto masked = std::make_shared<Image>(Image{8, 8, 4, std::vector<std::uint8_t>(256, 100), true});
    block.textures[0].image = masked;
    block.materials[0].alphaMask = true;
    EXPECT_EQ(codecs(block, TextureCodec::jpeg), std::set{PayloadCodec::png});
    block.materials[0].texture = -1;
    EXPECT_EQ(codecs(block, TextureCodec::automatic), std::set{PayloadCodec::none});
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
    EXPECT_FALSE(buildBlock(block, BuildSettings{}));
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
    const Result<BlockBuild> built =
        buildBlock(blockOf(soup, random.index(2) == 0 ? image : nullptr), settings);
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
