#include "build/resample_image.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"
#include "build/cover_texels.h"
#include "build/spread_texels.h"

namespace fb {
namespace {

Image grey(int width, int height, std::vector<std::uint8_t> pixels) {
    return {width, height, 1, std::move(pixels), false};
}
Image blank(int width, int height) {
    return grey(width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), 0));
}

TEST(ResampleArea, CopiesWholeTexelsExactlyAndShowsNeighboursInTheGutter) {
    const Image source = grey(4, 2, {10, 20, 30, 40, 50, 60, 70, 80});
    Image target = blank(6, 4);
    resampleArea(source, {1, 0, 2, 2}, EdgeMode::extend, {target, 2, 1, 2, 2, 1});
    EXPECT_EQ(target.pixels,
              (std::vector<std::uint8_t>{0, 10, 20, 30, 40, 0,  // above the picture: its edge again
                                         0, 10, 20, 30, 40, 0,  //
                                         0, 50, 60, 70, 80, 0,  //
                                         0, 50, 60, 70, 80, 0}));
}

TEST(ResampleArea, RepeatsOrExtendsBeyondTheEdge) {
    const Image source = grey(2, 1, {10, 20});
    Image target = blank(6, 1);
    resampleArea(source, {-2, 0, 6, 1}, EdgeMode::repeat, {target, 0, 0, 6, 1, 0});
    EXPECT_EQ(target.pixels, (std::vector<std::uint8_t>{10, 20, 10, 20, 10, 20}));
    resampleArea(source, {-2, 0, 6, 1}, EdgeMode::extend, {target, 0, 0, 6, 1, 0});
    EXPECT_EQ(target.pixels, (std::vector<std::uint8_t>{10, 10, 10, 20, 20, 20}));
}

TEST(ResampleArea, GivesEachTexelTheMeanOfWhatItCovers) {
    const Image source = grey(3, 1, {0, 90, 240});
    Image target = blank(2, 1);
    resampleArea(source, {0, 0, 3, 1}, EdgeMode::extend, {target, 0, 0, 2, 1, 0});
    EXPECT_EQ(target.pixels, (std::vector<std::uint8_t>{30, 190}));  // (0 + 90/2) / 1.5, (90/2 + 240) / 1.5
    Image square = blank(1, 1);
    resampleArea(grey(2, 2, {0, 10, 20, 31}), {0, 0, 2, 2}, EdgeMode::extend, {square, 0, 0, 1, 1, 0});
    EXPECT_EQ(square.pixels[0], 15);  // 15.25
}

TEST(ResampleArea, LeavesOutWhatLiesOutsideTheTarget) {
    const Image source = grey(2, 2, {1, 2, 3, 4});
    Image target = blank(2, 2);
    resampleArea(source, {0, 0, 2, 2}, EdgeMode::extend, {target, 0, 0, 2, 2, 2});
    EXPECT_EQ(target.pixels, source.pixels);
    resampleArea(source, {0, 0, 2, 2}, EdgeMode::extend, {target, 5, 5, 2, 2, 1});
    EXPECT_EQ(target.pixels, source.pixels);
}

RC_GTEST_PROP(ResampleArea, KeepsTheMeanOfThePicture, (std::uint64_t seed)) {
    Random random(seed);
    const int w = 1 + static_cast<int>(random.index(40)), h = 1 + static_cast<int>(random.index(40));
    const int tw = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(w)));
    const int th = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(h)));
    Image source = blank(w, h);
    double sum = 0.0;
    for (std::uint8_t& p : source.pixels) {
        p = static_cast<std::uint8_t>(random.index(256));
        sum += p;
    }
    Image target = blank(tw, th);
    resampleArea(source, {0, 0, double(w), double(h)}, EdgeMode::extend, {target, 0, 0, tw, th, 0});
    double mean = 0.0;
    for (const std::uint8_t p : target.pixels) mean += p;
    RC_ASSERT(std::abs(mean / (tw * th) - sum / (w * h)) <= 0.51);  // rounding to bytes
}

// Next to known texels a copy of one of them; farther away something between the least and the greatest of them all.
RC_GTEST_PROP(FillUnknown, CopiesNeighboursAndStaysBetweenThem, (std::uint64_t seed)) {
    Random random(seed);
    const int w = 1 + static_cast<int>(random.index(200)), h = 1 + static_cast<int>(random.index(200));
    Image image = blank(w, h);
    std::vector<std::uint8_t> known(image.pixels.size(), 0);
    int least = 255, greatest = 0;
    for (std::uint64_t i = 0; i < 1 + random.index(12); ++i) {
        const std::size_t at = random.index(known.size());
        known[at] = 1;
        image.pixels[at] = static_cast<std::uint8_t>(50 + random.index(150));
    }
    for (std::size_t at = 0; at < known.size(); ++at) {
        if (known[at] == 0) continue;
        least = std::min<int>(least, image.pixels[at]);
        greatest = std::max<int>(greatest, image.pixels[at]);
    }
    const Image before = image;
    fillUnknown(image, known, 0, 1);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const auto at = static_cast<std::size_t>(y * w + x);
            if (known[at] != 0) RC_ASSERT(image.pixels[at] == before.pixels[at]);
            RC_ASSERT(image.pixels[at] >= least);
            RC_ASSERT(image.pixels[at] <= greatest);
            bool beside = false, copied = false;
            for (const glm::ivec2& step : {glm::ivec2(-1, 0), glm::ivec2(1, 0), glm::ivec2(0, -1), glm::ivec2(0, 1)}) {
                const int nx = x + step.x, ny = y + step.y;
                if (nx < 0 || ny < 0 || nx >= w || ny >= h) continue;
                const auto neighbour = static_cast<std::size_t>(ny * w + nx);
                if (known[neighbour] == 0) continue;
                beside = true;
                copied = copied || before.pixels[neighbour] == image.pixels[at];
            }
            if (known[at] == 0 && beside) RC_ASSERT(copied);
        }
    }
}

TEST(FillUnknown, OfNothingKnownChangesNothing) {
    Image image = grey(2, 1, {3, 4});
    fillUnknown(image, {0, 0}, 0, 1);
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{3, 4}));
}

TEST(FillUnknown, ChangesOnlyTheChannelsAskedFor) {
    Image image{2, 1, 2, {10, 20, 30, 40}, false};
    fillUnknown(image, {1, 0}, 1, 2);
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{10, 20, 30, 20}));
}

std::vector<std::uint8_t> maskOf(const std::array<glm::dvec2, 3>& corners, int width, int height) {
    std::vector<std::uint8_t> shown(static_cast<std::size_t>(width * height), 0);
    coverTexels(corners, width, height, [&](int row, int begin, int end) {
        for (int x = begin; x < end; ++x) shown[static_cast<std::size_t>(row * width + x)] = 1;
    });
    return shown;
}

std::vector<int> covered(const std::array<glm::dvec2, 3>& corners, int width, int height) {
    const std::vector<std::uint8_t> shown = maskOf(corners, width, height);
    std::vector<int> result;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown[i] != 0) result.push_back(static_cast<int>(i));
    }
    return result;
}

TEST(CoverTexels, MarksEveryTexelThatTheTriangleTouches) {
    // 4 x 4 texels; the right triangle with legs 3 touches 3 + 2 + 1 texels below its long edge and the
    // diagonal ones.
    EXPECT_EQ(covered({glm::dvec2(0, 0), glm::dvec2(3, 0), glm::dvec2(0, 3)}, 4, 4),
              (std::vector<int>{0, 1, 2, 4, 5, 8}));
    EXPECT_EQ(covered({glm::dvec2(0, 0), glm::dvec2(3.5, 0), glm::dvec2(0, 3.5)}, 4, 4),
              (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 8, 9, 12}));
}

TEST(CoverTexels, WrapsAroundWhereTheTextureRepeats) {
    EXPECT_EQ(covered({glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(1, 2)}, 4, 4),
              (std::vector<int>{4, 7}));
    EXPECT_EQ(covered({glm::dvec2(0, 0), glm::dvec2(1e9, 0), glm::dvec2(0, 1e9)}, 3, 1),
              (std::vector<int>{0, 1, 2}));
}

RC_GTEST_PROP(CoverTexels, MarksTheTexelsOfRandomPointsOfTheTriangle, (std::uint64_t seed)) {
    Random random(seed);
    std::array<glm::dvec2, 3> corners;
    for (glm::dvec2& c : corners) c = {random.uniform(-20, 30), random.uniform(-20, 30)};
    const std::vector<std::uint8_t> shown = maskOf(corners, 16, 8);
    for (int i = 0; i < 200; ++i) {
        double a = random.uniform(), b = random.uniform();
        if (a + b > 1.0) {
            a = 1.0 - a;
            b = 1.0 - b;
        }
        const glm::dvec2 p = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
        const glm::dvec2 inTexel = p - glm::floor(p);
        const glm::dvec2 edge = glm::min(inTexel, 1.0 - inTexel);
        if (std::min(edge.x, edge.y) < 2 * kTexelTolerance) continue;
        const auto x = ((static_cast<int>(std::floor(p.x)) % 16) + 16) % 16;
        const auto y = ((static_cast<int>(std::floor(p.y)) % 8) + 8) % 8;
        RC_ASSERT(shown[static_cast<std::size_t>(y * 16 + x)] == 1);
    }
}

}  // namespace
}  // namespace fb
