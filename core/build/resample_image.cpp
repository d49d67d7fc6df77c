#include "build/resample_image.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

struct TexelTap {
    int source;
    float weight;
};

// The source texels under each of `count` target texels along one axis, weights adding to 1.
struct TexelTaps {
    std::vector<TexelTap> taps;
    std::vector<std::uint32_t> begin;  // count + 1
};

int wrapped(std::int64_t at, int size, EdgeMode edge) {
    if (edge == EdgeMode::extend) return static_cast<int>(std::clamp<std::int64_t>(at, 0, size - 1));
    const std::int64_t rest = at % size;
    return static_cast<int>(rest < 0 ? rest + size : rest);
}

TexelTaps makeTaps(double start, double perTexel, int first, int end, int size, EdgeMode edge) {
    TexelTaps result;
    result.begin.push_back(0);
    for (int i = first; i < end; ++i) {
        const double a = start + perTexel * i;
        const double b = a + perTexel;
        for (auto at = static_cast<std::int64_t>(std::floor(a)); static_cast<double>(at) < b; ++at) {
            const double left = static_cast<double>(at);
            const double overlap = std::min(b, left + 1.0) - std::max(a, left);
            if (overlap < 1e-6 * perTexel) continue;
            result.taps.push_back({wrapped(at, size, edge), static_cast<float>(overlap / perTexel)});
        }
        result.begin.push_back(static_cast<std::uint32_t>(result.taps.size()));
    }
    return result;
}

bool isWholeTexel(double value) {
    return value == std::floor(value);
}

void copyTexels(const Image& source, const TexelRect& rect, EdgeMode edge, const ResampleTarget& into,
                glm::ivec4 clip) {
    const auto targetChannels = static_cast<std::size_t>(into.target.channels);
    const auto sourceChannels = static_cast<std::size_t>(source.channels);
    const std::size_t channels = std::min(targetChannels, sourceChannels);
    std::vector<std::size_t> columns;
    for (int i = clip.x; i < clip.z; ++i) {
        columns.push_back(
            static_cast<std::size_t>(wrapped(static_cast<std::int64_t>(rect.x) + i, source.width, edge)) *
            sourceChannels);
    }
    for (int j = clip.y; j < clip.w; ++j) {
        const int row = wrapped(static_cast<std::int64_t>(rect.y) + j, source.height, edge);
        const std::uint8_t* from =
            source.pixels.data() + static_cast<std::size_t>(row) * source.width * sourceChannels;
        std::uint8_t* to =
            into.target.pixels.data() +
            (static_cast<std::size_t>(into.y + j) * into.target.width + (into.x + clip.x)) * targetChannels;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) to[i * targetChannels + c] = from[columns[i] + c];
        }
    }
}

}  // namespace

void resampleArea(const Image& source, const TexelRect& rect, EdgeMode edge, const ResampleTarget& into) {
    // Target texels relative to the rectangle's corner that lie inside the target picture.
    const glm::ivec4 clip(std::max(-into.gutter, -into.x), std::max(-into.gutter, -into.y),
                          std::min(into.width + into.gutter, into.target.width - into.x),
                          std::min(into.height + into.gutter, into.target.height - into.y));
    if (clip.x >= clip.z || clip.y >= clip.w) return;
    if (rect.width == into.width && rect.height == into.height && isWholeTexel(rect.x) &&
        isWholeTexel(rect.y)) {
        copyTexels(source, rect, edge, into, clip);
        return;
    }
    const TexelTaps columns = makeTaps(rect.x, rect.width / into.width, clip.x, clip.z, source.width, edge);
    const TexelTaps rows = makeTaps(rect.y, rect.height / into.height, clip.y, clip.w, source.height, edge);
    const auto targetChannels = static_cast<std::size_t>(into.target.channels);
    const auto sourceChannels = static_cast<std::size_t>(source.channels);
    const std::size_t channels = std::min(targetChannels, sourceChannels);
    const auto count = static_cast<std::size_t>(clip.z - clip.x);
    std::vector<float> sums(count * channels);
    for (int j = clip.y; j < clip.w; ++j) {
        std::fill(sums.begin(), sums.end(), 0.5f);  // rounds
        const auto row = static_cast<std::size_t>(j - clip.y);
        for (std::uint32_t r = rows.begin[row]; r < rows.begin[row + 1]; ++r) {
            const std::uint8_t* line = source.pixels.data() + static_cast<std::size_t>(rows.taps[r].source) *
                                                                  source.width * sourceChannels;
            for (std::size_t i = 0; i < count; ++i) {
                for (std::uint32_t k = columns.begin[i]; k < columns.begin[i + 1]; ++k) {
                    const std::uint8_t* texel =
                        line + static_cast<std::size_t>(columns.taps[k].source) * sourceChannels;
                    const float weight = rows.taps[r].weight * columns.taps[k].weight;
                    for (std::size_t c = 0; c < channels; ++c) {
                        sums[i * channels + c] += weight * static_cast<float>(texel[c]);
                    }
                }
            }
        }
        std::uint8_t* to =
            into.target.pixels.data() +
            (static_cast<std::size_t>(into.y + j) * into.target.width + (into.x + clip.x)) * targetChannels;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                const float sum = std::clamp(sums[i * channels + c], 0.0f, 255.0f);
                to[i * targetChannels + c] = static_cast<std::uint8_t>(sum);
            }
        }
    }
}

}  // namespace fb
