// The encoded atlas of a node -> RGBA8, through OpenImageIO from memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scenefile/node_data.h"

namespace fb {

// `into` takes width * height RGBA8 texels. Width, height and channels of the encoded image must be those of
// `texture`; they are compared before any pixel is read. One channel is grey, two are grey and alpha.
[[nodiscard]] Result<void> decodeTexture(const NodeTexture& texture, std::span<std::uint8_t> into,
                                         const std::string& what);

}  // namespace fb
