// Whether a decoded node may go to the GPU, which checks nothing. In: a node and its number for the message.
// Out: the first thing that does not fit together.
#pragma once

#include "base/ids.h"
#include "scenefile/node_data.h"

namespace fb {

[[nodiscard]] Result<void> checkNode(NodeId node, const DecodedNode& content);

}  // namespace fb
