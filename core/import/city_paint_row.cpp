// The basic strokes: runs of colour, masonry, letters, light.
#include <algorithm>
#include <cmath>

#include "import/city_paint.h"

namespace fb::city {
namespace {

std::uint8_t toByte(float value) {
    const int v = static_cast<int>(value);
    return static_cast<std::uint8_t>(v < 0 ? 0 : v > 255 ? 255 : v);
}

// Letters that words on signs need; one octal digit a row from the top, its bits from the left.
constexpr int letterRows(char letter) {
    switch (letter) {
        case 'A':
            return 025755;
        case 'B':
            return 065656;
        case 'C':
            return 034443;
        case 'D':
            return 065556;
        case 'E':
            return 074647;
        case 'F':
            return 074644;
        case 'G':
            return 034553;
        case 'H':
            return 055755;
        case 'I':
            return 072227;
        case 'K':
            return 055655;
        case 'L':
            return 044447;
        case 'O':
            return 025552;
        case 'P':
            return 065644;
        case 'R':
            return 065655;
        case 'S':
            return 034216;
        case 'T':
            return 072222;
        case 'V':
            return 055552;
        case 'Y':
            return 055222;
        case 'Z':
            return 071247;
        default:
            return 0;
    }
}

constexpr double kLetterPitch = 4.0;  // cells from letter to letter

}  // namespace

Run PaintRow::between(double low, double high) const {
    const auto first = [&](double place) {
        return static_cast<int>(std::lower_bound(places.begin(), places.end(), static_cast<float>(place)) -
                                places.begin());
    };
    return {first(low), first(high)};
}

void PaintRow::put(int column, const Colour& colour, float s) const {
    std::uint8_t* p = pixels + 3 * column;
    p[0] = toByte(colour.r * s);
    p[1] = toByte(colour.g * s);
    p[2] = toByte(colour.b * s);
}

void PaintRow::fill(const Run& run, const Colour& colour) const {
    for (int i = run.begin; i < run.end; ++i) put(i, colour, shade[i]);
}

void PaintRow::fillPlain(const Run& run, const Colour& colour) const {
    for (int i = run.begin; i < run.end; ++i) put(i, colour, 1.0f);
}

void PaintRow::blend(const Run& run, const Colour& colour, float share) const {
    for (int i = run.begin; i < run.end; ++i) {
        const std::uint8_t* p = pixels + 3 * i;
        const Colour under{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
        put(i, under.mixed(colour.scaled(shade[i]), share), 1.0f);
    }
}

void PaintRow::multiply(int column, float factor) const {
    const std::uint8_t* p = pixels + 3 * column;
    put(column, {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}, factor);
}

void PaintRow::darken(const Run& run, float factor) const {
    const int f = static_cast<int>(factor * 256.0f);
    for (int i = 3 * run.begin; i < 3 * run.end; ++i) {
        pixels[i] = static_cast<std::uint8_t>(std::min(255, (pixels[i] * f) >> 8));
    }
}

float jointCoverAt(double at, double period, double width, double texel) {
    const double k = std::floor(at / period + 0.5);
    const double distance = std::abs(at - k * period);
    const double covered =
        std::min(distance + texel / 2.0, width / 2.0) - std::max(distance - texel / 2.0, -width / 2.0);
    return static_cast<float>(std::clamp(covered / texel, 0.0, 1.0));
}

Masonry::Masonry(const MasonryFormat& format, std::span<const float> columns, double texel,
                 std::uint32_t seed)
    : format_(format),
      texel_(texel),
      strength_(static_cast<float>(std::clamp(2.6 - 3.6 * texel / format.course, 0.0, 1.0))),
      seed_(seed) {
    for (int parity = 0; parity < 2; ++parity) {
        Bond& bond = bonds_[parity];
        const double shift = parity == 1 && format.staggered ? format.unitLength / 2.0 : 0.0;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double at = columns[i] + shift;
            const auto number = static_cast<std::int32_t>(std::floor(at / format.unitLength));
            if (bond.unitNumber.empty() || bond.unitNumber.back() != number) {
                if (!bond.unitNumber.empty()) bond.unitEnd.push_back(static_cast<int>(i));
                bond.unitNumber.push_back(number);
            }
            bond.unitOfColumn.push_back(static_cast<int>(bond.unitNumber.size()) - 1);
            bond.jointCover.push_back(jointCoverAt(at, format.unitLength, format.joint, texel) * strength_);
        }
        bond.unitEnd.push_back(static_cast<int>(columns.size()));
    }
}

void Masonry::paint(const PaintRow& row, const Run& run, const Colour& colour, const Colour& joint) const {
    if (run.empty()) return;
    const auto course = static_cast<std::int32_t>(std::floor(row.at / format_.course));
    const Bond& bond = bonds_[course & 1];
    const float rowCover = jointCoverAt(row.at, format_.course, format_.joint, texel_) * strength_;
    if (rowCover > 0.98f) {
        row.fill(run, joint);
        return;
    }
    const Colour toJoint{joint.r - colour.r, joint.g - colour.g, joint.b - colour.b};
    int unitIndex = bond.unitOfColumn[run.begin];
    for (int i = run.begin; i < run.end; ++unitIndex) {
        const int end = std::min(run.end, bond.unitEnd[unitIndex]);
        const std::uint32_t hash = latticeHash(seed_, bond.unitNumber[unitIndex], course);
        const float tone = 1.0f + format_.toneSpread * (0.4f + 0.6f * strength_) * signedUnit(hash);
        // Some units are of another clay or were replaced.
        const float odd = (hash & 0xff) < 6 ? 1.0f - 2.0f * format_.toneSpread : 1.0f;
        const Colour unitColour{colour.r * tone * odd, colour.g * tone * odd, colour.b * tone * odd};
        for (; i < end; ++i) {
            const float cover = std::max(rowCover, bond.jointCover[i]);
            const float s = row.shade[i];
            std::uint8_t* p = row.pixels + 3 * i;
            p[0] = toByte((unitColour.r + toJoint.r * cover) * s);
            p[1] = toByte((unitColour.g + toJoint.g * cover) * s);
            p[2] = toByte((unitColour.b + toJoint.b * cover) * s);
        }
    }
}

double textWidth(std::string_view text, double cell) {
    return (static_cast<double>(text.size()) * kLetterPitch - 1.0) * cell;
}

std::string_view signText(std::uint32_t look) {
    constexpr std::array<std::string_view, 24> kWords{
        "CAFE",    "BOOKS", "SHOES", "HOTEL",   "TEA",    "PIZZA",   "DELI",  "BAKERY",
        "GALLERY", "KEYS",  "TOYS",  "COPY",    "CYCLES", "RECORDS", "FISH",  "FLORIST",
        "BAR",     "GRILL", "SALE",  "CLOTHES", "TRAVEL", "DRAPERY", "SILKS", "CHEESE"};
    return kWords[look % kWords.size()];
}

void paintText(const PaintRow& row, std::string_view text, double left, double top, double cell,
               const Colour& colour, float share) {
    const double below = (top - row.at) / cell;
    if (below < 0.0 || below >= 5.0) return;
    const int line = static_cast<int>(below);
    for (std::size_t k = 0; k < text.size(); ++k) {
        const int bits = (letterRows(text[k]) >> (3 * (4 - line))) & 7;
        for (int c = 0; c < 3; ++c) {
            if ((bits & (4 >> c)) == 0) continue;
            const double x = left + (static_cast<double>(k) * kLetterPitch + c) * cell;
            row.blend(row.between(x, x + cell), colour, share);
        }
    }
}

void developRow(std::span<const LightColumn> light, std::uint32_t grainSeed, std::uint8_t* pixels) {
    std::uint32_t grain = mixBits(grainSeed) | 1u;
    for (const LightColumn& l : light) {
        grain = grain * 0x915f77f5u + 0x6d2b79f5u;
        const int noise = static_cast<int>(grain >> 29) - 4;  // -4 to 3
        const int r = ((pixels[0] * l.r) >> 8) + noise, g = ((pixels[1] * l.g) >> 8) + noise;
        const int b = ((pixels[2] * l.b) >> 8) + noise;
        pixels[0] = static_cast<std::uint8_t>(r < 0 ? 0 : r > 255 ? 255 : r);
        pixels[1] = static_cast<std::uint8_t>(g < 0 ? 0 : g > 255 ? 255 : g);
        pixels[2] = static_cast<std::uint8_t>(b < 0 ? 0 : b > 255 ? 255 : b);
        pixels += 3;
    }
}

}  // namespace fb::city
