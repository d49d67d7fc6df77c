// Fills the texels of a picture that nothing shows from those around them, so that no background bleeds into coarser
// levels: first known texels grow by a few rings, across tiles, each texel copied from a neighbour; what lies farther
// away takes the mean of the smallest square around it that has a known texel (as the pull-push of Gortler et al. 1996,
// The Lumigraph, does), which is smooth and cheap to encode.
// Comes from block_textures, tiled_picture and make_atlas.
#pragma once

#include <span>

#include "build/tiled_picture.h"

namespace fb {

// More than gutters and filters reach at full sharpness.
inline constexpr int kCopiedRings = 8;

// `known`: one mask a tile that there is. All other texels are filled in channels [firstChannel, endChannel). Without
// any known texel nothing changes. The masks serve as scratch.
void spreadTexels(TiledPicture& picture, std::span<TileMask> known, int firstChannel, int endChannel);

// The same for a whole picture; `known` has a 0 or 1 for each of its texels.
void fillUnknown(Image& image, const std::vector<std::uint8_t>& known, int firstChannel, int endChannel);

}  // namespace fb
