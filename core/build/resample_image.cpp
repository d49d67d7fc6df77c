#include "build/resample_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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

// Filters one target row after the other: first down, over all source columns that its texels take from, then across.
class RowFilter {
  public:
    RowFilter(const Image& source, const TexelTaps& columns) : source_(source), columns_(columns) {
        int last = 0;
        first_ = source.width;
        for (const TexelTap& tap : columns.taps) {
            first_ = std::min(first_, tap.source);
            last = std::max(last, tap.source);
        }
        sums_.resize(static_cast<std::size_t>(last - first_ + 1) * static_cast<std::size_t>(source.channels));
    }

    // The mean of the source rows under a target row.
    std::span<const float> mean(std::span<const TexelTap> rows) {
        std::fill(sums_.begin(), sums_.end(), 0.0f);
        for (const TexelTap& row : rows) {
            const std::uint8_t* const line =
                source_.pixels.data() +
                (static_cast<std::size_t>(row.source) * static_cast<std::size_t>(source_.width) +
                 static_cast<std::size_t>(first_)) *
                    static_cast<std::size_t>(source_.channels);
            for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += row.weight * static_cast<float>(line[i]);
        }
        return sums_;
    }

    void write(std::span<const float> row, Image& target, int x, int y) const {
        const auto targetChannels = static_cast<std::size_t>(target.channels);
        const auto sourceChannels = static_cast<std::size_t>(source_.channels);
        const std::size_t channels = std::min(targetChannels, sourceChannels);
        std::uint8_t* to =
            target.pixels.data() +
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x)) *
                targetChannels;
        for (std::size_t i = 0; i + 1 < columns_.begin.size(); ++i, to += targetChannels) {
            std::array<float, 4> sum;
            sum.fill(0.5f);  // rounds
            for (std::uint32_t k = columns_.begin[i]; k < columns_.begin[i + 1]; ++k) {
                const TexelTap& tap = columns_.taps[k];
                const float* const texel = row.data() + static_cast<std::size_t>(tap.source - first_) * sourceChannels;
                for (std::size_t c = 0; c < channels; ++c) sum[c] += tap.weight * texel[c];
            }
            for (std::size_t c = 0; c < channels; ++c) {
                to[c] = static_cast<std::uint8_t>(std::clamp(sum[c], 0.0f, 255.0f));
            }
        }
    }

  private:
    const Image& source_;
    const TexelTaps& columns_;
    int first_ = 0;
    std::vector<float> sums_;  // by column from first_
};

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
    RowFilter filter(source, columns);
    for (int j = clip.y; j < clip.w; ++j) {
        const auto row = static_cast<std::size_t>(j - clip.y);
        const std::span<const TexelTap> taps(rows.taps.data() + rows.begin[row], rows.begin[row + 1] - rows.begin[row]);
        filter.write(filter.mean(taps), into.target, into.x + clip.x, into.y + j);
    }
}

}  // namespace fb
