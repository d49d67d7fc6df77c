#include "build/make_atlas.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"
#include "block_worlds.h"
#include "build/make_charts.h"
#include "build/pack_atlas.h"
#include "build/quantise_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::makeSheet;
using test::paintImage;

glm::u8vec3 everyTexelItsOwn(int x, int y) {
    return {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
            static_cast<std::uint8_t>((x * 7 + y * 13) % 251)};
}

struct World {
    BlockTextures textures;
    BlockMesh mesh;
    std::vector<NodeTriangle> triangles;

    explicit World(const SourceBlock& block) : textures(decodeTextures(block)) {
        QuantisedBlock quantised = quantiseBlock(block, textures);
        mesh = std::move(quantised.mesh);
        triangles = dressOriginal(mesh, quantised.triangles);
    }
    Atlas atlas(double scale, int maxSide = 4096) {
        return makeAtlas(triangles, {mesh, textures, nullptr, scale, maxSide});
    }
};

glm::u8vec3 texel(const Image& image, int x, int y) {
    const std::size_t at = (static_cast<std::size_t>(y) * image.width + x) * image.channels;
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

glm::vec3 bilinear(const Image& image, double x, double y) {
    const double cx = std::clamp(x - 0.5, 0.0, image.width - 1.0),
                 cy = std::clamp(y - 0.5, 0.0, image.height - 1.0);
    const int x0 = static_cast<int>(cx), y0 = static_cast<int>(cy);
    const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
    const auto fx = static_cast<float>(cx - x0), fy = static_cast<float>(cy - y0);
    const glm::vec3 top = glm::mix(glm::vec3(texel(image, x0, y0)), glm::vec3(texel(image, x1, y0)), fx);
    const glm::vec3 bottom = glm::mix(glm::vec3(texel(image, x0, y1)), glm::vec3(texel(image, x1, y1)), fx);
    return glm::mix(top, bottom, fy);
}

TEST(MakeAtlas, CopiesATextureThatFillsItsClassTexelByTexel) {
    World world(blockOf(makeSheet({4, 4, 1.0, 1.0, {}}), paintImage(48, 32, everyTexelItsOwn)));
    const Atlas atlas = world.atlas(1.0);
    ASSERT_TRUE(atlas.image);
    ASSERT_EQ(atlas.image->width, 48);  // no gutter at the atlas's own edge
    ASSERT_EQ(atlas.image->height, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x) ASSERT_EQ(texel(*atlas.image, x, y), everyTexelItsOwn(x, y));
    }
    EXPECT_FALSE(atlas.reduced);
}

TEST(MakeAtlas, CutsOutTheTexelsThatAreShownAndTheirNeighbours) {
    // The sheet shows texels [10, 30) x [5, 17) of the picture.
    SourceMesh sheet = makeSheet({2, 2, 1.0, 1.0, {}});
    for (glm::vec2& uv : sheet.uvs) uv = (glm::vec2(10, 5) + uv * glm::vec2(20, 12)) / 64.0f;
    World world(blockOf(sheet, paintImage(64, 64, everyTexelItsOwn)));
    const Atlas atlas = world.atlas(1.0);
    ASSERT_TRUE(atlas.image);
    EXPECT_EQ(atlas.image->width, 24);
    EXPECT_EQ(atlas.image->height, 12);
    const glm::vec2 corner = world.triangles[0].texels[0];
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 20; ++x) {
            ASSERT_EQ(texel(*atlas.image, static_cast<int>(corner.x) + x, static_cast<int>(corner.y) + y),
                      everyTexelItsOwn(10 + x, 5 + y));
        }
    }
}

// Two sheets show far parts of one picture: two charts. Around each, at least two texels repeat its border or
// show what the picture has there; the picture beyond was not shown by anything, so it was filled from the
// charts.
TEST(MakeAtlas, SurroundsChartsWithTwoTexelsOfGutter) {
    SourceMesh mesh = makeSheet({1, 1, 1.0, 1.0, {}});
    const SourceMesh other = makeSheet({1, 1, 1.0, 1.0, {}});
    for (glm::vec2& uv : mesh.uvs) uv = (glm::vec2(2, 2) + uv * 20.0f) / 256.0f;
    for (std::size_t v = 0; v < 4; ++v) {
        mesh.positions.push_back(other.positions[v] + glm::dvec3(5, 0, 0));
        mesh.uvs.push_back((glm::vec2(200, 200) + other.uvs[v] * 20.0f) / 256.0f);
    }
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + 4u);
    const auto paint = [](int x, int) { return x < 100 ? glm::u8vec3(250, 0, 0) : glm::u8vec3(0, 250, 0); };
    World world(blockOf(mesh, paintImage(256, 256, paint)));
    for (const double scale : {1.0, 0.4}) {
        const Atlas atlas = world.atlas(scale);
        ASSERT_TRUE(atlas.image);
        EXPECT_LE(atlas.image->width * atlas.image->height, 24 * 48);
        for (std::size_t t = 0; t < 4; ++t) {
            glm::vec2 low(1e9f), high(-1e9f);
            for (const glm::vec2& at : world.triangles[t].texels) {
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
            EXPECT_NEAR(high.x - low.x, 20 * scale, 0.51);
            for (int y = static_cast<int>(low.y) - 2; y < static_cast<int>(high.y) + 2; ++y) {
                for (int x = static_cast<int>(low.x) - 2; x < static_cast<int>(high.x) + 2; ++x) {
                    if (x < 0 || y < 0 || x >= atlas.image->width || y >= atlas.image->height) continue;
                    EXPECT_EQ(texel(*atlas.image, x, y),
                              t < 2 ? glm::u8vec3(250, 0, 0) : glm::u8vec3(0, 250, 0));
                }
            }
        }
    }
}

TEST(MakeAtlas, JoinsChartsThatOverlapInTheTexture) {
    // 50 separate sheets that all show the same part of the picture, or nearly.
    SourceMesh mesh;
    for (int i = 0; i < 50; ++i) {
        SourceMesh sheet = makeSheet({1, 1, 1.0, 1.0, {}});
        for (std::size_t v = 0; v < 4; ++v) {
            mesh.positions.push_back(sheet.positions[v] + glm::dvec3(2 * i, 0, 0));
            mesh.uvs.push_back(sheet.uvs[v] * 0.5f + glm::vec2(static_cast<float>(i % 3) / 64.0f, 0.0f));
        }
        for (const glm::uvec3& t : sheet.triangles)
            mesh.triangles.push_back(t + static_cast<std::uint32_t>(4 * i));
    }
    World world(blockOf(mesh, paintImage(64, 64, everyTexelItsOwn)));
    const ChartSet set = makeCharts(world.triangles, world.mesh, world.textures, 1.0);
    ASSERT_EQ(set.charts.size(), 1u);
    EXPECT_EQ(set.charts[0].rect.width, 40.0);  // 34 in whole blocks
    EXPECT_EQ(set.charts[0].rect.height, 32.0);
}

// A staircase of 8 connected squares of 64 texels along the diagonal fills an eighth of its rectangle. Its charts keep
// the source's blocks, and together take less than a third of that rectangle.
TEST(MakeAtlas, CutsObliqueIslandsIntoPartsThatNeedLessRoom) {
    constexpr std::uint32_t kSteps = 8;
    SourceMesh mesh;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        // Neighbours share a corner, and by it they are connected.
        for (const glm::uvec2 corner : {glm::uvec2(0, 0), glm::uvec2(1, 0), glm::uvec2(0, 1), glm::uvec2(1, 1)}) {
            const glm::dvec2 at(i + corner.x, i + corner.y);
            mesh.positions.emplace_back(at, 0.0);
            mesh.uvs.emplace_back(at / double(kSteps));
        }
        mesh.triangles.emplace_back(4 * i, 4 * i + 1, 4 * i + 2);
        mesh.triangles.emplace_back(4 * i + 1, 4 * i + 3, 4 * i + 2);
    }
    World world(blockOf(mesh, paintImage(512, 512, everyTexelItsOwn)));
    const ChartSet set = makeCharts(world.triangles, world.mesh, world.textures, 1.0);
    EXPECT_GT(set.charts.size(), 1u);
    int room = 0;
    for (const Chart& chart : set.charts) {
        EXPECT_TRUE(chart.aligned);
        room += chart.width * chart.height;
    }
    EXPECT_LT(room, 512 * 512 / 3);
    const Atlas atlas = world.atlas(1.0);
    ASSERT_TRUE(atlas.image);
    for (const NodeTriangle& t : world.triangles) {
        const glm::vec2 inAtlas = (t.texels[0] + t.texels[1] + t.texels[2]) / 3.0f;
        glm::dvec2 inPicture(0.0);
        for (int k = 0; k < 3; ++k) inPicture += glm::dvec2(world.mesh.wedges[t.wedges[k]].uv) * 512.0 / 3.0;
        EXPECT_EQ(texel(*atlas.image, static_cast<int>(inAtlas.x), static_cast<int>(inAtlas.y)),
                  everyTexelItsOwn(static_cast<int>(inPicture.x), static_cast<int>(inPicture.y)));
    }
}

// Charts at odd places of a noisy picture: each block of 8 x 8 texels of the picture under a chart is a block of the
// atlas, so the first three mip levels are the picture's own.
TEST(MakeAtlas, KeepsTheMipBlocksOfTheSource) {
    SourceMesh mesh;
    for (int i = 0; i < 5; ++i) {
        const SourceMesh sheet = makeSheet({1, 1, 1.0, 1.0, {}});
        const glm::vec2 at(static_cast<float>(101 * i + 3), static_cast<float>(97 * i + 5)), size(static_cast<float>(45 + i), static_cast<float>(61 - i));
        for (std::size_t v = 0; v < 4; ++v) {
            mesh.positions.push_back(sheet.positions[v] + glm::dvec3(2 * i, 0, 0));
            mesh.uvs.push_back((at + sheet.uvs[v] * size) / 512.0f);
        }
        for (const glm::uvec3& t : sheet.triangles) mesh.triangles.push_back(t + static_cast<std::uint32_t>(4 * i));
    }
    World world(blockOf(mesh, paintImage(512, 512, everyTexelItsOwn)));
    ChartSet set = makeCharts(world.triangles, world.mesh, world.textures, 1.0);
    ASSERT_EQ(set.charts.size(), 5u);
    AtlasSize size;
    ASSERT_TRUE(packAtlas(set.charts, 4096, size));
    for (const Chart& chart : set.charts) {
        EXPECT_TRUE(chart.aligned);
        for (const int side : {chart.x, chart.y, static_cast<int>(chart.rect.x), static_cast<int>(chart.rect.y),
                               chart.width, chart.height}) {
            EXPECT_EQ(side % kMipBlock, 0);
        }
    }
    EXPECT_FALSE(makeCharts(world.triangles, world.mesh, world.textures, 0.5).charts[0].aligned);
}

TEST(MakeAtlas, StoresRepeatsAndBlursThemWhenThereAreMany) {
    SourceMesh sheet = makeSheet({1, 1, 1.0, 1.0, {}});
    for (glm::vec2& uv : sheet.uvs) uv = uv * glm::vec2(3, 1) - glm::vec2(7.25f, 0.0f);
    World world(blockOf(sheet, paintImage(16, 16, everyTexelItsOwn)));
    const Atlas atlas = world.atlas(1.0);
    ASSERT_TRUE(atlas.image);
    EXPECT_EQ(atlas.blurredRepeats, 0u);
    const glm::vec2 corner = world.triangles[0].texels[0];
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 48; ++x) {
            ASSERT_EQ(texel(*atlas.image, static_cast<int>(corner.x) + x, static_cast<int>(corner.y) + y),
                      everyTexelItsOwn((x + 12) % 16, y));  // -7.25 repeats: starts at three quarters
        }
    }
    for (glm::vec2& uv : sheet.uvs) uv.x = uv.x * 1e5f;
    World many(blockOf(sheet, paintImage(16, 16, [](int, int) { return glm::u8vec3(40, 50, 60); })));
    const Atlas blurred = many.atlas(1.0);
    ASSERT_TRUE(blurred.image);
    EXPECT_EQ(blurred.blurredRepeats, 1u);
    EXPECT_LE(blurred.image->width, 128);
    EXPECT_EQ(texel(*blurred.image, 5, 5), glm::u8vec3(40, 50, 60));
}

TEST(MakeAtlas, MakesTexturesSmallerThatDoNotFit) {
    World world(blockOf(makeSheet({4, 4, 1.0, 1.0, {}}),
                        paintImage(300, 200, [](int, int) { return glm::u8vec3(9, 8, 7); })));
    const Atlas atlas = world.atlas(1.0, 128);
    ASSERT_TRUE(atlas.image);
    EXPECT_TRUE(atlas.reduced);
    EXPECT_FALSE(atlas.replaced);
    EXPECT_LE(atlas.image->width, 128);
    EXPECT_LE(atlas.image->height, 128);
    EXPECT_EQ(texel(*atlas.image, 60, 60), glm::u8vec3(9, 8, 7));
}

TEST(MakeAtlas, PaintsVerticesWhenThereAreTooManyChartsForAnyAtlas) {
    // 2048 loose triangles far apart in a large picture: their gutters alone exceed 64 x 64.
    SourceMesh mesh;
    for (std::uint32_t i = 0; i < 2048; ++i) {
        const double x = i % 64, y = i / 64;
        for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(0.1, 0), glm::dvec2(0, 0.1)}) {
            mesh.positions.emplace_back(x + corner.x, y + corner.y, 0.0);
            mesh.uvs.emplace_back((x + corner.x) / 64, (y + corner.y) / 64);
        }
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    World world(blockOf(mesh, paintImage(2048, 2048, [](int, int) { return glm::u8vec3(200, 100, 50); })));
    const Atlas atlas = world.atlas(1.0, 64);
    if (atlas.image) {  // joined into one chart: also right
        EXPECT_TRUE(atlas.reduced);
        EXPECT_LE(std::max(atlas.image->width, atlas.image->height), 64);
    } else {
        EXPECT_TRUE(atlas.replaced);
        EXPECT_EQ(world.triangles[7].colours[1], glm::u8vec4(200, 100, 50, 255));
        EXPECT_EQ(world.triangles[7].surface, 0u);
    }
}

TEST(MakeAtlas, OfUntexturedTrianglesIsNothing) {
    World world(blockOf(makeSheet({2, 2, 1.0, 1.0, {}})));
    EXPECT_FALSE(world.atlas(1.0).image);
    EXPECT_EQ(world.triangles[0].chart, kNone);
}

TEST(MakeAtlas, KeepsAlphaOnlyWhereAMaterialCutsHoles) {
    auto image = std::make_shared<Image>(Image{8, 8, 4, {}, true});
    for (int i = 0; i < 64; ++i)
        image->pixels.insert(image->pixels.end(), {10, 20, 30, static_cast<std::uint8_t>(i < 32 ? 0 : 255)});
    SourceBlock block = blockOf(makeSheet({1, 1, 1.0, 1.0, {}}), image);
    EXPECT_EQ(World(block).atlas(1.0).image->channels, 3);
    block.materials[0].alphaMask = true;
    const Atlas atlas = World(block).atlas(1.0);
    ASSERT_EQ(atlas.image->channels, 4);
    EXPECT_EQ(atlas.image->pixels[3], 0);
    EXPECT_EQ(atlas.image->pixels[63 * 4 + 3], 255);
}

TEST(MakeAtlas, DoesNotLetUnusedBackgroundIntoCoarseLevels) {
    // Only the left half is shown; the right half is black background, 8 texels of which fall into a coarse
    // texel.
    SourceMesh sheet = makeSheet({1, 1, 1.0, 1.0, {}});
    for (glm::vec2& uv : sheet.uvs) uv.x *= 60.0f / 128.0f;
    World world(blockOf(
        sheet, paintImage(128, 128, [](int x, int) { return x < 60 ? glm::u8vec3(200) : glm::u8vec3(0); })));
    const Atlas atlas = world.atlas(0.125);
    ASSERT_TRUE(atlas.image);
    for (const std::uint8_t value : atlas.image->pixels) ASSERT_EQ(value, 200);
}

// Random islands in a smooth picture, at any scale: wherever a triangle is drawn, the atlas has the colour
// that the picture has there.
RC_GTEST_PROP(MakeAtlas, ShowsThePicturesColourEverywhereOnEveryTriangle, (std::uint64_t seed)) {
    Random random(seed);
    const auto paint = [](double x, double y) {
        return glm::vec3(x * 0.9 + 10, y * 0.9 + 5, (x + y) * 0.45);
    };
    const auto image =
        paintImage(128, 128, [&](int x, int y) { return glm::u8vec3(paint(x + 0.5, y + 0.5) + 0.5f); });
    SourceMesh mesh;
    for (std::uint64_t i = 0; i < 1 + random.index(12); ++i) {
        const glm::dvec2 at(random.uniform(0, 90), random.uniform(0, 90)),
            size(random.uniform(1, 36), random.uniform(1, 36));
        const SourceMesh sheet = makeSheet({2, 2, size.x, size.y, {}});
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
            mesh.positions.push_back(sheet.positions[v] + glm::dvec3(at, static_cast<double>(i)));
            mesh.uvs.emplace_back((at + glm::dvec2(sheet.uvs[v]) * size) / 128.0);
        }
        for (const glm::uvec3& t : sheet.triangles) mesh.triangles.push_back(t + first);
    }
    World world(blockOf(mesh, image));
    const double scale = random.index(3) == 0 ? 1.0 : random.uniform(0.1, 1.0);
    const Atlas atlas = world.atlas(scale);
    RC_ASSERT(atlas.image.has_value());
    for (const NodeTriangle& t : world.triangles) {
        double a = random.uniform(), b = random.uniform();
        if (a + b > 1.0) {
            a = 1.0 - a;
            b = 1.0 - b;
        }
        const glm::dvec3 weights(1.0 - a - b, a, b);
        glm::dvec2 inAtlas(0.0), inPicture(0.0);
        for (int k = 0; k < 3; ++k) {
            inAtlas += glm::dvec2(t.texels[static_cast<std::size_t>(k)]) * weights[k];
            inPicture += glm::dvec2(world.mesh.wedges[t.wedges[k]].uv) * 128.0 * weights[k];
        }
        const glm::vec3 shown = bilinear(*atlas.image, inAtlas.x, inAtlas.y),
                        wanted = paint(inPicture.x, inPicture.y);
        // Rounding to bytes twice, and at the edge of a chart half a texel of the atlas's gradient.
        const double tolerance = 1.5 + 0.9 * 0.75 / scale;
        for (int c = 0; c < 3; ++c) RC_ASSERT(std::abs(shown[c] - wanted[c]) <= tolerance);
    }
}

}  // namespace
}  // namespace fb
