#include "build/texture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fb {
namespace {

// Larger parts are cropped and filtered in bands of rows.
constexpr double kTexelsAtOnce = 16e6;

// Along one axis: the whole texels that lie under a part and inside the picture.
struct Extent {
    int begin = 0, end = 1;
};

Extent coveredTexels(double low, double high, int side) {
    const int begin = static_cast<int>(std::clamp(std::floor(low), 0.0, side - 1.0));
    return {begin, static_cast<int>(std::clamp(std::ceil(high), begin + 1.0, static_cast<double>(side)))};
}

void resampleOnce(TextureLevels& texture, const TexelRect& rect, const ResampleTarget& into) {
    const double ratio = std::min(rect.width / into.width, rect.height / into.height);
    int wanted = 0;
    for (double left = ratio; left >= 4.0; left *= 0.5) ++wanted;
    const int level = texture.levelFor(wanted);
    const TiledPicture& picture = texture.levels[static_cast<std::size_t>(level)];
    const double shrink = std::ldexp(1.0, -level);
    // The gutter becomes part of the rectangle, so that bands need none.
    const double across = rect.width * shrink / into.width, down = rect.height * shrink / into.height;
    const TexelRect part{rect.x * shrink - into.gutter * across, rect.y * shrink - into.gutter * down,
                         rect.width * shrink + 2 * into.gutter * across,
                         rect.height * shrink + 2 * into.gutter * down};
    const int width = into.width + 2 * into.gutter, height = into.height + 2 * into.gutter;
    const Extent columns = coveredTexels(part.x, part.x + part.width, picture.width);
    const double rowsAtOnce = kTexelsAtOnce / (columns.end - columns.begin) / down;
    const bool inBands = rowsAtOnce < height;
    const int bandRows = inBands ? std::max(1, static_cast<int>(rowsAtOnce)) : height;
    // What fills the place of missing tiles must not depend on where a band ends.
    const double margin = inBands ? kTileSide : 0.0;
    for (int row = 0; row < height; row += bandRows) {
        const int count = std::min(bandRows, height - row);
        const TexelRect band{part.x, part.y + row * down, part.width, count * down};
        const Extent rows = coveredTexels(band.y - margin, band.y + band.height + margin, picture.height);
        const TexelBox box{columns.begin, rows.begin, columns.end - columns.begin, rows.end - rows.begin};
        resampleArea(cropPicture(picture, box), {band.x - box.x, band.y - box.y, band.width, band.height},
                     EdgeMode::extend,
                     {into.target, into.x - into.gutter, into.y - into.gutter + row, width, count, 0});
    }
}

// The rectangle's extent along one axis of a texture that repeats: all of it, or a part with a margin that may reach
// over the edge.
struct RepeatedExtent {
    int begin = 0, count = 0;
    double start = 0.0;  // of the rectangle, from `begin`

    RepeatedExtent(double low, double length, double margin, int side) {
        count = static_cast<int>(std::min(std::ceil(length + 2 * margin) + 1.0, static_cast<double>(side)));
        const double first = count == side ? 0.0 : std::floor(low - margin);
        begin = static_cast<int>(first < 0.0 ? first + side : first);  // `low` lies in the picture
        start = low - first;
    }
};

Image halved(const Image& finer) {
    Image half{std::max(1, finer.width / 2), std::max(1, finer.height / 2), finer.channels, {}, false};
    half.pixels.resize(static_cast<std::size_t>(half.width) * half.height * half.channels);
    const TexelRect all{0, 0, static_cast<double>(finer.width), static_cast<double>(finer.height)};
    resampleArea(finer, all, EdgeMode::extend, {half, 0, 0, half.width, half.height, 0});
    return half;
}

void resampleRepeated(TextureLevels& texture, const TexelRect& rect, const ResampleTarget& into) {
    // The rectangle could be of any size: the larger ratio counts, to bound the work.
    double ratio = std::max(rect.width / into.width, rect.height / into.height);
    // Levels repeat as the texture does while its sides can be halved.
    int wanted = 0;
    for (; ratio >= 4.0 && (texture.width() | texture.height()) % (2 << wanted) == 0; ratio *= 0.5) ++wanted;
    const int level = texture.levelFor(wanted);
    const TiledPicture& picture = texture.levels[static_cast<std::size_t>(level)];
    const double shrink = std::ldexp(1.0, -level);
    TexelRect part{rect.x * shrink, rect.y * shrink, rect.width * shrink, rect.height * shrink};
    const RepeatedExtent columns(part.x, part.width, (into.gutter + 1) * part.width / into.width, picture.width);
    const RepeatedExtent rows(part.y, part.height, (into.gutter + 1) * part.height / into.height, picture.height);
    Image crop = cropPicture(picture, {columns.begin, rows.begin, columns.count, rows.count});
    for (; ratio >= 4.0 && (crop.width > 1 || crop.height > 1); ratio *= 0.5) crop = halved(crop);
    const double sx = static_cast<double>(crop.width) / columns.count;
    const double sy = static_cast<double>(crop.height) / rows.count;
    part = {columns.start * sx, rows.start * sy, part.width * sx, part.height * sy};
    if (crop.width == 1 && crop.height == 1) {
        part = {0.0, 0.0, static_cast<double>(into.width), static_cast<double>(into.height)};
    }
    resampleArea(crop, part, EdgeMode::repeat, into);
}

const std::uint8_t* texelOrNearest(const TiledPicture& picture, int x, int y) {
    if (picture.tileAt(x / kTileSide, y / kTileSide) != kNoTile) return picture.texel(x, y);
    const glm::ivec2 near = nearestTexel(picture, x, y);
    return picture.texel(near.x, near.y);
}

}  // namespace

int TextureLevels::levelFor(int level) {
    while (static_cast<int>(levels.size()) <= level &&
           (levels.back().width > 1 || levels.back().height > 1)) {
        levels.push_back(halvedPicture(levels.back()));
    }
    return std::min(level, static_cast<int>(levels.size()) - 1);
}

void resampleTexture(TextureLevels& texture, const TexelRect& rect, EdgeMode edge, const ResampleTarget& into) {
    if (edge == EdgeMode::repeat) {
        resampleRepeated(texture, rect, into);
    } else {
        resampleOnce(texture, rect, into);
    }
}

TextureSampler::TextureSampler(TextureLevels& texture, float footprint) : texture_(&texture) {
    int wanted = 0;
    for (; footprint >= 2.0f && wanted < 16; footprint *= 0.5f) ++wanted;
    const int level = texture.levelFor(wanted);
    level_ = static_cast<std::size_t>(level);
    size_ = {std::ldexp(static_cast<float>(texture.width()), -level),
             std::ldexp(static_cast<float>(texture.height()), -level)};
}

glm::vec4 TextureSampler::at(const glm::vec2& uv) const {
    const TiledPicture& picture = texture_->levels[level_];
    const glm::vec2 inTile = uv - glm::floor(uv);
    // Within one repeat: the opposite edge of the picture must not bleed in.
    const float x = std::clamp(inTile.x * size_.x - 0.5f, 0.0f, static_cast<float>(picture.width - 1));
    const float y = std::clamp(inTile.y * size_.y - 0.5f, 0.0f, static_cast<float>(picture.height - 1));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    std::array<const std::uint8_t*, 4> corners;
    const bool oneTile = x0 / kTileSide == x1 / kTileSide && y0 / kTileSide == y1 / kTileSide;
    if (oneTile && picture.tileAt(x0 / kTileSide, y0 / kTileSide) != kNoTile) {
        const std::uint8_t* const first = picture.texel(x0, y0);
        const std::ptrdiff_t right = (x1 - x0) * picture.channels;
        const std::ptrdiff_t below = (y1 - y0) * kTileSide * picture.channels;
        corners = {first, first + right, first + below, first + below + right};
    } else {
        corners = {texelOrNearest(picture, x0, y0), texelOrNearest(picture, x1, y0),
                   texelOrNearest(picture, x0, y1), texelOrNearest(picture, x1, y1)};
    }
    glm::vec4 result(0, 0, 0, 255);
    for (int c = 0; c < picture.channels; ++c) {
        const float top = static_cast<float>(corners[0][c]) * (1 - fx) + static_cast<float>(corners[1][c]) * fx;
        const float bottom = static_cast<float>(corners[2][c]) * (1 - fx) + static_cast<float>(corners[3][c]) * fx;
        result[c] = top * (1 - fy) + bottom * fy;
    }
    return result;
}

}  // namespace fb
