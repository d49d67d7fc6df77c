#include "control/model_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fb {
namespace {

// Times that add up without rounding: microseconds are multiples of 1000 / 2^k ms.
ModelSettings exactModel() {
    ModelSettings settings;
    settings.overheadMs = 2.0;
    settings.texturedUs = 500.0;
    settings.untexturedUs = 250.0;
    settings.nodeUs = 125.0;
    settings.noisePct = 0.0;
    return settings;
}

TEST(ModelDevice, AddsUpOverheadTrianglesAndNodes) {
    const ModelSettings settings = exactModel();
    EXPECT_EQ(modelFrameMs(settings, {0, 0, 0}, 1), 2.0);
    EXPECT_EQ(modelFrameMs(settings, {10, 0, 0}, 1), 7.0);
    EXPECT_EQ(modelFrameMs(settings, {0, 10, 0}, 1), 4.5);
    EXPECT_EQ(modelFrameMs(settings, {0, 0, 8}, 1), 3.0);
    EXPECT_EQ(modelFrameMs(settings, {10, 10, 8}, 1), 10.5);
}

TEST(ModelDevice, CountsMoreThan32BitsOfTriangles) {
    EXPECT_EQ(modelFrameMs(exactModel(), {0x200000000ull, 0, 0}, 1), 2.0 + 0.5 * 8589934592.0);
}

TEST(ModelDevice, WithoutNoiseEveryFrameAndSeedTakesTheSameTime) {
    ModelSettings settings = exactModel();
    for (std::int64_t seed : {0, 1, 1000000000}) {
        settings.seed = seed;
        for (std::uint64_t frame : {0ull, 1ull, 77ull, ~0ull})
            EXPECT_EQ(modelFrameMs(settings, {10, 10, 8}, frame), 10.5);
    }
}

TEST(ModelDevice, NoiseDependsOnSeedAndFrameAlone) {
    ModelSettings settings = exactModel();
    settings.noisePct = 3.0;
    std::vector<double> forward, backward;
    for (std::uint64_t frame = 0; frame < 100; ++frame)
        forward.push_back(modelFrameMs(settings, {10, 0, 0}, frame));
    for (std::uint64_t frame = 100; frame-- > 0;) {
        // Whatever was drawn in between, and however heavy the frame is: the factor is the frame's own.
        const double heavy = modelFrameMs(settings, {9990, 10, 3}, frame);
        backward.push_back(modelFrameMs(settings, {10, 0, 0}, frame));
        EXPECT_NEAR(heavy / (2.0 + 0.5 * 9990 + 0.25 * 10 + 0.125 * 3), backward.back() / 7.0, 1e-12);
    }
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(forward[i], backward[99 - i]);
    settings.seed = 2;
    int same = 0;
    for (std::uint64_t frame = 0; frame < 100; ++frame)
        same += modelFrameMs(settings, {10, 0, 0}, frame) == forward[frame];
    EXPECT_EQ(same, 0);
}

TEST(ModelDevice, NoiseHasTheMeanAndDeviationOfTheSettingAndNoMemory) {
    ModelSettings settings = exactModel();
    settings.noisePct = 3.0;
    constexpr int kFrames = 100000;
    double sum = 0.0, squares = 0.0, neighbours = 0.0, before = 0.0, most = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double noise =
            modelFrameMs(settings, {10, 0, 0}, static_cast<std::uint64_t>(frame)) / 7.0 - 1.0;
        sum += noise;
        squares += noise * noise;
        neighbours += noise * before;
        before = noise;
        most = std::max(most, std::abs(noise));
    }
    const double sd = 0.03;
    EXPECT_NEAR(sum / kFrames, 0.0, 5.0 * sd / std::sqrt(kFrames));  // five standard errors
    EXPECT_NEAR(std::sqrt(squares / kFrames), sd, 5.0 * sd / std::sqrt(2.0 * kFrames));
    EXPECT_NEAR(neighbours / squares, 0.0, 5.0 / std::sqrt(kFrames));
    EXPECT_LE(most, 6.0 * sd);
    EXPECT_GT(most, 3.5 * sd);
}

TEST(ModelDevice, NeverTakesLessThanNoTime) {
    ModelSettings settings = exactModel();
    settings.noisePct = 100.0;
    int stopped = 0;
    for (std::uint64_t frame = 0; frame < 1000; ++frame) {
        const double ms = modelFrameMs(settings, {10, 0, 0}, frame);
        EXPECT_GE(ms, 0.0);
        stopped += ms == 0.0;
    }
    EXPECT_GT(stopped, 100);  // 16 % of the noise is below -1
}

}  // namespace
}  // namespace fb
