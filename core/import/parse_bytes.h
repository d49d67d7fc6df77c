// Numbers in binary files, of either byte order and any alignment.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace fb {

template <class T>
[[nodiscard]] T loadNumber(const std::uint8_t* bytes, bool bigEndian) {
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, bytes, sizeof(T));
    if (bigEndian == (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
}

}  // namespace fb
