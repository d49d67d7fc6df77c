// What a block holds of its textures: tiles, their halves, what fills the rest, and the colours that arrive in atlases.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"
#include "block_worlds.h"
#include "build/make_atlas.h"
#include "build/quantise_block.h"
#include "build/spread_texels.h"
#include "worlds/picture_files.h"
#include "worlds/scratch_folder.h"

namespace fb {
namespace {

using test::addSquare;
using test::blockOf;
using test::emptyBlock;
using test::mixedBytes;
using test::paintImage;
using test::PictureKind;
using test::writePicture;

struct Dressed {
    BlockTextures textures;
    BlockMesh mesh;
    std::vector<NodeTriangle> triangles;
    Atlas atlas;

    explicit Dressed(const SourceBlock& block, double scale = 1.0) : textures(decodeTextures(block)) {
        QuantisedBlock quantised = quantiseBlock(block, textures);
        mesh = std::move(quantised.mesh);
        triangles = dressOriginal(mesh, quantised.triangles);
        atlas = makeAtlas(triangles, {mesh, textures, nullptr, scale, 4096});
    }
    // The atlas's texels under a square of addSquare, by its first triangle.
    [[nodiscard]] std::vector<std::uint8_t> square(std::size_t triangle, int side) const {
        glm::vec2 low(1e9f);
        for (const glm::vec2& at : triangles[triangle].texels) low = glm::min(low, at);
        std::vector<std::uint8_t> texels;
        const Image& image = *atlas.image;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side * image.channels; ++x) {
                const auto row = static_cast<std::size_t>(std::lround(low.y)) + static_cast<std::size_t>(y);
                const auto column = static_cast<std::size_t>(std::lround(low.x)) * image.channels + x;
                texels.push_back(image.pixels[row * image.width * image.channels + column]);
            }
        }
        return texels;
    }
};

// The same part of a whole picture, as colours; it wraps around.
std::vector<std::uint8_t> part(const Image& image, int left, int top, int side, int channels) {
    std::vector<std::uint8_t> texels;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const std::size_t at = (static_cast<std::size_t>((top + y) % image.height) * image.width +
                                    static_cast<std::size_t>((left + x) % image.width)) *
                                   image.channels;
            for (int c = 0; c < channels; ++c) {
                const bool alpha = c == 3;
                const int from = alpha ? image.channels - 1 : (image.channels <= 2 ? 0 : c);
                texels.push_back(image.pixels[at + static_cast<std::size_t>(from)]);
            }
        }
    }
    return texels;
}

// Each kind of file in a block of its own, and all of them together as materials of one block: the texels that a
// square shows arrive exactly.
TEST(TextureTiles, BringTheColoursOfEveryKindOfFileIntoTheAtlas) {
    const ScratchFolder folder;
    std::vector<SourceTexture> textures;
    const auto add = [&](const char* name, const PictureKind& kind, const auto& numbers) {
        if (writePicture(folder / name, kind, numbers)) textures.push_back({name, folder / name, {}, {}});
    };
    const auto wide = [](const std::vector<std::uint8_t>& bytes, auto factor) {
        std::vector<decltype(factor)> numbers;
        for (const std::uint8_t byte : bytes) numbers.push_back(static_cast<decltype(factor)>(byte * factor));
        return numbers;
    };
    PictureKind kind{200, 150, 3};
    add("rgb.png", kind, mixedBytes(kind));
    kind.tile = 64;
    add("tiles.tif", kind, mixedBytes(kind));
    kind = {200, 150, 3, OIIO::TypeDesc::UINT16};
    add("deep.png", kind, wide(mixedBytes(kind), std::uint16_t{257}));
    kind.channels = 1;
    add("deepgrey.png", kind, wide(mixedBytes(kind), std::uint16_t{257}));
    kind = {200, 150, 2};
    add("greyalpha.png", kind, mixedBytes(kind));
    kind.channels = 4;
    add("rgba.png", kind, mixedBytes(kind));
    kind = {200, 150, 3, OIIO::TypeDesc::FLOAT};
    add("light.exr", kind, wide(mixedBytes(kind), 1.0f / 251.0f));
    ASSERT_GE(textures.size(), 6u);
    for (const bool masked : {false, true}) {
        SourceBlock all = emptyBlock(textures);
        for (std::uint32_t i = 0; i < textures.size(); ++i) {
            all.materials[i].alphaMask = masked;
            addSquare(all, i, {50, 30}, 70, {200, 150});
        }
        const Dressed dressed(all);
        ASSERT_TRUE(dressed.textures.warnings.empty()) << dressed.textures.warnings[0];
        ASSERT_TRUE(dressed.atlas.image);
        EXPECT_EQ(dressed.atlas.image->channels, masked ? 4 : 3);
        for (std::size_t i = 0; i < textures.size(); ++i) {
            const Result<Image> whole = loadTexture(textures[i]);
            ASSERT_TRUE(whole) << whole.error().oneLine();
            std::vector<std::uint8_t> shown = dressed.square(2 * i, 70);
            const bool hasAlpha = whole->channels % 2 == 0;
            std::vector<std::uint8_t> wanted = part(*whole, 50, 30, 70, masked ? 4 : 3);
            for (std::size_t at = 0; masked && at < wanted.size(); at += 4) {
                if (!hasAlpha) wanted[at + 3] = 255;
                // Colours of holes are not shown; they were filled.
                if (wanted[at + 3] == 0) std::fill_n(shown.begin() + static_cast<std::ptrdiff_t>(at), 3, wanted[at]);
                if (wanted[at + 3] == 0) std::fill_n(wanted.begin() + static_cast<std::ptrdiff_t>(at), 3, wanted[at]);
            }
            EXPECT_EQ(shown, wanted) << textures[i].name;
        }
    }
}

TEST(TextureTiles, WrapCoordinatesThatRepeatAroundPicturesOfAnySize) {
    const PictureKind kind{150, 90, 3};
    const auto image = std::make_shared<const Image>(Image{150, 90, 3, mixedBytes(kind), true});
    SourceBlock block = emptyBlock({{"brick", {}, {}, image}});
    addSquare(block, 0, {130, 70}, 40, {150, 90});      // over the corner
    addSquare(block, 0, {-1500 + 20, 900 + 80}, 64, {150, 90});  // far away, over one edge
    const Dressed dressed(block);
    ASSERT_TRUE(dressed.atlas.image);
    EXPECT_EQ(dressed.square(0, 40), part(*image, 130, 70, 40, 3));
    EXPECT_EQ(dressed.square(2, 64), part(*image, 20, 80, 64, 3));
}

TEST(TextureTiles, AreFilteredOverTheEdgeWhereCoordinatesRepeat) {
    // Red left, blue right, with the edge of the picture in the middle of the square; coarse by 5.3.
    const auto image = paintImage(1024, 1024, [](int x, int) {
        return x < 512 ? glm::u8vec3(240, 0, 0) : glm::u8vec3(0, 0, 240);
    });
    SourceBlock block = emptyBlock({{"brick", {}, {}, image}});
    addSquare(block, 0, {924, 300}, 200, {1024, 1024});
    const Dressed dressed(block, 3.0 / 16.0);
    ASSERT_TRUE(dressed.atlas.image);
    const std::vector<std::uint8_t> shown = dressed.square(0, 38);
    for (int x = 0; x < 38; ++x) {
        const std::size_t at = static_cast<std::size_t>(20 * 38 + x) * 3;
        // Blue before the edge, red behind it; the two columns at it may be mixed.
        if (x < 18 || x > 19) {
            EXPECT_EQ(shown[x < 18 ? at + 2 : at], 240) << x;
        }
    }
}

TEST(TextureTiles, LeaveOutTexturesThatAreMissingAndSayHowManyTrianglesThatConcerns) {
    const auto image = paintImage(64, 64, [](int x, int y) { return glm::u8vec3(x, y, 7); });
    SourceBlock block = emptyBlock({{"gone", "/nowhere/gone.png", {}, {}}, {"here", {}, {}, image}});
    block.materials[0].baseColour = glm::vec4(0.5f, 0.25f, 1.0f, 1.0f);
    addSquare(block, 0, {0, 0}, 10, {64, 64});
    addSquare(block, 1, {8, 16}, 20, {64, 64});
    const Dressed dressed(block);
    EXPECT_FALSE(dressed.textures.textures[0]);
    ASSERT_EQ(dressed.textures.warnings.size(), 1u);
    EXPECT_NE(dressed.textures.warnings[0].find("gone cannot be used: its 2 triangles"), std::string::npos)
        << dressed.textures.warnings[0];
    EXPECT_EQ(dressed.triangles[0].surface, 0u);
    EXPECT_EQ(dressed.triangles[0].colours[0], glm::u8vec4(128, 64, 255, 255));
    EXPECT_EQ(dressed.square(2, 20), part(*image, 8, 16, 20, 3));
}

TEST(TextureTiles, AreHeldOnlyWhereTrianglesShowThem) {
    const auto image = paintImage(1024, 1024, [](int x, int y) { return glm::u8vec3(x, y, 7); });
    SourceBlock block = emptyBlock({{"large", {}, {}, image}});
    addSquare(block, 0, {70, 10}, 40, {1024, 1024});  // within tile (1, 0)
    EXPECT_EQ(decodeTextures(block).tiles, 1u);
    addSquare(block, 0, {500, 500}, 24, {1024, 1024});  // over the corner of four
    const BlockTextures five = decodeTextures(block);
    EXPECT_EQ(five.tiles, 5u);
    EXPECT_EQ(five.textures[0]->levels[0].texels.size(), 5u * 64u * 64u * 3u);
    EXPECT_EQ(five.texels, 1024u * 1024u);
    addSquare(block, 0, {128, 128}, 64, {1024, 1024});  // exactly one more
    EXPECT_EQ(decodeTextures(block).tiles, 6u);
}

// Two squares at the two ends of a row of tiles; at a small scale one chart spans both and what lies between. Nothing
// of the black that the picture has there shows.
TEST(TextureTiles, FillChartsThatSpanTilesThatAreNotThere) {
    const auto image = paintImage(512, 64, [](int x, int) {
        return x < 60 || x >= 452 ? glm::u8vec3(200, 100, 50) : glm::u8vec3(0);
    });
    SourceBlock block = emptyBlock({{"gap", {}, {}, image}});
    addSquare(block, 0, {10, 0}, 50, {512, 64});
    addSquare(block, 0, {452, 0}, 50, {512, 64});
    for (const double scale : {1.0, 0.01, 0.004}) {
        const Dressed dressed(block, scale);
        EXPECT_EQ(dressed.textures.tiles, 2u);
        ASSERT_TRUE(dressed.atlas.image);
        for (std::size_t at = 0; at < dressed.atlas.image->pixels.size(); at += 3) {
            ASSERT_EQ(dressed.atlas.image->pixels[at], 200);
            ASSERT_EQ(dressed.atlas.image->pixels[at + 2], 50);
        }
    }
    // And the crop itself.
    BlockTextures textures = decodeTextures(block);
    const Image crop = cropPicture(textures.textures[0]->levels[0], {0, 0, 512, 64});
    for (std::size_t at = 0; at < crop.pixels.size(); at += 3) ASSERT_EQ(crop.pixels[at + 1], 100);
    const Image between = cropPicture(textures.textures[0]->levels[0], {200, 10, 20, 20});
    for (std::size_t at = 0; at < between.pixels.size(); at += 3) ASSERT_EQ(between.pixels[at + 1], 100);
}

TEST(TextureTiles, SpreadColoursOverTheBordersOfTiles) {
    // Two tiles side by side; only the last column of the first is known.
    TiledPicture picture = TiledPicture::ofSize(128, 64, 1);
    picture.addTile(0, 0);
    picture.addTile(1, 0);
    picture.texels.assign(2 * picture.tileBytes(), 0);
    std::vector<TileMask> known(2);
    for (int y = 0; y < 64; ++y) {
        known[0].rows[static_cast<std::size_t>(y)] = std::uint64_t{1} << 63;
        picture.texels[static_cast<std::size_t>(y * 64 + 63)] = static_cast<std::uint8_t>(100 + y);
    }
    spreadTexels(picture, known, 0, 1);
    for (int y = 0; y < 64; ++y) {
        EXPECT_EQ(*picture.texel(64, y), 100 + y);
        EXPECT_EQ(*picture.texel(62, y), 100 + y);
        EXPECT_GE(*picture.texel(120, y), 100);
        EXPECT_LE(*picture.texel(120, y), 163);
    }
}

// A picture with some of its tiles against the whole one: where all four texels of the finer level are there, the
// halved one has the same, rounded the same way.
RC_GTEST_PROP(TextureTiles, HalveLikeTheWholePicture, (std::uint64_t seed)) {
    Random random(seed);
    const int width = 1 + static_cast<int>(random.index(300)), height = 1 + static_cast<int>(random.index(300));
    const std::vector<std::uint8_t> pixels = mixedBytes({width, height, 1});
    TiledPicture picture = TiledPicture::ofSize(width, height, 1);
    for (int row = 0; row < picture.rows; ++row) {
        for (int column = 0; column < picture.columns; ++column) {
            if (random.index(3) != 0) picture.addTile(column, row);
        }
    }
    picture.texels.resize(picture.places.size() * picture.tileBytes());
    for (std::size_t i = 0; i < picture.places.size(); ++i) {
        const glm::ivec2 corner = picture.places[i] * kTileSide;
        for (int y = 0; y < std::min(kTileSide, height - corner.y); ++y) {
            for (int x = 0; x < std::min(kTileSide, width - corner.x); ++x) {
                picture.texels[i * picture.tileBytes() + static_cast<std::size_t>(y * kTileSide + x)] =
                    pixels[static_cast<std::size_t>((corner.y + y) * width + corner.x + x)];
            }
        }
    }
    const TiledPicture half = halvedPicture(picture);
    RC_ASSERT(half.width == (width + 1) / 2);
    RC_ASSERT(half.height == (height + 1) / 2);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const bool there = picture.tileAt(2 * x / kTileSide, 2 * y / kTileSide) != kNoTile;
            if (there) RC_ASSERT(half.tileAt(x / kTileSide, y / kTileSide) != kNoTile);
            if (!there) continue;
            const int right = std::min(2 * x + 1, width - 1), low = std::min(2 * y + 1, height - 1);
            const auto at = [&](int px, int py) -> int {
                return pixels[static_cast<std::size_t>(py * width + px)];
            };
            const int sum = at(2 * x, 2 * y) + at(right, 2 * y) + at(2 * x, low) + at(right, low);
            RC_ASSERT(*half.texel(x, y) == (sum + 2) / 4);
        }
    }
}

TEST(TextureTiles, AreSampledNearbyWhereATileIsNotThere) {
    const auto image = paintImage(256, 256, [](int x, int y) { return glm::u8vec3(x, y, 0); });
    SourceBlock block = emptyBlock({{"p", {}, {}, image}});
    addSquare(block, 0, {64, 64}, 64, {256, 256});
    BlockTextures textures = decodeTextures(block);
    ASSERT_EQ(textures.tiles, 1u);
    const auto sample = [&](double x, double y) {
        return TextureSampler(*textures.textures[0], 1.0f).at(glm::dvec2(x, y) / 256.0);
    };
    EXPECT_EQ(sample(100.5, 90.5), glm::vec4(100, 90, 0, 255));
    EXPECT_EQ(sample(128.0, 90.5), glm::vec4(127, 90, 0, 255));   // at the tile's edge
    EXPECT_EQ(sample(250.5, 250.5), glm::vec4(127, 127, 0, 255));  // two tiles away
}

}  // namespace
}  // namespace fb
