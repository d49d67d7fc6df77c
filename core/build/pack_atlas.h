// Places charts in an atlas whose sides are of the classes of atlasSide(), width and height on their own.
// Comes from make_charts and bake_charts, goes to fill_atlas. Skyline packing (Jylänki 2010) by
// stb_rect_pack.
#pragma once

#include <span>

#include "build/make_charts.h"

namespace fb {

struct AtlasSize {
    int width = 0, height = 0;
};

// The smallest atlas found that holds all charts with kGutter texels around each; at the atlas's own edge the
// gutter is left out, since sampling clamps there. Sets x and y of the charts. False: no atlas up to
// `maxSide` does.
[[nodiscard]] bool packAtlas(std::span<Chart> charts, int maxSide, AtlasSize& size);

}  // namespace fb
