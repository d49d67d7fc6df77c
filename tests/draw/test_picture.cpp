// Whole pictures, with pixels counted by hand. viewAlongZ maps 1 m of the plane z = -height / 2 to 1 pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/draw_world.h"

namespace fb::draw_test {

// Pixel centres are at +-0.5, +-1.5, …; the triangle is x >= -3, y >= -3, x + y <= 0.2. Centres of the 6 x 6
// square from -2.5 to 2.5 whose sum is at most 0: 6 + 5 + 4 + 3 + 2 + 1 = 21, the longest row at the bottom.
TEST_F(DrawTest, CoversExactlyThePixelsWhoseCentresATriangleContains) {
    World world;
    DecodedNode node;
    addTriangle(node, {glm::vec3{-3, -3, -4}, {3.2f, -3, -4}, {-3, 3.2f, -4}}, {200, 100, 50});
    world.add(std::move(node));
    world.uploadAll(*renderer);
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 8);
    ASSERT_EQ(image.channels, 3);
    const std::array<std::string, 8> expected = {"........", ".#......", ".##.....", ".###....",
                                                 ".####...", ".#####..", ".######.", "........"};
    for (int y = 0; y < 8; ++y) {
        EXPECT_EQ(row(image, y, {{'#', {200, 100, 50}}}), expected[static_cast<std::size_t>(y)])
            << "row " << y;
    }
    EXPECT_EQ(counters.nodes, 1u);
    EXPECT_EQ(counters.triangles, 1u);
    EXPECT_EQ(counters.multiDraws, 1u);
}

TEST_F(DrawTest, ShowsTheBackOfATriangle) {
    World world;
    DecodedNode node;
    addTriangle(node, {glm::vec3{-3, -3, -4}, {-3, 3.2f, -4}, {3.2f, -3, -4}}, kRed);
    world.add(std::move(node));
    world.uploadAll(*renderer);
    EXPECT_EQ(count(picture(world, viewAlongZ({}, 8, 8)), kRed), 21);
}

// The quad covers the 8 x 8 picture exactly: each texel falls on one pixel, its first row on the top one.
TEST_F(DrawTest, ShowsTexelsUnchangedWhereOneFallsOnOnePixel) {
    World world;
    DecodedNode node;
    addTexturedQuad(node, {glm::vec3{-4, 4, -4}, {4, 4, -4}, {4, -4, -4}, {-4, -4, -4}});
    const auto texels = manyColours(8, 8);
    setTexture(node, 8, 8, texels);
    world.add(std::move(node));
    world.uploadAll(*renderer);
    effects[Effect::texturing] = true;
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    for (std::size_t i = 0; i < 64; ++i) {
        const Rgb texel{texels[i * 4], texels[i * 4 + 1], texels[i * 4 + 2]};
        EXPECT_EQ(pixel(image, static_cast<int>(i % 8), static_cast<int>(i / 8)), texel) << "texel " << i;
    }
}

TEST_F(DrawTest, MultipliesTextureAndVertexColour) {
    World world;
    DecodedNode node;
    addTexturedQuad(node, {glm::vec3{-4, 4, -4}, {4, 4, -4}, {4, -4, -4}, {-4, -4, -4}});
    for (GpuVertex& v : node.vertices) v.colour[0] = 51, v.colour[1] = 102, v.colour[2] = 0;  // 0.2, 0.4, 0
    setTexture(node, 4, 4, std::vector<std::uint8_t>(64, 255));
    for (std::size_t i = 0; i < 16; ++i) node.texels[i * 4] = 100;
    node.texels[0] = 100;
    world.add(std::move(node));
    world.uploadAll(*renderer);
    effects[Effect::texturing] = true;
    EXPECT_EQ(pixel(picture(world, viewAlongZ({}, 4, 4)), 1, 1), (Rgb{20, 102, 0}));
}

TEST_F(DrawTest, WithoutTexturingShowsTheVertexColoursInOneMultiDraw) {
    World world;
    DecodedNode node;
    addTexturedQuad(node, {glm::vec3{-4, 4, -4}, {0, 4, -4}, {0, -4, -4}, {-4, -4, -4}});
    setTexture(node, 4, 4, manyColours(4, 4));
    addQuad(node, rectangle(0, -4, 4, 4, -4), kGreen);
    world.add(std::move(node));
    world.uploadAll(*renderer);
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(count(image, kWhite), 32);
    EXPECT_EQ(count(image, kGreen), 32);
    EXPECT_EQ(counters.multiDraws, 1u);
    EXPECT_EQ(counters.texturedDraws, 0u);
    EXPECT_EQ(counters.litDraws, 0u);
    effects[Effect::texturing] = true;
    const Image textured = picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(count(textured, kWhite), 0);
    EXPECT_EQ(count(textured, kGreen), 32);
    EXPECT_EQ(counters.multiDraws, 2u);
    EXPECT_EQ(counters.texturedDraws, 1u);
    EXPECT_EQ(counters.litDraws, 0u);
    effects[Effect::lighting] = true;
    (void)picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(counters.texturedDraws, 1u);
    EXPECT_EQ(counters.litDraws, 2u);
}

// 4 x 4 texels of which the diagonal is a hole; a green wall behind.
TEST_F(DrawTest, SeesThroughTheHolesOfAMaskOnlyWhereTheNodeHasOne) {
    for (const bool mask : {true, false}) {
        World world;
        DecodedNode node;
        addTexturedQuad(node, {glm::vec3{-2, 2, -2}, {2, 2, -2}, {2, -2, -2}, {-2, -2, -2}});
        std::vector<std::uint8_t> texels(64, 255);
        for (std::size_t i = 0; i < 4; ++i) texels[(i * 4 + i) * 4 + 3] = 100;
        setTexture(node, 4, 4, texels);
        node.flags.alphaMask = mask;
        world.add(std::move(node));
        world.add(colouredRectangle(-9, -9, 9, 9, -3, kGreen));
        remake({});
        world.uploadAll(*renderer);
        effects[Effect::texturing] = true;
        const Image image = picture(world, viewAlongZ({}, 4, 4));
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 4; ++x) EXPECT_EQ(pixel(image, x, y), mask && x == y ? kGreen : kWhite);
        }
    }
}

// Level colours are tinted by the brightness of the surface: white shows them unchanged, black at 0.65.
TEST_F(DrawTest, ShowsTheLevelOfEachNodeInLevelMode) {
    World world;
    for (int level = 0; level < 8; ++level) {
        const auto x = static_cast<float>(level - 4);
        world.add(colouredRectangle(x, -4, x + 1, 0, -4, kWhite), {}, static_cast<std::uint8_t>(level));
        world.add(colouredRectangle(x, 0, x + 1, 4, -4, {0, 0, 0}), {}, static_cast<std::uint8_t>(level));
    }
    world.uploadAll(*renderer);
    settings.colour = ColourMode::level;
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    for (int level = 0; level < 8; ++level) {
        const glm::vec3 colour = levelColour(level);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(pixel(image, level, 6)[c], std::lround(colour[static_cast<int>(c)] * 255.0f)) << level;
            EXPECT_NEAR(pixel(image, level, 1)[c], 0.65f * colour[static_cast<int>(c)] * 255.0f, 0.51f)
                << level;
        }
    }
}

// Facing the viewer: 0.64 + 0.34 * lamp.z + 0.12 * up.z with the lamp at (-0.3, 0.35, 1) / sqrt(1.2125), up
// at y: 0.64 + 0.34 / 1.10114 = 0.94877, times 255 is 241.9. All four triangles show the same side.
TEST_F(DrawTest, LightsASurfaceByTheSideThatIsSeenWhateverItsWinding) {
    const std::array<glm::vec3, 3> ccw = {glm::vec3{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
    const std::array<glm::vec3, 3> cw = {ccw[0], ccw[2], ccw[1]};
    World world;
    int place = 0;
    for (const auto& corners : {ccw, cw}) {
        for (const float z : {1.0f, -1.0f}) {
            DecodedNode node;
            addTriangle(node, corners, kWhite);
            for (GpuVertex& v : node.vertices) encodeNormal({0, 0, z}, v.normal);
            world.add(std::move(node), {-2.5 + 2 * place++, 0.5, -4});
        }
    }
    world.uploadAll(*renderer);
    effects[Effect::lighting] = true;
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(count(image, {242, 242, 242}), 4 * 3) << row(image, 3, {{'#', {242, 242, 242}}});
}

// A skirt has the normals of its surface, at a slant to its own: its back, seen past an edge, is lit as the surface is.
// 0.64 + 0.34 * (-0.3 * 0.6 + 0.8) / 1.10114 = 0.83144, times 255 is 212.0; as a back it would be 114.
TEST_F(DrawTest, LightsTheBackOfASkirtLikeTheSurfaceThatFacesTheViewer) {
    World world;
    DecodedNode node;
    addTriangle(node, {glm::vec3{0, 0, 0}, {0, 12, 0}, {3.75, 0, 11.5}}, kWhite);  // its normal: (0.95, 0, -0.31)
    for (GpuVertex& v : node.vertices) encodeNormal({0.6f, 0, 0.8f}, v.normal);
    world.add(std::move(node), {-2, -6, -20});
    world.uploadAll(*renderer);
    effects[Effect::lighting] = true;
    const Image image = picture(world, viewAlongZ({}, 40, 40));
    EXPECT_GT(count(image, {212, 212, 212}), 20);
    EXPECT_EQ(count(image, {114, 114, 114}), 0);
}

// Seen from above, the top of a floor: 0.64 + 0.34 * lamp.up + 0.12; camera up is -z, forward -y.
// lamp = (-0.3, 0.35 along -z, 1 along y): 0.64 + 0.34 * 0.90815 + 0.12 > 1, so the white stays white.
// From below: 0.64 + 0.34 * 0.90815 - 0.12 = 0.82877, times 255 is 211.3.
TEST_F(DrawTest, MakesTheSkySideBrighterThanTheGroundSide) {
    World world;
    DecodedNode floor;
    addQuad(floor, {glm::vec3{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, kWhite);
    world.add(std::move(floor));
    world.uploadAll(*renderer);
    effects[Effect::lighting] = true;
    View view = viewAlongZ({}, 4, 4);
    view.camera = lookAt({0, 2, 0}, {0, 0, 0}, {0, 0, -1});
    view.camera.fovyRadians = 1.0;
    EXPECT_EQ(count(picture(world, view), kWhite), 16);
    view.camera = lookAt({0, -2, 0}, {0, 0, 0}, {0, 0, -1});
    EXPECT_EQ(count(picture(world, view), {211, 211, 211}), 16);
}

TEST_F(DrawTest, PutsTheSkyAboveAndTheGroundBelow) {
    const World world;
    const View view = viewAlongZ({}, 6, 40);
    const Image image = picture(world, view);
    EXPECT_EQ(pixel(image, 3, 39), (Rgb{120, 122, 122}));  // 0.47, 0.48, 0.48
    EXPECT_GT(pixel(image, 3, 0)[2], pixel(image, 3, 0)[0] + 50);
    renderer->draw({world.hierarchy, world.front, view, settings, effects, {0, -2, 0}}, 2);
    const Image turned = renderer->readPicture();
    for (int y = 0; y < 40; ++y) EXPECT_EQ(pixel(turned, 3, y), pixel(image, 3, 39 - y)) << "row " << y;
}

TEST_F(DrawTest, DrawsAnEmptyFrontAsSkyAlone) {
    World world;
    world.add(colouredRectangle(-9, -9, 9, 9, -4, kRed));
    world.uploadAll(*renderer);
    world.front.clear();
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(count(image, kRed), 0);
    EXPECT_EQ(count(image, {0, 0, 0}), 0);
    EXPECT_EQ(counters.nodes, 0u);
    EXPECT_EQ(counters.triangles, 0u);
    EXPECT_EQ(counters.multiDraws, 0u);
}

TEST_F(DrawTest, LeavesOutNodesThatAreNotResidentOrDoNotExist) {
    World world;
    world.add(colouredRectangle(-4, -4, 0, 4, -4, kRed));
    world.add(colouredRectangle(0, -4, 4, 4, -4, kGreen));
    ASSERT_TRUE(renderer->upload(0, world.contents[0]));
    ASSERT_TRUE(renderer->upload(77, world.contents[1]));  // resident, but not in the hierarchy
    world.front = {0, 1, 2, 77, 78, 1'000'000, kNoNode};
    settings.boxes = true;
    const Image image = picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(count(image, kGreen), 0);
    EXPECT_EQ(counters.nodes, 1u);
    renderer->release(1);
    renderer->release(kNoNode);
    EXPECT_EQ(picture(world, viewAlongZ({}, 8, 8)).pixels, image.pixels);
}

TEST_F(DrawTest, FollowsTheSizeOfTheView) {
    World world;
    world.add(colouredRectangle(-1000, -1000, 1000, 1000, -4, kRed));
    world.uploadAll(*renderer);
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 3}, {300, 200}, {7, 5}, {300, 200}}) {
        const Image image = picture(world, viewAlongZ({}, width, height));
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        EXPECT_EQ(count(image, kRed), width * height);
        EXPECT_NE(renderer->pictureTexture(), 0u);
    }
    const Image minimised = picture(world, viewAlongZ({}, 0, -3));
    EXPECT_EQ(minimised.width, 1);
    EXPECT_EQ(minimised.height, 1);
    EXPECT_EQ(count(minimised, kRed), 1);
}

TEST_F(DrawTest, DrawsTheSameTwice) {
    World world;
    for (int i = 0; i < 30; ++i) {
        const auto x = static_cast<float>(i);
        DecodedNode node;
        addTexturedQuad(node,
                        {glm::vec3{x - 20, 9, -30 - x}, {x, 8, -20}, {x + 3, -9, -25}, {x - 17, -7, -31}});
        setTexture(node, 16, 8, manyColours(16, 8));
        addQuad(node, rectangle(x - 15, -9, x - 14, 9, -28), {static_cast<std::uint8_t>(i * 8), 90, 200});
        world.add(std::move(node), {0.3, 0.1, 0.7 * i});
    }
    world.uploadAll(*renderer);
    effects[Effect::texturing] = effects[Effect::lighting] = true;
    settings.wireframe = settings.boxes = true;
    const View view = viewAlongZ({0, 0, 5}, 150, 100);
    const Image first = picture(world, view);
    EXPECT_EQ(picture(world, view).pixels, first.pixels);
    std::ranges::reverse(world.front);
    EXPECT_EQ(picture(world, view).pixels, first.pixels);
    EXPECT_EQ(pictureWith({}, world, view, settings, effects).pixels, first.pixels);
}

TEST_F(DrawTest, SurvivesACameraThatIsNotANumber) {
    World world;
    world.add(colouredRectangle(-4, -4, 0, 4, -4, kRed));
    world.uploadAll(*renderer);
    settings.wireframe = settings.boxes = true;
    View view = viewAlongZ({}, 8, 8);
    view.camera.eye.x = std::nan("");
    EXPECT_EQ(picture(world, view).width, 8);
    view = viewAlongZ({1e300, 0, 0}, 8, 8);
    view.camera.fovyRadians = 0.0;
    EXPECT_EQ(picture(world, view).width, 8);
}

}  // namespace fb::draw_test
