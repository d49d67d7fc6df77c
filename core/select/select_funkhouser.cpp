// Policy `funkhouser`: the Adaptive Display algorithm of Funkhouser and Sequin (1993; thesis 5.1) on a hierarchy
// (algorithms 2.1). Everything that could be drawn is listed, as steps: a root from nothing, the visible children in place
// of their parent. All steps are sorted by what they bring for their time and taken in that order as long as they fit. A
// root that does not fit is not drawn at all. N log N in all nodes that are in view and loaded.
#include <algorithm>

#include "select/select_policies.h"

namespace fb {
namespace {

constexpr double kLeastMs = 1e-3;

double valueOfRoot(const SelectInput& input, const Refinement& root) {
    const double benefit = root.priority * nodeCost(input.hierarchy, root.node, input.settings.cTextured);
    return benefit / std::max(root.ownMs, kLeastMs);
}

// A root's step and its refinement's are told apart by the lowest bit.
std::uint32_t rootStep(std::uint32_t index) { return 2 * index; }
std::uint32_t refinementStep(std::uint32_t index) { return 2 * index + 1; }

}  // namespace

void selectFunkhouser(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    tree.start(input, state, selection);
    const std::size_t roots = tree.nodes.size();
    state.shares.clear();  // values of the roots' own steps
    for (std::size_t i = 0; i < roots; ++i) {
        double value = valueOfRoot(input, tree.nodes[i]);
        if (!state.wasSeen(tree.nodes[i].node, input.frame)) value *= 1.0 - input.settings.switchPenalty;
        state.shares.push_back(value);
    }
    // No step is worth more than the one that it needs: the list has every parent before its children.
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        Refinement& r = tree.nodes[i];
        if (!r.usable) continue;
        const bool wasDrawn = state.wasSeen(r.node, input.frame) && state.refined[r.node] != 0;
        if (!wasDrawn) r.value *= 1.0 - input.settings.switchPenalty;
        r.value = std::min(r.value, i < roots ? state.shares[i] : tree.nodes[r.parent].value);
        tree.expand(i, input, state, selection);
    }
    state.heap.clear();
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        if (i < roots) state.heap.push_back(rootStep(i));
        if (tree.nodes[i].expanded) state.heap.push_back(refinementStep(i));
    }
    const auto valueOf = [&](std::uint32_t step) {
        return step % 2 == 0 ? state.shares[step / 2] : tree.nodes[step / 2].value;
    };
    std::ranges::sort(state.heap, [&](std::uint32_t a, std::uint32_t b) {
        const double x = valueOf(a), y = valueOf(b);
        if (x != y) return x > y;
        const NodeId m = tree.nodes[a / 2].node, n = tree.nodes[b / 2].node;
        return m != n ? m < n : a < b;
    });

    for (Refinement& r : tree.nodes) r.expanded = false;
    std::vector<std::uint8_t>& taken = state.marks;  // by root: 1 where it is drawn
    taken.assign(roots, 0);
    double totalMs = input.time.fixedMs;
    for (const std::uint32_t step : state.heap) {
        const std::uint32_t i = step / 2;
        Refinement& r = tree.nodes[i];
        const double left = input.targetMs - totalMs;
        if (step % 2 == 0) {
            if (r.ownMs > left) continue;
            taken[i] = 1;
            totalMs += r.ownMs;
            continue;
        }
        const bool isDrawn = i < roots ? taken[i] != 0 : tree.nodes[r.parent].expanded;
        if (!isDrawn) continue;
        r.needMs = r.extraMs;
        r.hadMs = left;
        if (r.extraMs > left) continue;
        r.expanded = true;
        totalMs += r.extraMs;
    }
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const Refinement& r = tree.nodes[i];
        const bool isDrawn = i < roots ? taken[i] != 0 : tree.nodes[r.parent].expanded;
        if (i < roots && !isDrawn) ++selection.counters.skippedRoots;
        state.seenFrame[r.node] = isDrawn ? input.frame : state.seenFrame[r.node];
        state.refined[r.node] = r.expanded ? 1 : 0;
        if (!isDrawn) continue;
        if (r.usable && !r.expanded) ++selection.counters.refusedGroups;
        selection.reached.push_back({r.node, r.expanded, r.boundBy, r.needMs, r.hadMs});
    }
}

}  // namespace fb
