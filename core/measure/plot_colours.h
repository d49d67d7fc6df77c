// Colours of plots: the palette of Okabe and Ito (2008), which colour-blind people can tell apart. Levels of
// detail run from warm (coarse) to cool (fine); beyond the seventh the palette comes again, lighter.
#pragma once

#include <array>
#include <cstdint>

namespace fb {

struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

inline constexpr Rgb kVermilion{213, 94, 0}, kOrange{230, 159, 0}, kYellow{240, 228, 66}, kGreen{0, 158, 115},
    kSky{86, 180, 233}, kBlue{0, 114, 178}, kPink{204, 121, 167};
inline constexpr Rgb kInk{34, 34, 34}, kGrey{110, 110, 110}, kGridGrey{224, 224, 224}, kWhite{255, 255, 255};

inline constexpr std::array<Rgb, 7> kLevelPalette = {kVermilion, kOrange, kYellow, kGreen,
                                                     kSky,       kBlue,   kPink};

// `part` of white in the mixture.
[[nodiscard]] constexpr Rgb lightened(Rgb colour, double part) {
    const auto mix = [part](std::uint8_t c) { return static_cast<std::uint8_t>(c + (255 - c) * part + 0.5); };
    return {mix(colour.r), mix(colour.g), mix(colour.b)};
}

[[nodiscard]] constexpr Rgb levelPlotColour(int level) {
    const auto index = static_cast<std::size_t>(level < 0 ? 0 : level);
    const Rgb colour = kLevelPalette[index % kLevelPalette.size()];
    return index < kLevelPalette.size() ? colour : lightened(colour, 0.5);
}

}  // namespace fb
