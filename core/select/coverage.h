// How much of the picture boxes may cover: what filling it takes does not depend on how fine they are drawn.
#pragma once

#include <span>

#include "scenefile/hierarchy.h"
#include "select/view.h"

namespace fb {

// Megapixels of the picture in front of the boxes' rectangles, in cells of 1/64 of its width and 1/36 of its height.
// A box that reaches behind the near plane counts as the whole picture, one out of view as nothing.
[[nodiscard]] double coveredMegapixels(const Hierarchy& hierarchy, std::span<const NodeId> nodes, const View& view);
[[nodiscard]] double megapixelsOfRoots(const Hierarchy& hierarchy, const View& view);

}  // namespace fb
