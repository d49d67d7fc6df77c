// Mip levels on the processor, off the main thread: on a software rasteriser generating them on upload takes
// longer than the upload. RGBA8, levels one after another, each max(1, side >> level), level 0 first. A texel
// of a level is the mean of the texels below it in the level before, computed in sRGB as stored: the error
// against linear light is a slight darkening of high contrasts, far below that of the simplified mesh, and
// whole numbers give the same bytes on every machine. Odd sides are halved with weights that add up to the
// exact area mean.
#pragma once

#include <cstdint>
#include <span>

namespace fb {

enum class MipAlpha : std::uint8_t {
    opaque,    // alpha is 255 everywhere
    weighted,  // colours are weighted by alpha: what is transparent does not bleed into what is not
    mask  // as weighted, and the share of texels with alpha >= 0.5 is kept (Castano 2010), so that leaves
          // and fences do not thin out with distance
};

// Fills levels 1 and up; `texels` has mippedBytes(width, height) bytes with level 0 in place.
void buildMipLevels(std::span<std::uint8_t> texels, std::uint32_t width, std::uint32_t height,
                    MipAlpha alpha);

}  // namespace fb
