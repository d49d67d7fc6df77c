// Refuses blocks that would not survive building: before anything else looks at them.
// Comes from a BlockSource; goes to block_textures and quantise_block, which rely on it.
#pragma once

#include "base/result.h"
#include "import/source_scene.h"

namespace fb {

// Errors: counts of the block's arrays do not agree, indices out of range, positions not finite or beyond
// 5e11 m, more than 2^29 triangles.
[[nodiscard]] Result<void> checkBlock(const SourceBlock& block);

}  // namespace fb
