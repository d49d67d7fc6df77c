// The bytes of a payload: this header, then vertices (meshoptimizer's vertex codec, version 0), indices (its
// index codec, version 1) and the encoded texture, one after another without gaps. All sizes add up to the
// payload's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace fb {

inline constexpr std::string_view kPayloadMagic = "fbnd";
inline constexpr std::uint32_t kPayloadVersion = 2;
inline constexpr std::uint32_t kPayloadHeaderBytes = 52;
inline constexpr std::uint32_t kFlagAlphaMask = 1;

struct PayloadHeader {
    std::uint32_t vertices = 0, texturedTriangles = 0, untexturedTriangles = 0;
    std::uint32_t texturedSkirts = 0, untexturedSkirts = 0;  // of the triangles
    std::uint32_t flags = 0;
    std::uint8_t codec = 0, channels = 0;  // channels 0 without texture
    std::uint16_t textureWidth = 0, textureHeight = 0;
    std::uint32_t vertexBytes = 0, indexBytes = 0, textureBytes = 0;
};

// Every count against its cap and against the `left` bytes that follow the header; nothing is allocated
// before.
[[nodiscard]] Result<void> checkPayloadHeader(const PayloadHeader& header, std::uint64_t left,
                                              const std::string& what);

}  // namespace fb
