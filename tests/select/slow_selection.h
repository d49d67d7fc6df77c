// A second implementation of the policies lakhia and lakhia-naive, for tests: recursive, with maps instead of
// arrays, slopes in camera axes instead of planes, no scratch memory and no frame stamps. Written from the
// equations of the thesis (4.2) as core/algorithms.md section 2 numbers them; slow, and as close to their
// wording as code can be.
#pragma once

#include <map>

#include "select/slow_frame.h"

namespace fb {

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
    static std::vector<double> slicesOf(const SelectInput& input, const std::vector<Member>& group, double shareMs);
    double moveCounters(const SelectInput& input, const std::vector<Member>& group, double shareMs);
    void visit(const SelectInput& input, NodeId node, double shareMs, SlowFrame& frame);
    void draw(NodeId node, BoundBy reason, SlowFrame& frame);

    SlowSwitches switches_;
};

}  // namespace fb
