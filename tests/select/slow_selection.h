// A second implementation of the policies lakhia and lakhia-naive, for tests: recursive, with maps instead of
// arrays, slopes in camera axes instead of planes, no scratch memory and no frame stamps. Written from the
// equations of the thesis (4.2) as core/algorithms.md section 2 numbers them; slow, and as close to their
// wording as code can be.
#pragma once

#include <map>
#include <set>

#include "select/select.h"

namespace fb {

struct SlowFrame {
    std::set<NodeId> front;
    std::map<NodeId, BoundBy> boundBy;
    std::uint32_t togglesUp = 0, togglesDown = 0, pingPongs = 0, refusedGroups = 0, repairedPriorities = 0;
};

class SlowSelection {
  public:
    SlowFrame step(const SelectInput& input);
    std::map<NodeId, double> counters;  // h; a node that is not in it has the start value

  private:
    struct Member {
        NodeId node;
        double priority;
    };
    std::vector<Member> visibleOf(const SelectInput& input, NodeId first, std::uint32_t count,
                                  SlowFrame& frame);
    double moveCounters(const SelectInput& input, const std::vector<Member>& group, double shareMs);
    void visit(const SelectInput& input, NodeId node, double shareMs, SlowFrame& frame);
    void draw(NodeId node, BoundBy reason, SlowFrame& frame);
    void record(const SelectInput& input, NodeId node, bool fine, SlowFrame& frame);

    struct Switch {
        std::uint64_t frame;
        bool up;
    };
    std::map<NodeId, bool> fineBefore_, fineNow_;  // of the last frame and of this one
    std::map<NodeId, Switch> lastSwitch_;
};

}  // namespace fb
