// A grid of side x side copies of a source on the ground, each copy with blocks of its own; all show the same
// textures.
#pragma once

#include <memory>

#include "import/source_scene.h"

namespace fb::bench {

[[nodiscard]] std::unique_ptr<BlockSource> copySource(std::unique_ptr<BlockSource> original,
                                                      std::size_t side);

}  // namespace fb::bench
