// Area filtering of texture rectangles. Comes from texture_levels; works in sRGB bytes, as the mip levels of
// decodeNode do, so that a level of the hierarchy and a mip level of the one below look alike.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "import/source_scene.h"

namespace fb {

// A rectangle of texels of a texture; it may reach beyond the picture, where the texture repeats or its edge
// extends.
struct TexelRect {
    double x = 0, y = 0, width = 0, height = 0;
};

enum class EdgeMode : std::uint8_t { extend, repeat };

// Where the result goes: a rectangle of `target`, surrounded by `gutter` texels that show what lies around
// the source rectangle. What falls outside `target` is left out, and so are channels that only one of the two
// pictures has.
struct ResampleTarget {
    Image& target;
    int x = 0, y = 0, width = 0, height = 0;
    int gutter = 0;
};

// Every target texel becomes the mean of the part of the source that it covers; an exact copy where the sizes
// are equal and the rectangle lies on whole texels.
void resampleArea(const Image& source, const TexelRect& rect, EdgeMode edge, const ResampleTarget& into);

}  // namespace fb
