#include "control/model_device.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "worlds/tiny_worlds.h"

namespace fb {
namespace {

// Nothing is filled, uploaded or hidden.
double frameMs(const ModelSettings& settings, const FrameWork& work, std::uint64_t frame) {
    ModelCounts counts;
    return modelFrameMs(settings, work, frame, counts);
}

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
    EXPECT_EQ(frameMs(settings, {0, 0, 0}, 1), 2.0);
    EXPECT_EQ(frameMs(settings, {10, 0, 0}, 1), 7.0);
    EXPECT_EQ(frameMs(settings, {0, 10, 0}, 1), 4.5);
    EXPECT_EQ(frameMs(settings, {0, 0, 8}, 1), 3.0);
    EXPECT_EQ(frameMs(settings, {10, 10, 8}, 1), 10.5);
}

TEST(ModelDevice, CountsMoreThan32BitsOfTriangles) {
    EXPECT_EQ(frameMs(exactModel(), {0x200000000ull, 0, 0}, 1), 2.0 + 0.5 * 8589934592.0);
}

TEST(ModelDevice, WithoutNoiseEveryFrameAndSeedTakesTheSameTime) {
    ModelSettings settings = exactModel();
    for (std::int64_t seed : {0, 1, 1000000000}) {
        settings.seed = seed;
        for (std::uint64_t frame : {0ull, 1ull, 77ull, ~0ull})
            EXPECT_EQ(frameMs(settings, {10, 10, 8}, frame), 10.5);
    }
}

TEST(ModelDevice, NoiseDependsOnSeedAndFrameAlone) {
    ModelSettings settings = exactModel();
    settings.noisePct = 3.0;
    std::vector<double> forward, backward;
    for (std::uint64_t frame = 0; frame < 100; ++frame)
        forward.push_back(frameMs(settings, {10, 0, 0}, frame));
    for (std::uint64_t frame = 100; frame-- > 0;) {
        // Whatever was drawn in between, and however heavy the frame is: the factor is the frame's own.
        const double heavy = frameMs(settings, {9990, 10, 3}, frame);
        backward.push_back(frameMs(settings, {10, 0, 0}, frame));
        EXPECT_NEAR(heavy / (2.0 + 0.5 * 9990 + 0.25 * 10 + 0.125 * 3), backward.back() / 7.0, 1e-12);
    }
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(forward[i], backward[99 - i]);
    settings.seed = 2;
    int same = 0;
    for (std::uint64_t frame = 0; frame < 100; ++frame)
        same += frameMs(settings, {10, 0, 0}, frame) == forward[frame];
    EXPECT_EQ(same, 0);
}

TEST(ModelDevice, NoiseHasTheMeanAndDeviationOfTheSettingAndNoMemory) {
    ModelSettings settings = exactModel();
    settings.noisePct = 3.0;
    constexpr int kFrames = 100000;
    double sum = 0.0, squares = 0.0, neighbours = 0.0, before = 0.0, most = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double noise =
            frameMs(settings, {10, 0, 0}, static_cast<std::uint64_t>(frame)) / 7.0 - 1.0;
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

// --- what is hidden, and what is filled, uploaded and does not fit ---
Hierarchy threeNodes() {
    Hierarchy h = makeWorld({{}, {}, {}});
    h.texturedTriangles = {10, 10, 10};
    h.untexturedTriangles = {4, 4, 4};
    h.textureWidth = h.textureHeight = {512, 512, 0};
    return h;
}
constexpr std::array<NodeId, 3> kAllThree = {0, 1, 2};

TEST(ModelDevice, CountsNoTermThatIsNotCalledFor) {
    ModelSettings settings = exactModel();
    settings.fillMsPerMegapixel = 0.0;
    ModelCounts counts;
    const FrameWork work = modelWork(settings, threeNodes(), kAllThree, 0.0, 5 << 20, counts);
    EXPECT_EQ(modelFrameMs(settings, work, 7, counts), 2.0 + 0.5 * 30 + 0.25 * 12 + 0.125 * 3);
    for (const std::uint64_t count : {counts.spread, counts.textures, counts.drift, counts.noise, counts.stall})
        EXPECT_EQ(count, 0u);
}

TEST(ModelDevice, AddsFillUploadsAndTexturesThatDoNotFit) {
    ModelSettings settings = exactModel();
    settings.fillMsPerMegapixel = 4.0;
    settings.uploadMsPerMiB = 0.5;
    settings.textureMemoryMiB = 1.0;
    settings.thrashMsPerMiB = 3.0;
    ModelCounts counts;
    const Hierarchy h = threeNodes();
    const FrameWork work = modelWork(settings, h, kAllThree, 0.75, 6 << 20, counts);
    const double mib = 2.0 * static_cast<double>(h.textureBytes(0)) / 1048576.0;
    EXPECT_DOUBLE_EQ(modelFrameMs(settings, work, 7, counts),
                     2.0 + 0.5 * 30 + 0.25 * 12 + 0.125 * 3 + 4.0 * 0.75 + 0.5 * 6 + 3.0 * (mib - 1.0));
    EXPECT_EQ(counts.textures, 3u);
    settings.textureMemoryMiB = 100.0;
    EXPECT_EQ(modelWork(settings, h, kAllThree, 0.75, 0, counts).textureMiB, 0.0) << "all of it fits";
}

TEST(ModelDevice, HidesAFactorOfEachNodeThatStaysTheSame) {
    ModelSettings settings = exactModel();
    settings.spreadPct = 20.0;
    ModelCounts counts;
    const Hierarchy h = threeNodes();
    const auto factorOf = [&](NodeId n) {
        const std::array<NodeId, 1> one = {n};
        return modelWork(settings, h, one, 0.0, 0, counts).texturedTriangles / 10.0;
    };
    EXPECT_NE(factorOf(0), factorOf(1));
    EXPECT_EQ(factorOf(1), factorOf(1));
    EXPECT_DOUBLE_EQ(modelWork(settings, h, kAllThree, 0.0, 0, counts).untexturedTriangles,
                     4.0 * (factorOf(0) + factorOf(1) + factorOf(2)));
    EXPECT_EQ(counts.spread, 10u);
}

TEST(ModelDevice, DriftsSlowlyWithTheDeviationOfTheSetting) {
    ModelSettings settings = exactModel();
    settings.driftPct = 12.0;
    settings.driftSeconds = 8.0;
    settings.rateHz = 30.0;
    double sum = 0.0, squares = 0.0, step = 0.0, before = 1.0;
    constexpr int kFrames = 400000;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double speed = frameMs(settings, {10, 0, 0}, static_cast<std::uint64_t>(frame)) / 7.0;
        if (frame > 0) step = std::max(step, std::abs(speed - before));
        before = speed;
        sum += speed - 1.0;
        squares += (speed - 1.0) * (speed - 1.0);
    }
    // 1667 independent values: five standard errors.
    EXPECT_NEAR(sum / kFrames, 0.0, 5.0 * 0.12 / std::sqrt(kFrames / 240.0));
    EXPECT_NEAR(std::sqrt(squares / kFrames), 0.12, 5.0 * 0.12 / std::sqrt(2.0 * kFrames / 240.0));
    EXPECT_LT(step, 0.02) << "from one frame to the next";
}

TEST(ModelDevice, StallsInThePartOfTheFramesOfTheSetting) {
    ModelSettings settings = exactModel();
    settings.stallPct = 2.0;
    settings.stallMs = 100.0;
    int stalls = 0;
    constexpr int kFrames = 50000;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double ms = frameMs(settings, {10, 0, 0}, static_cast<std::uint64_t>(frame));
        EXPECT_TRUE(ms == 7.0 || ms == 107.0);
        stalls += ms == 107.0;
    }
    EXPECT_NEAR(stalls, 0.02 * kFrames, 5.0 * std::sqrt(0.02 * 0.98 * kFrames));
}

TEST(ModelDevice, NeverTakesLessThanNoTime) {
    ModelSettings settings = exactModel();
    settings.noisePct = 100.0;
    int stopped = 0;
    for (std::uint64_t frame = 0; frame < 1000; ++frame) {
        const double ms = frameMs(settings, {10, 0, 0}, frame);
        EXPECT_GE(ms, 0.0);
        stopped += ms == 0.0;
    }
    EXPECT_GT(stopped, 100);  // 16 % of the noise is below -1
}

}  // namespace
}  // namespace fb
