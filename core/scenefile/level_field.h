// A node's level and what else fits into its 32 bits, as packs and hierarchy.bin have it.
#pragma once

#include <cstdint>

#include "scenefile/limits.h"

namespace fb {

inline constexpr std::uint32_t kStuckBit = 1u << 8;

[[nodiscard]] constexpr std::uint32_t packLevel(std::uint8_t level, bool stuck) {
    return level | (stuck ? kStuckBit : 0u);
}

// False when the level cannot be, or a bit is set that means nothing; then the level is 0.
[[nodiscard]] constexpr bool unpackLevel(std::uint32_t field, std::uint8_t& level, bool& stuck) {
    stuck = (field & kStuckBit) != 0;
    const std::uint32_t rest = field & ~kStuckBit;
    level = static_cast<std::uint8_t>(rest <= kMaxLevel ? rest : 0);
    return rest <= kMaxLevel;
}

}  // namespace fb
