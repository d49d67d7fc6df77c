#include "scenefile/mip_levels.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/check.h"
#include "scenefile/node_data.h"

namespace fb {
namespace {

constexpr std::uint32_t kOpaqueFrom = 128;  // alpha >= 0.5: the shader keeps the texel

struct Level {
    std::uint8_t* texels;
    std::uint32_t width, height;

    [[nodiscard]] std::uint8_t* at(std::uint32_t x, std::uint32_t y) const {
        return texels + (std::size_t{y} * width + x) * 4;
    }
};

std::uint32_t load(const std::uint8_t* texel) {
    std::uint32_t value;
    std::memcpy(&value, texel, 4);
    return value;
}

// The rounded mean of four texels, two channels in each half of a word.
std::uint32_t meanOfFour(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    constexpr std::uint32_t kMask = 0x00ff00ff;
    constexpr std::uint32_t kHalf = 0x00020002;
    const std::uint32_t even = (a & kMask) + (b & kMask) + (c & kMask) + (d & kMask) + kHalf;
    const std::uint32_t odd =
        (a >> 8 & kMask) + (b >> 8 & kMask) + (c >> 8 & kMask) + (d >> 8 & kMask) + kHalf;
    return (even >> 2 & kMask) | (odd >> 2 & kMask) << 8;
}

// The texels of the finer level that one texel covers along one axis, and how much of each (as whole numbers
// with the sum `total`). A side of 2m + 1 becomes m: each texel covers 2 + 1/m texels, three with weights m -
// i, m, i + 1.
struct Taps {
    std::uint32_t first, count, total;
    std::array<std::uint32_t, 3> weights;
};

Taps tapsAt(std::uint32_t i, std::uint32_t side) {
    if (side == 1) return {0, 1, 1, {1, 0, 0}};
    if (side % 2 == 0) return {2 * i, 2, 2, {1, 1, 0}};
    const std::uint32_t half = side / 2;
    return {2 * i, 3, side, {half - i, half, i + 1}};
}

// Sums over the covered texels: plain, and weighted by alpha.
struct Sums {
    std::uint64_t weight = 0, alpha = 0;
    std::array<std::uint64_t, 3> colour{}, colourAlpha{};

    void add(const std::uint8_t* texel, std::uint64_t w) {
        weight += w;
        alpha += w * texel[3];
        for (std::size_t c = 0; c < 3; ++c) {
            colour[c] += w * texel[c];
            colourAlpha[c] += w * texel[3] * texel[c];
        }
    }
    void store(std::uint8_t* into) const {
        const bool hole = alpha == 0;  // nothing to weight by: the colour under the hole
        const std::uint64_t divisor = hole ? weight : alpha;
        for (std::size_t c = 0; c < 3; ++c) {
            into[c] =
                static_cast<std::uint8_t>(((hole ? colour[c] : colourAlpha[c]) + divisor / 2) / divisor);
        }
        into[3] = static_cast<std::uint8_t>((alpha + weight / 2) / weight);
    }
};

void halveOddSides(const Level& from, const Level& to) {
    for (std::uint32_t y = 0; y < to.height; ++y) {
        const Taps rows = tapsAt(y, from.height);
        for (std::uint32_t x = 0; x < to.width; ++x) {
            const Taps columns = tapsAt(x, from.width);
            Sums sums;
            for (std::uint32_t j = 0; j < rows.count; ++j) {
                for (std::uint32_t i = 0; i < columns.count; ++i) {
                    sums.add(from.at(columns.first + i, rows.first + j),
                             std::uint64_t{rows.weights[j]} * columns.weights[i]);
                }
            }
            sums.store(to.at(x, y));
        }
    }
}

void halveEvenSides(const Level& from, const Level& to, bool opaque) {
    constexpr std::uint32_t kFullAlpha = 0xff000000;
    for (std::uint32_t y = 0; y < to.height; ++y) {
        const std::uint8_t* upper = from.at(0, 2 * y);
        const std::uint8_t* lower = from.at(0, 2 * y + 1);
        std::uint8_t* out = to.at(0, y);
        for (std::uint32_t x = 0; x < to.width; ++x, upper += 8, lower += 8, out += 4) {
            const std::uint32_t a = load(upper), b = load(upper + 4), c = load(lower), d = load(lower + 4);
            if (opaque || (a & b & c & d) >= kFullAlpha) {
                const std::uint32_t mean = meanOfFour(a, b, c, d);
                std::memcpy(out, &mean, 4);
                continue;
            }
            Sums sums;
            for (const std::uint8_t* texel : {upper, upper + 4, lower, lower + 4}) sums.add(texel, 1);
            sums.store(out);
        }
    }
}

std::array<std::uint64_t, 256> alphaHistogram(const Level& level) {
    std::array<std::uint64_t, 256> histogram{};
    const std::size_t texels = std::size_t{level.width} * level.height;
    for (std::size_t i = 0; i < texels; ++i) ++histogram[level.texels[i * 4 + 3]];
    return histogram;
}

// Of all thresholds the one that lets the share `keep / of` of the level's texels pass, or comes nearest to
// it; of equals the one nearest to the shader's own.
std::uint32_t thresholdFor(const Level& level, std::uint64_t keep, std::uint64_t of) {
    const std::array<std::uint64_t, 256> histogram = alphaHistogram(level);
    const std::uint64_t wanted = keep * level.width * level.height;  // times `of`, as is `passing` below
    std::uint32_t best = kOpaqueFrom;
    std::uint64_t bestMiss = ~std::uint64_t{0};
    std::uint64_t passing = 0;
    for (std::uint32_t threshold = 256; threshold >= 1; --threshold) {
        if (threshold < 256) passing += histogram[threshold] * of;
        const std::uint64_t miss = passing > wanted ? passing - wanted : wanted - passing;
        const auto away = [](std::uint32_t t) { return t > kOpaqueFrom ? t - kOpaqueFrom : kOpaqueFrom - t; };
        if (miss < bestMiss || (miss == bestMiss && away(threshold) < away(best))) {
            best = threshold;
            bestMiss = miss;
        }
    }
    return best;
}

// Scales alpha so that exactly the texels with alpha >= threshold reach the shader's threshold:
// rounding t * 128 / t gives 128, and (t - 1) * 128 / t at most 127, for every t in [1, 256] (halves go
// down).
void scaleAlpha(const Level& level, std::uint32_t threshold) {
    std::array<std::uint8_t, 256> scaled{};
    for (std::uint32_t a = 0; a < 256; ++a) {
        scaled[a] =
            static_cast<std::uint8_t>(std::min(255u, (a * kOpaqueFrom + (threshold - 1) / 2) / threshold));
    }
    const std::size_t texels = std::size_t{level.width} * level.height;
    for (std::size_t i = 0; i < texels; ++i) level.texels[i * 4 + 3] = scaled[level.texels[i * 4 + 3]];
}

std::uint64_t opaqueTexels(const Level& level) {
    const std::array<std::uint64_t, 256> histogram = alphaHistogram(level);
    std::uint64_t count = 0;
    for (std::uint32_t a = kOpaqueFrom; a < 256; ++a) count += histogram[a];
    return count;
}

}  // namespace

void buildMipLevels(std::span<std::uint8_t> texels, std::uint32_t width, std::uint32_t height,
                    MipAlpha alpha) {
    FB_CHECK(texels.size() == mippedBytes(width, height));
    const std::uint32_t levels = mipLevelCount(width, height);
    const auto nextOf = [](const Level& level) {
        return Level{level.at(0, level.height), std::max(1u, level.width / 2),
                     std::max(1u, level.height / 2)};
    };
    const Level finest{texels.data(), width, height};
    Level from = finest;
    for (std::uint32_t i = 1; i < levels; ++i) {
        const Level to = nextOf(from);
        if (from.width % 2 == 0 && from.height % 2 == 0)
            halveEvenSides(from, to, alpha == MipAlpha::opaque);
        else
            halveOddSides(from, to);
        from = to;
    }
    if (alpha != MipAlpha::mask) return;
    // Only now, so that every level is a mean of true alphas, not of scaled ones.
    const std::uint64_t opaque = opaqueTexels(finest);
    Level level = finest;
    for (std::uint32_t i = 1; i < levels; ++i) {
        level = nextOf(level);
        scaleAlpha(level, thresholdFor(level, opaque, std::uint64_t{width} * height));
    }
}

}  // namespace fb
