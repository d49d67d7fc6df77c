#include "measure/image_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.h"

namespace fb {
namespace {

Image flat(int width, int height, int channels, std::uint8_t value) {
    Image image{width, height, channels, {}, true};
    image.pixels.assign(std::size_t(width) * std::size_t(height) * std::size_t(channels), value);
    return image;
}

Image noise(int width, int height, std::uint64_t seed) {
    Image image = flat(width, height, 3, 0);
    Random random(seed);
    for (std::uint8_t& p : image.pixels) p = static_cast<std::uint8_t>(random.index(256));
    return image;
}

TEST(CompareImages, FindsNoErrorInIdenticalPictures) {
    const Image image = noise(20, 15, 1);
    const Result<ImageError> error = compareImages(image, image);
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->meanSquaredError, 0.0);
    EXPECT_TRUE(std::isinf(error->psnrDb) && error->psnrDb > 0.0);
    EXPECT_EQ(error->ssim, 1.0);
}

TEST(CompareImages, GivesAnOffsetItsDecibels) {
    for (int offset : {1, 10, 255}) {
        const Result<ImageError> error =
            compareImages(flat(16, 16, 3, 0), flat(16, 16, 3, static_cast<std::uint8_t>(offset)));
        ASSERT_TRUE(error.has_value());
        EXPECT_DOUBLE_EQ(error->meanSquaredError, offset * offset);
        EXPECT_NEAR(error->psnrDb, 20.0 * std::log10(255.0 / offset), 1e-12);
    }
}

// One channel of one pixel of 4 x 4 x 3 off by 24: 576 / 48 = 12.
TEST(CompareImages, CountsEveryChannelOfEveryPixel) {
    Image other = flat(4, 4, 3, 100);
    other.pixels[17] = 124;
    EXPECT_DOUBLE_EQ(compareImages(flat(4, 4, 3, 100), other)->meanSquaredError, 12.0);
}

TEST(CompareImages, LeavesAlphaOutAndTakesGreyAsColour) {
    Image rgba = flat(12, 12, 4, 80);
    for (std::size_t i = 3; i < rgba.pixels.size(); i += 4) rgba.pixels[i] = 7;
    EXPECT_EQ(compareImages(rgba, flat(12, 12, 3, 80))->meanSquaredError, 0.0);
    EXPECT_EQ(compareImages(rgba, flat(12, 12, 1, 80))->meanSquaredError, 0.0);
    EXPECT_DOUBLE_EQ(compareImages(flat(12, 12, 1, 82), rgba)->meanSquaredError, 4.0);
}

// Without variance only the means are left: (2*50*100 + c1) / (50^2 + 100^2 + c1), c1 = 2.55^2.
TEST(CompareImages, GivesFlatPicturesTheSimilarityOfTheirMeans) {
    const double expected = (10000.0 + 6.5025) / (12500.0 + 6.5025);
    EXPECT_NEAR(compareImages(flat(30, 20, 3, 50), flat(30, 20, 3, 100))->ssim, expected, 1e-9);
}

TEST(CompareImages, FallsWithTheStructure) {
    Image negative = noise(40, 40, 5);
    for (std::uint8_t& p : negative.pixels) p = static_cast<std::uint8_t>(255 - p);
    EXPECT_LT(compareImages(noise(40, 40, 5), negative)->ssim, -0.5);
    EXPECT_LT(std::abs(compareImages(noise(40, 40, 5), noise(40, 40, 6))->ssim), 0.1);
}

// The definition as it stands in the paper, window by window in two dimensions.
double slowSsim(const Image& a, const Image& b, int radius) {
    const auto luma = [](const Image& image, int x, int y) {
        const std::uint8_t* p = &image.pixels[3 * std::size_t(y * image.width + x)];
        return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    };
    double total = 0.0;
    int windows = 0;
    for (int y = radius; y < a.height - radius; ++y) {
        for (int x = radius; x < a.width - radius; ++x, ++windows) {
            double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, cross = 0;
            for (int pass = 0; pass < 2; ++pass) {
                for (int j = -radius; j <= radius; ++j) {
                    for (int i = -radius; i <= radius; ++i) {
                        const double w = std::exp(-(i * i + j * j) / 4.5);
                        const double la = luma(a, x + i, y + j), lb = luma(b, x + i, y + j);
                        if (pass == 0) {
                            weights += w;
                            ma += w * la;
                            mb += w * lb;
                        } else {
                            va += w * (la - ma) * (la - ma) / weights;
                            vb += w * (lb - mb) * (lb - mb) / weights;
                            cross += w * (la - ma) * (lb - mb) / weights;
                        }
                    }
                }
                if (pass == 0) {
                    ma /= weights;
                    mb /= weights;
                }
            }
            const double c1 = 6.5025, c2 = 58.5225;
            total += (2 * ma * mb + c1) * (2 * cross + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        }
    }
    return total / windows;
}

TEST(CompareImages, AgreesWithTheDefinitionOfSsim) {
    for (const std::array<int, 3>& size : {std::array{15, 13, 5}, std::array{11, 11, 5}, std::array{7, 20, 3},
                                           std::array{4, 4, 1}, std::array{1, 9, 0}}) {
        const Image a = noise(size[0], size[1], 3), b = noise(size[0], size[1], 4);
        EXPECT_NEAR(compareImages(a, b)->ssim, slowSsim(a, b, size[2]), 1e-10) << size[0];
    }
}

TEST(CompareImages, RefusesPicturesOfDifferentSizes) {
    const Result<ImageError> error = compareImages(flat(4, 3, 3, 0), flat(3, 4, 3, 0));
    ASSERT_FALSE(error.has_value());
    EXPECT_NE(error.error().reason.find("4x3"), std::string::npos);
    EXPECT_NE(error.error().reason.find("3x4"), std::string::npos);
}

TEST(CompareImages, RefusesPicturesWithoutTheirPixels) {
    Image torn = flat(4, 4, 3, 0);
    torn.pixels.pop_back();
    EXPECT_FALSE(compareImages(torn, flat(4, 4, 3, 0)).has_value());
    EXPECT_FALSE(compareImages(flat(4, 4, 3, 0), torn).has_value());
    EXPECT_FALSE(compareImages(Image{}, Image{}).has_value());
    EXPECT_FALSE(compareImages(flat(2, 2, 5, 0), flat(2, 2, 5, 0)).has_value());
}

// Squared errors 0 and 200, mean 100: 20 log10(25.5).
TEST(SummariseImageErrors, TakesDecibelsOfTheMeanError) {
    const double inf = std::numeric_limits<double>::infinity();
    const std::array errors = {ImageError{0.0, inf, 1.0}, ImageError{200.0, 25.12, 0.5}};
    const ImageErrorSummary summary = summariseImageErrors(errors);
    EXPECT_EQ(summary.pictures, 2u);
    EXPECT_NEAR(summary.psnrDb, 20.0 * std::log10(25.5), 1e-12);
    EXPECT_NEAR(summary.worstPsnrDb, 10.0 * std::log10(255.0 * 255.0 / 200.0), 1e-12);
    EXPECT_DOUBLE_EQ(summary.ssim, 0.75);
    EXPECT_EQ(summary.worstSsim, 0.5);
    EXPECT_TRUE(std::isinf(summariseImageErrors(std::span(errors).first(1)).psnrDb));
    EXPECT_EQ(summariseImageErrors({}).pictures, 0u);
}

}  // namespace
}  // namespace fb
