// What the slow implementations give back for a frame, and how they count switches (thesis 6.5; algorithms 2,
// "Switches").
#pragma once

#include <map>
#include <set>

#include "select/select.h"

namespace fb {

struct SlowFrame {
    std::set<NodeId> front;
    std::map<NodeId, BoundBy> boundBy;
    std::uint32_t togglesUp = 0, togglesDown = 0, pingPongs = 0, refusedGroups = 0, repairedPriorities = 0;
    std::uint32_t skippedRoots = 0;
    bool hungOnRounding =
        false;  // a difference too small to be the same in another order of summing decided something
};

class SlowSwitches {
  public:
    // For each reached node: are its visible children drawn, or it?
    void record(std::uint64_t frameNumber, NodeId node, bool fine, SlowFrame& frame);
    // For a reached node none of whose children is in view.
    void keep(NodeId node);
    void endFrame();
    // Whether its children were drawn in the frame before. Where they were out of view: before that.
    [[nodiscard]] bool wasFine(NodeId node) const;

  private:
    struct Switch {
        std::uint64_t frame;
        bool up;
    };
    std::map<NodeId, bool> fineBefore_, fineNow_;  // of the last frame and of this one
    std::map<NodeId, Switch> lastSwitch_;
};

}  // namespace fb
