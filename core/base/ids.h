// Ids are indices: NodeId indexes the arrays of Hierarchy (scenefile/hierarchy.h).
#pragma once

#include <cstdint>

namespace fb {

using NodeId = std::uint32_t;
inline constexpr NodeId kNoNode = ~NodeId{0};

}  // namespace fb
