// Depth and precision: reversed infinite depth, positions relative to the eye.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "draw/draw_world.h"
#include "draw/frame_data.h"

namespace fb::draw_test {

namespace {

// A wall that fills the view of viewAlongZ and leans back to the right, so that depth changes from pixel to
// pixel.
DecodedNode leaningWall(float distance, const Rgb& colour) {
    DecodedNode node;
    const float s = 3.0f * distance;
    addQuad(node,
            {glm::vec3{-s, -s, -distance},
             {s, -s, -1.25f * distance},
             {s, s, -1.25f * distance},
             {-s, s, -distance}},
            colour);
    return node;
}

// Mesh pages of one node each, drawn in the order of upload whatever their distance.
RendererOptions pagePerNode() {
    RendererOptions options;
    options.meshPageBytes = 24;
    return options;
}

}  // namespace

class WallBehindWall : public DrawTest,
                       public ::testing::WithParamInterface<std::tuple<float, float, bool>> {};

// Two walls, the green one behind the red one by `gap`, drawn before or after it: every pixel is red.
TEST_P(WallBehindWall, NeverShowsThrough) {
    const auto [distance, gap, behindFirst] = GetParam();
    const glm::dvec3 far(6.5e6, 5.25e6, 412.5);
    World world;
    const auto red = leaningWall(distance, kRed), green = leaningWall(distance, kGreen);
    world.add(behindFirst ? green : red, far + glm::dvec3(0, 0, behindFirst ? -gap : 0.0f));
    world.add(behindFirst ? red : green, far + glm::dvec3(0, 0, behindFirst ? 0.0f : -gap));
    remake(pagePerNode());
    world.uploadAll(*renderer);
    EXPECT_EQ(count(picture(world, viewAlongZ(far, 64, 48)), kRed), 64 * 48);
    EXPECT_EQ(counters.multiDraws, 2u);
}

INSTANTIATE_TEST_SUITE_P(NearAndFar, WallBehindWall,
                         ::testing::Combine(::testing::Values(0.01f, 1.0f, 100.0f, 1000.0f),
                                            ::testing::Values(0x1p-9f),  // 1.95 mm
                                            ::testing::Bool()));

TEST_F(DrawTest, CutsAtTheNearPlaneAndNowhereElse) {
    World world;
    world.add(colouredRectangle(-1, -1, 1, 1, -0.0009f, kRed));
    world.add(colouredRectangle(-2e7f, -2e7f, 2e7f, 2e7f, -1e7f, kGreen), {}, 0, 0x1p10);
    world.uploadAll(*renderer);
    EXPECT_EQ(count(picture(world, viewAlongZ({}, 16, 16)), kGreen), 256);  // near is 0.001
}

// Coordinates of a national grid, in steps of 1/1024 m, which doubles hold exactly: the same picture as at
// the origin.
TEST_F(DrawTest, DrawsAGeoreferencedSceneAsOneAtTheOrigin) {
    World here, there;
    const glm::dvec3 far(6'543'210.5, 5'432'109.25, 512.125);
    for (int i = 0; i < 40; ++i) {
        DecodedNode node;
        const float a = 0.37f * static_cast<float>(i), x = std::round(2048 * std::cos(a)) / 1024;
        const float y = std::round(2048 * std::sin(a)) / 1024;
        addTriangle(node, {glm::vec3{x, y, 0}, {-y, x, -0.5f}, {0.25f, 0.125f, -1}},
                    {static_cast<std::uint8_t>(i * 6), 100, 200});
        const glm::dvec3 at(i / 64.0, -i / 128.0, -3.0 - i / 16.0);
        here.add(node, at);
        there.add(std::move(node), far + at);
    }
    effects[Effect::lighting] = true;
    here.uploadAll(*renderer);
    const glm::dvec3 eye(0.0625, 0.03125, 0.5);
    const Image expected = picture(here, viewAlongZ(eye, 160, 120));
    remake({});
    there.uploadAll(*renderer);
    EXPECT_EQ(picture(there, viewAlongZ(far + eye, 160, 120)).pixels, expected.pixels);
}

// A triangle at arm's length in the far corner of a block of 4 km against the same in a small block. Pixels
// are 0.25 mm; floats at 4 km are 0.24 mm apart.
TEST_F(DrawTest, IsAsPreciseInTheFarCornerOfALargeBlock) {
    const glm::dvec3 corner(4095.625, 4094.5, 4090.75), eye = corner + glm::dvec3(0.0123, 0.0234, 0.0501);
    World small, large;
    const std::array<glm::vec3, 3> shape = {
        glm::vec3{-0.03125f, -0.03125f, 0}, {0.0625f, 0, 0}, {0, 0.0625f, -0.015625f}};
    DecodedNode node;
    addTriangle(node, shape, kRed);
    small.add(node, corner);
    for (GpuVertex& v : node.vertices) {
        for (int i = 0; i < 3; ++i) v.position[i] += static_cast<float>(corner[i]);
    }
    large.add(std::move(node));
    small.uploadAll(*renderer);
    const Image expected = picture(small, viewAlongZ(eye, 400, 400));
    ASSERT_GT(count(expected, kRed), 5000);
    remake({});
    large.uploadAll(*renderer);
    EXPECT_EQ(picture(large, viewAlongZ(eye, 400, 400)).pixels, expected.pixels);
}

// Positions in steps of 8 m, the eye 3 m right of and 2 m below a grid point: the square from -8 to 8 lies
// from -11 to 5 across and from -6 to 10 upward, on pixels 9 to 24 and 10 to 25 of 40.
TEST_F(DrawTest, PutsTheEyeBetweenTheStepsOfTheGrid) {
    World world;
    world.add(colouredRectangle(-8, -8, 8, 8, -24, kRed), {}, 0, 8.0);
    world.uploadAll(*renderer);
    const Image image = picture(world, viewAlongZ({3, -2, -4}, 40, 40));
    for (int y = 0; y < 40; ++y) {
        const bool inside = y >= 10 && y <= 25;
        EXPECT_EQ(row(image, y, {{'r', kRed}}),
                  inside ? std::string(9, '.') + std::string(16, 'r') + std::string(15, '.')
                         : std::string(40, '.'));
    }
}

// What the vertex shader adds up, against the same in double: two roundings to the last place of the result,
// and the rounding of the fine part, which is below 1e-7 m within 10,000 km.
RC_GTEST_PROP(SplitTranslation, KeepsPositionsNearTheEyeToTheLastPlace, ()) {
    const double step = std::ldexp(1.0, -*rc::gen::inRange(0, 13));
    const auto anywhere = rc::gen::inRange<std::int64_t>(-7'000'000'000, 7'000'000'000);
    for (int i = 0; i < 3; ++i) {
        const double origin = static_cast<double>(*anywhere) * 1e-3;
        const double onGrid = static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1 << 24)) * step;
        const double nearby = static_cast<double>(*rc::gen::inRange<std::int64_t>(-200'000, 200'000)) * 1e-4;
        const double eye = origin + onGrid + nearby;
        const SplitTranslation split = splitTranslation(glm::dvec3(origin), glm::dvec3(eye));
        const auto position = static_cast<float>(onGrid);
        const float coarseSum = position + split.coarse[i];
        const float result = coarseSum + split.fine[i];
        const double exact = onGrid + (origin - eye);
        RC_ASSERT(std::abs(result - exact) <= 0x1p-23 * std::abs(exact) + 1e-7);
    }
}

// A camera turned to +x with z up: right is -y. 90 degrees over a height of 100: 1 m at 50 m is a pixel.
TEST(FrameData, MapsMetresToThePictureAsTheViewSays) {
    View view;
    view.camera = lookAt({1000, 2000, 30}, {1001, 2000, 30}, {0, 0, 1});
    view.camera.fovyRadians = 1.5707963267948966;
    view.camera.nearMetres = 0.25;
    view.width = 200;
    view.height = 100;
    const gpu::FrameData frame = frameData(view, {0, 0, 5});
    const auto clip = [&](const glm::vec3& p) {
        return glm::vec4(glm::dot(frame.clipX, p), glm::dot(frame.clipY, p), frame.nearMetres,
                         glm::dot(frame.clipW, p));
    };
    const glm::vec4 ahead = clip({50, 0, 0}), side = clip({50, -40, 20});
    EXPECT_NEAR(ahead.w, 50.0f, 1e-5);
    EXPECT_NEAR(ahead.x, 0.0f, 1e-5);
    EXPECT_NEAR(ahead.y, 0.0f, 1e-5);
    EXPECT_FLOAT_EQ(ahead.z / ahead.w, 0.005f);
    EXPECT_NEAR(side.x / side.w, 40.0 / 100.0, 1e-6);  // 40 of 100 pixels to the right
    EXPECT_NEAR(side.y / side.w, 20.0 / 50.0, 1e-6);   // 20 of 50 upward
    EXPECT_EQ(frame.up, glm::vec3(0, 0, 1));
    EXPECT_EQ(frameData(view, {0, 0, 0}).up, glm::vec3(0, 1, 0));
    EXPECT_EQ(frameData(view, {NAN, 0, 0}).up, glm::vec3(0, 1, 0));
}

}  // namespace fb::draw_test
