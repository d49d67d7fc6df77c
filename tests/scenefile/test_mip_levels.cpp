#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "scenefile/mip_levels.h"
#include "scenefile/node_data.h"

namespace fb {
namespace {

using Texel = std::array<std::uint8_t, 4>;

// Level 0 and room for the others.
std::vector<std::uint8_t> levelsOf(const std::vector<Texel>& texels, std::uint32_t width,
                                   std::uint32_t height) {
    std::vector<std::uint8_t> all(mippedBytes(width, height), 0xcd);
    for (std::size_t i = 0; i < texels.size(); ++i)
        std::copy(texels[i].begin(), texels[i].end(), &all[i * 4]);
    return all;
}

Texel texelAt(const std::vector<std::uint8_t>& all, std::size_t index) {
    return {all[index * 4], all[index * 4 + 1], all[index * 4 + 2], all[index * 4 + 3]};
}

std::vector<Texel> greys(const std::vector<int>& values) {
    std::vector<Texel> texels;
    for (int v : values) {
        const auto grey = static_cast<std::uint8_t>(v);
        texels.push_back({grey, grey, grey, 255});
    }
    return texels;
}

//   10 20 | 0   0
//   30 40 | 0   1      25 | 0  (1/4 goes down)     (25 + 0 + 101 + 255 + 2) / 4 = 95
//   ------+--------    ---+----
//  100 101| 255 255   101 | 255  (100.5 goes up)
//  100 101| 255 255
TEST(BuildMipLevels, AveragesAFourByFourByHand) {
    std::vector<std::uint8_t> all =
        levelsOf(greys({10, 20, 0, 0, 30, 40, 0, 1, 100, 101, 255, 255, 100, 101, 255, 255}), 4, 4);
    buildMipLevels(all, 4, 4, MipAlpha::opaque);
    EXPECT_EQ(texelAt(all, 16), (Texel{25, 25, 25, 255}));
    EXPECT_EQ(texelAt(all, 17), (Texel{0, 0, 0, 255}));
    EXPECT_EQ(texelAt(all, 18), (Texel{101, 101, 101, 255}));
    EXPECT_EQ(texelAt(all, 19), (Texel{255, 255, 255, 255}));
    EXPECT_EQ(texelAt(all, 20), (Texel{95, 95, 95, 255}));
}

TEST(BuildMipLevels, AveragesEachChannelForItself) {
    std::vector<std::uint8_t> all =
        levelsOf({{4, 0, 255, 255}, {4, 0, 255, 255}, {8, 1, 0, 255}, {8, 1, 0, 255}}, 2, 2);
    buildMipLevels(all, 2, 2, MipAlpha::opaque);
    EXPECT_EQ(texelAt(all, 4), (Texel{6, 1, 128, 255}));  // 0.5 and 127.5 go up
}

// 1 + 2 + ... + 9 = 45, a ninth of it is 5: all nine texels count, not only a corner of four.
TEST(BuildMipLevels, AveragesAllOfAThreeByThree) {
    std::vector<std::uint8_t> all = levelsOf(greys({1, 2, 3, 4, 5, 6, 7, 8, 9}), 3, 3);
    buildMipLevels(all, 3, 3, MipAlpha::opaque);
    EXPECT_EQ(texelAt(all, 9), (Texel{5, 5, 5, 255}));
}

// Five texels become two; each covers two and a half: (2*0 + 2*10 + 1*50)/5 = 14 and (1*50 + 2*20 + 2*30)/5
// = 30.
TEST(BuildMipLevels, SharesTheMiddleOfFiveBetweenTwo) {
    std::vector<std::uint8_t> all = levelsOf(greys({0, 10, 50, 20, 30}), 5, 1);
    buildMipLevels(all, 5, 1, MipAlpha::opaque);
    EXPECT_EQ(texelAt(all, 5)[0], 14);
    EXPECT_EQ(texelAt(all, 6)[0], 30);
    EXPECT_EQ(texelAt(all, 7)[0], 22);
}

TEST(BuildMipLevels, KeepsASideOfOneWhileTheOtherHalves) {
    std::vector<std::uint8_t> all = levelsOf(greys({8, 16, 32, 64}), 1, 4);
    buildMipLevels(all, 1, 4, MipAlpha::opaque);
    EXPECT_EQ(texelAt(all, 4)[0], 12);
    EXPECT_EQ(texelAt(all, 5)[0], 48);
    EXPECT_EQ(texelAt(all, 6)[0], 30);
}

// Red leaf, green hole: the hole's colour must not be seen.
TEST(BuildMipLevels, DoesNotBleedTheColourOfHoles) {
    const Texel leaf = {200, 0, 0, 255};
    const Texel hole = {0, 255, 0, 0};
    std::vector<std::uint8_t> all = levelsOf({leaf, hole, hole, leaf}, 2, 2);
    buildMipLevels(all, 2, 2, MipAlpha::weighted);
    EXPECT_EQ(texelAt(all, 4), (Texel{200, 0, 0, 128}));  // 127.5 goes up
}

// Weights 255, 51, 0, 0: red (255*100 + 51*40) / 306 = 90; alpha 306 / 4 = 76.5 goes up.
TEST(BuildMipLevels, WeightsColoursByAlpha) {
    std::vector<std::uint8_t> all =
        levelsOf({{100, 0, 0, 255}, {40, 0, 0, 51}, {255, 9, 9, 0}, {255, 9, 9, 0}}, 2, 2);
    buildMipLevels(all, 2, 2, MipAlpha::weighted);
    EXPECT_EQ(texelAt(all, 4), (Texel{90, 0, 0, 77}));
}

TEST(BuildMipLevels, KeepsTheColourUnderAWholeHole) {
    std::vector<std::uint8_t> all =
        levelsOf({{10, 20, 30, 0}, {20, 20, 30, 0}, {30, 20, 30, 0}, {40, 20, 31, 0}}, 2, 2);
    buildMipLevels(all, 2, 2, MipAlpha::weighted);
    EXPECT_EQ(texelAt(all, 4), (Texel{25, 20, 30, 0}));
}

// One texel of each 2x2 is a leaf: every mean alpha is 64, all below the shader's 128, so plain averaging
// would make the whole fence vanish. A share of 1/4 of level 1's four texels is one, but all are equal: none
// (missing by 1) is nearer than four (missing by 3).
TEST(BuildMipLevels, TakesTheNearestCoverageThatThereIs) {
    std::vector<Texel> texels(16, Texel{0, 0, 0, 0});
    for (std::size_t i : {0u, 2u, 8u, 10u}) texels[i] = {9, 9, 9, 255};
    std::vector<std::uint8_t> all = levelsOf(texels, 4, 4);
    buildMipLevels(all, 4, 4, MipAlpha::mask);
    for (std::size_t i = 16; i < 21; ++i) EXPECT_LT(texelAt(all, i)[3], 128);
}

// Level 0 is a random mask of which 30 % are kept. A threshold can only take all texels of one alpha or none,
// so a level misses the share by at most half of its commonest alpha's share; the plain mean loses the mask
// altogether.
TEST(BuildMipLevels, KeepsTheCoverageOfAMask) {
    Random random(5);
    constexpr std::uint32_t kSide = 256;
    std::vector<Texel> texels;
    double share = 0.0;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const bool leaf = random.uniform() < 0.3;
        share += (leaf ? 1.0 : 0.0) / (kSide * kSide);
        texels.push_back({50, 100, 50, leaf ? std::uint8_t{255} : std::uint8_t{0}});
    }
    std::vector<std::uint8_t> weighted = levelsOf(texels, kSide, kSide);
    std::vector<std::uint8_t> masked = weighted;
    buildMipLevels(weighted, kSide, kSide, MipAlpha::weighted);
    buildMipLevels(masked, kSide, kSide, MipAlpha::mask);
    std::size_t first = std::size_t{kSide} * kSide;
    for (std::uint32_t side = kSide / 2; side >= 8; first += std::size_t{side} * side, side /= 2) {
        std::array<double, 256> shareOfAlpha{};
        double passing = 0.0, passingPlainly = 0.0;
        for (std::size_t i = first; i < first + std::size_t{side} * side; ++i) {
            const double part = 1.0 / (side * side);
            shareOfAlpha[texelAt(weighted, i)[3]] += part;
            passingPlainly += texelAt(weighted, i)[3] >= 128 ? part : 0.0;
            passing += texelAt(masked, i)[3] >= 128 ? part : 0.0;
        }
        EXPECT_NEAR(passing, share, std::ranges::max(shareOfAlpha) / 2.0 + 1e-9) << side;
        if (side > 32) continue;
        EXPECT_LT(passingPlainly, 0.01) << side;
    }
}

// The same by an independent slow way: double sums over the area that a texel covers.
RC_GTEST_PROP(BuildMipLevels, IsTheAreaMeanForAnySides, ()) {
    const auto width = *rc::gen::inRange<std::uint32_t>(1, 14);
    const auto height = *rc::gen::inRange<std::uint32_t>(1, 14);
    std::vector<Texel> texels(width * height);
    for (Texel& texel : texels) {
        for (std::size_t c = 0; c < 3; ++c) texel[c] = *rc::gen::arbitrary<std::uint8_t>();
        texel[3] = 255;
    }
    std::vector<std::uint8_t> all = levelsOf(texels, width, height);
    buildMipLevels(all, width, height, MipAlpha::opaque);
    const std::uint32_t w = std::max(1u, width / 2), h = std::max(1u, height / 2);
    if (width * height == 1) return;
    const auto overlap = [](double a0, double a1, double b0, double b1) {
        return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
    };
    for (std::uint32_t y = 0; y < h; ++y) {
        for (std::uint32_t x = 0; x < w; ++x) {
            double sum = 0.0;
            const double sx = static_cast<double>(width) / w, sy = static_cast<double>(height) / h;
            for (std::uint32_t j = 0; j < height; ++j) {
                for (std::uint32_t i = 0; i < width; ++i) {
                    sum += overlap(x * sx, (x + 1) * sx, i, i + 1) * overlap(y * sy, (y + 1) * sy, j, j + 1) *
                           texels[j * width + i][1];
                }
            }
            const Texel got = texelAt(all, std::size_t{width} * height + std::size_t{y} * w + x);
            RC_ASSERT(std::abs(got[1] - sum / (sx * sy)) < 0.5 + 1e-9);
            RC_ASSERT(got[3] == 255);
        }
    }
}

}  // namespace
}  // namespace fb
