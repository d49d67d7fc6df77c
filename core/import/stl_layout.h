// The layout of a binary STL file: 80 bytes of anything, a 32-bit count, 50 bytes a triangle.
#pragma once

#include <cstdint>
#include <span>

#include "import/parse_bytes.h"

namespace fb {

inline constexpr std::size_t kStlHeaderBytes = 84;
inline constexpr std::size_t kStlTriangleBytes = 50;

// Whether the count in the header is exactly the one that the size allows. The text 'solid' at the front
// proves nothing: many binary files begin with it.
[[nodiscard]] inline bool isBinaryStl(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kStlHeaderBytes) return false;
    const std::uint64_t triangles = loadNumber<std::uint32_t>(bytes.data() + 80, false);
    return triangles > 0 && kStlHeaderBytes + triangles * kStlTriangleBytes == bytes.size();
}

}  // namespace fb
