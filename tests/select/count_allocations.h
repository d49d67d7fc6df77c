// Counts what goes through operator new in this test program (replaced in count_allocations.cpp).
#pragma once

#include <cstdint>

namespace fb {

[[nodiscard]] std::uint64_t allocationsSoFar();

}  // namespace fb
