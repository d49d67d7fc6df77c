// A number with its noun for people: "1 block", "36 blocks".
#pragma once

#include <cstdint>
#include <string>

namespace fb {

[[nodiscard]] inline std::string counted(std::uint64_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace fb
