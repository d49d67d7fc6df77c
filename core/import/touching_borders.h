// Finds where the surface of a block ends on that of another without a vertex in common. Scans come in chunks that were
// cut and triangulated apart: their borders lie on each other, or overlap by a little, and part at coarse levels unless
// the builder knows of them. Comes after markSharedVertices; goes to the builder's skirts.
#pragma once

#include <span>

#include "import/source_scene.h"

namespace fb {

// A border this near to another block's surface touches it, in lengths of its own block's diagonal: far less than a
// triangle, more than coordinates are rounded by.
inline constexpr double kTouching = 5e-5;

// Sets `shared` of the vertices at the surfaces' own borders that touch another block's surface. The blocks' `shared` is
// set for what they have in common.
void markTouchingBorders(std::span<SourceBlock> blocks);

}  // namespace fb
