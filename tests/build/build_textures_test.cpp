// What the nodes of a built block show: texels, colours, codecs.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "base/random.h"
#include "built_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::build;
using test::makeSheet;
using test::nodesPerLevel;
using test::NodeView;
using test::paintImage;
using test::ripple;
using test::settingsOf;

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
        if (mesh.isSkirt(static_cast<std::uint32_t>(t))) continue;  // hangs from the surface, behind it
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

}  // namespace
}  // namespace fb
