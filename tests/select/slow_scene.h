// What every policy of algorithms 2.1 and 3 knows of a frame, for the slow implementations: what is in view,
// what may be refined, what that takes and brings. A front is given as the roots that are drawn and the set
// of refined nodes.
#pragma once

#include "select/slow_frame.h"

namespace fb {

using SlowSet = std::set<NodeId>;

struct SlowNode {
    std::vector<NodeId> children;  // those in view
    bool usable = false;
    BoundBy unusable = BoundBy::leaf;  // why, where it is not
    double timeMs = 0.0, benefit = 0.0, errorPixels = 0.0;
    double extraMs = 0.0, value = 0.0;  // where any child is in view
    std::int64_t triangles = 0, extraTriangles = 0;
};

class SlowScene {
  public:
    explicit SlowScene(const SelectInput& input);

    std::vector<NodeId> roots;  // in view
    const SelectInput& in;
    bool hungOnRounding = false;

    [[nodiscard]] const SlowNode& operator[](NodeId node) const { return nodes_.at(node); }

    // a < b. Notes when they are so close that other roundings might say otherwise; exact equals are equal.
    bool below(double a, double b);
    // The member of the set with the largest (smallest) of a number, the lowest id among equals. kNoNode:
    // empty set.
    template <class Number>
    NodeId largest(const SlowSet& set, Number number);
    template <class Number>
    NodeId smallest(const SlowSet& set, Number number);

    // All nodes from these roots down that are drawn or refined.
    [[nodiscard]] SlowSet reached(const std::vector<NodeId>& from, const SlowSet& refined) const;
    // Those that are drawn.
    [[nodiscard]] SlowSet drawn(const std::vector<NodeId>& from, const SlowSet& refined) const;
    // Those that are drawn and may be refined.
    [[nodiscard]] SlowSet refinable(const std::vector<NodeId>& from, const SlowSet& refined) const;
    // Refined ones of which no child in view is refined.
    [[nodiscard]] SlowSet innermost(const SlowSet& refined) const;
    [[nodiscard]] double totalMs(const SlowSet& drawn) const;  // with what no front changes

    // Writes front, reasons and switches. `reason` is asked for the drawn nodes.
    template <class Reason>
    SlowFrame finish(const std::vector<NodeId>& from, const SlowSet& refined, SlowSwitches& switches,
                     Reason reason);

  private:
    void look(NodeId node, double outside);
    void weighRefinement(NodeId node);
    std::map<NodeId, SlowNode> nodes_;  // in view
};

template <class Number>
NodeId SlowScene::largest(const SlowSet& set, Number number) {
    NodeId best = kNoNode;
    for (NodeId n : set) {
        if (best == kNoNode || below(number(best), number(n))) best = n;
    }
    return best;
}

template <class Number>
NodeId SlowScene::smallest(const SlowSet& set, Number number) {
    return largest(set, [&](NodeId n) { return -number(n); });
}

template <class Reason>
SlowFrame SlowScene::finish(const std::vector<NodeId>& from, const SlowSet& refined, SlowSwitches& switches,
                            Reason reason) {
    SlowFrame frame;
    for (NodeId n : reached(from, refined)) {
        const SlowNode& node = (*this)[n];
        if (in.hierarchy.childCount[n] > 0 && node.children.empty()) switches.keep(n);
        if (!node.children.empty()) switches.record(in.frame, n, refined.contains(n), frame);
    }
    switches.endFrame();
    frame.front = drawn(from, refined);
    for (NodeId n : frame.front) frame.boundBy[n] = reason(n);
    frame.hungOnRounding = hungOnRounding;
    return frame;
}

}  // namespace fb
