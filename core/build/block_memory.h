// How much memory building a block will take at most, before it is built. Goes to make_blocks, which lets as
// many blocks in as the limit allows.
#pragma once

#include <cstdint>

#include "import/texture_store.h"

namespace fb {

// Measured as the peak memory of a process that builds one block, less kProgramBytes, over the block's counts (scans and
// the city gave 220 to 300 bytes a triangle, 4 to 6 a texel shown), rounded up.
inline constexpr std::uint64_t kBytesPerTriangle = 400, kBytesPerTexel = 8;
// The program and its libraries.
inline constexpr std::uint64_t kProgramBytes = 140'000'000;

// From its triangles and the texels that they show; repeats of a picture count once.
[[nodiscard]] std::uint64_t estimateBlockBytes(const SourceBlock& block, TextureStore& store);

}  // namespace fb
