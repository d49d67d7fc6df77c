#include "measure/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fb {
namespace {

std::string sizeText(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

bool isWhole(const Image& image) {
    return image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
           image.pixels.size() ==
               std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels);
}

double decibels(double meanSquaredError) {
    if (meanSquaredError <= 0.0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(255.0 * 255.0 / meanSquaredError);
}

// Channel 0 to 2 of pixel `i`; grey pictures have the same in all.
double channelOf(const Image& image, std::size_t i, int channel) {
    const int stored = image.channels >= 3 ? channel : 0;
    return image.pixels[i * std::size_t(image.channels) + std::size_t(stored)];
}

double meanSquaredError(const Image& a, const Image& b) {
    const std::size_t pixels = std::size_t(a.width) * std::size_t(a.height);
    double sum = 0.0;  // whole numbers below 2^53: exact
    for (std::size_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double difference = channelOf(a, i, c) - channelOf(b, i, c);
            sum += difference * difference;
        }
    }
    return sum / (3.0 * static_cast<double>(pixels));
}

struct Plane {
    int width, height;
    std::vector<double> values;
};

// Rec. 601, as in the SSIM paper's code.
Plane lumaOf(const Image& image) {
    Plane luma{image.width, image.height,
               std::vector<double>(std::size_t(image.width) * std::size_t(image.height))};
    for (std::size_t i = 0; i < luma.values.size(); ++i) {
        luma.values[i] =
            0.299 * channelOf(image, i, 0) + 0.587 * channelOf(image, i, 1) + 0.114 * channelOf(image, i, 2);
    }
    return luma;
}

std::vector<double> gaussian(int radius) {
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) sum += weights.emplace_back(std::exp(-i * i / (2.0 * 1.5 * 1.5)));
    for (double& w : weights) w /= sum;
    return weights;
}

// Only where the window lies inside the plane: smaller by its radius on each side.
Plane blurred(const Plane& plane, const std::vector<double>& weights) {
    const int size = static_cast<int>(weights.size());
    const auto at = [](int x, int y, int width) {
        return std::size_t(y) * std::size_t(width) + std::size_t(x);
    };
    Plane rows{plane.width - size + 1, plane.height, {}};
    rows.values.resize(std::size_t(rows.width) * std::size_t(rows.height));
    for (int y = 0; y < rows.height; ++y) {
        for (int x = 0; x < rows.width; ++x) {
            double sum = 0.0;
            for (int k = 0; k < size; ++k)
                sum += weights[std::size_t(k)] * plane.values[at(x + k, y, plane.width)];
            rows.values[at(x, y, rows.width)] = sum;
        }
    }
    Plane both{rows.width, plane.height - size + 1, {}};
    both.values.resize(std::size_t(both.width) * std::size_t(both.height));
    for (int y = 0; y < both.height; ++y) {
        for (int x = 0; x < both.width; ++x) {
            double sum = 0.0;
            for (int k = 0; k < size; ++k)
                sum += weights[std::size_t(k)] * rows.values[at(x, y + k, rows.width)];
            both.values[at(x, y, both.width)] = sum;
        }
    }
    return both;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result = a;
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

double structuralSimilarity(const Plane& a, const Plane& b) {
    const std::vector<double> weights = gaussian(std::min(5, (std::min(a.width, a.height) - 1) / 2));
    const Plane meanA = blurred(a, weights), meanB = blurred(b, weights);
    const Plane squareA = blurred(product(a, a), weights), squareB = blurred(product(b, b), weights);
    const Plane cross = blurred(product(a, b), weights);
    constexpr double c1 = (0.01 * 255.0) * (0.01 * 255.0), c2 = (0.03 * 255.0) * (0.03 * 255.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < meanA.values.size(); ++i) {
        const double ma = meanA.values[i], mb = meanB.values[i];
        const double varianceA = squareA.values[i] - ma * ma, varianceB = squareB.values[i] - mb * mb;
        const double covariance = cross.values[i] - ma * mb;
        sum += ((2.0 * ma * mb + c1) * (2.0 * covariance + c2)) /
               ((ma * ma + mb * mb + c1) * (varianceA + varianceB + c2));
    }
    return sum / static_cast<double>(meanA.values.size());
}

}  // namespace

Result<ImageError> compareImages(const Image& picture, const Image& reference) {
    if (!isWhole(picture) || !isWhole(reference))
        return failure({}, {}, "a picture to compare has no pixels");
    if (picture.width != reference.width || picture.height != reference.height) {
        return failure({}, {},
                       "pictures of " + sizeText(picture) + " and " + sizeText(reference) +
                           " pixels cannot be compared");
    }
    ImageError error;
    error.meanSquaredError = meanSquaredError(picture, reference);
    error.psnrDb = decibels(error.meanSquaredError);
    error.ssim =
        error.meanSquaredError == 0.0 ? 1.0 : structuralSimilarity(lumaOf(picture), lumaOf(reference));
    return error;
}

ImageErrorSummary summariseImageErrors(std::span<const ImageError> errors) {
    ImageErrorSummary summary;
    if (errors.empty()) return summary;
    double squared = 0.0, ssim = 0.0, worstSquared = 0.0;
    for (const ImageError& error : errors) {
        squared += error.meanSquaredError;
        ssim += error.ssim;
        worstSquared = std::max(worstSquared, error.meanSquaredError);
        summary.worstSsim = std::min(summary.worstSsim, error.ssim);
    }
    const double count = static_cast<double>(errors.size());
    summary.pictures = errors.size();
    summary.psnrDb = decibels(squared / count);
    summary.worstPsnrDb = decibels(worstSquared);
    summary.ssim = ssim / count;
    return summary;
}

}  // namespace fb
