// Times come with the number of their frame, oldest first.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include "draw/draw_world.h"

namespace fb::draw_test {

namespace {

void drawFrames(Renderer& renderer, std::uint64_t first, std::uint64_t last) {
    const World world;
    const DrawSettings settings;
    const ActiveEffects effects;
    const View view = viewAlongZ({}, 32, 32);
    for (std::uint64_t frame = first; frame <= last; ++frame) {
        renderer.draw({world.hierarchy, world.front, view, settings, effects}, frame);
    }
}

std::vector<std::uint64_t> takeAll(Renderer& renderer) {
    std::vector<std::uint64_t> frames;
    DrawTime time;
    while (renderer.takeTime(time)) {
        frames.push_back(time.frame);
        EXPECT_GE(time.milliseconds, 0.0);
        EXPECT_LT(time.milliseconds, 10'000.0);
    }
    return frames;
}

}  // namespace

TEST_F(DrawTest, MeasuresEveryFrameByTheWallClock) {
    RendererOptions options;
    options.wallClock = true;
    remake(options);
    EXPECT_TRUE(renderer->deviceName().ends_with(", wall clock")) << renderer->deviceName();
    EXPECT_EQ(takeAll(*renderer), std::vector<std::uint64_t>{});
    drawFrames(*renderer, 5, 7);
    EXPECT_EQ(takeAll(*renderer), (std::vector<std::uint64_t>{5, 6, 7}));
    EXPECT_EQ(takeAll(*renderer), std::vector<std::uint64_t>{});
    drawFrames(*renderer, 8, 30);  // nobody takes: the eight newest are kept
    EXPECT_EQ(takeAll(*renderer), (std::vector<std::uint64_t>{23, 24, 25, 26, 27, 28, 29, 30}));
}

TEST_F(DrawTest, MeasuresByQueriesWithoutWaiting) {
    RendererOptions options;
    options.wallClock = false;
    remake(options);
    EXPECT_TRUE(renderer->deviceName().ends_with(", timer queries")) << renderer->deviceName();
    drawFrames(*renderer, 1, 12);  // eight queries are under way, then frames go unmeasured
    glFinish();
    EXPECT_EQ(takeAll(*renderer), (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8}));
    drawFrames(*renderer, 13, 14);
    glFinish();
    EXPECT_EQ(takeAll(*renderer), (std::vector<std::uint64_t>{13, 14}));
}

TEST_F(DrawTest, UsesTheWallClockOnASoftwareRasteriser) {
    const bool software = renderer->softwareRasteriser();
    EXPECT_EQ(software, renderer->deviceName().ends_with(", wall clock"));
    EXPECT_EQ(software, renderer->deviceName().find("llvmpipe") != std::string::npos);
}

}  // namespace fb::draw_test
