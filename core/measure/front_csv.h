// The front of one frame, node by node, with the reason why each is not finer: front.csv of a replay's last frame, and what a
// table of the workbench shows.
#pragma once

#include <span>
#include <string>

#include "select/select.h"

namespace fb {

// node,level,block,reason,need_ms,had_ms,missing_nodes,missing_bytes,err_px,triangles,texture_bytes. need_ms: what refining the node
// would take as the policy counts it, had_ms: the time there was for that; both empty where nobody asked. Missing: children
// that are not in memory and what they take there.
[[nodiscard]] std::string frontCsv(const Hierarchy& hierarchy, std::span<const Reached> reached,
                                   std::span<const std::uint8_t> loaded, const View& view);

}  // namespace fb
