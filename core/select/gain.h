// What drawing a node's visible children in its place brings (algorithms 2.1 and 3, Gain). The node is `parent`, its visible
// children and their priorities stand in state.group and state.priorities.
#pragma once

#include "select/select.h"

namespace fb {

// Benefits of the visible children (thesis 4.2), less what their parent's part of the same region has already. Above 0.
[[nodiscard]] double benefitGain(const SelectInput& input, NodeId parent, const SelectState& state);

// By how many pixels how many pixels are wrong by less: pixels times pixels. 0 only where nothing gets finer.
[[nodiscard]] double errorGain(const SelectInput& input, NodeId parent, const SelectState& state);

// The parts of it: what one child of `parent` brings.
class ChildErrorGain {
  public:
    ChildErrorGain(const Hierarchy& hierarchy, NodeId parent, const View& view);
    // Seen from `distance` metres.
    [[nodiscard]] double of(NodeId child, double distance) const;

  private:
    const Hierarchy& hierarchy_;
    double pixelsPerUnit_, picture_, diagonal_;  // pixels
    double shape_, texel_, before_;              // of the parent, in metres: geometric error, edge of a texel, both together
};

}  // namespace fb
