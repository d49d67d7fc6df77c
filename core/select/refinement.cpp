#include "select/refinement.h"

#include <algorithm>

#include "base/check.h"
#include "select/gain.h"
#include "select/select.h"
#include "select/sibling_group.h"

namespace fb {
namespace {

constexpr double kLeastExtraMs = 1e-3;
constexpr double kLargestValue = 1e300;
constexpr double kSavingFactor = 1000.0;  // what takes no more time is worth as if it took the least

}  // namespace

void RefinementTree::start(const SelectInput& input, SelectState& state, Selection& selection, GainMeasure gain) {
    gain_ = gain;
    nodes.clear();
    children.clear();
    gatherGroup(input, kNoNode, state, selection);
    children.assign(state.group.begin(), state.group.end());
    state.shares.assign(state.priorities.begin(), state.priorities.end());  // adding a node takes the place of the group
    const std::size_t roots = children.size();
    for (std::size_t i = 0; i < roots; ++i) {
        add(children[i], kNoRefinement, input, state, selection);
        nodes.back().priority = state.shares[i];
    }
}

void RefinementTree::expand(std::uint32_t index, const SelectInput& input, SelectState& state, Selection& selection) {
    FB_CHECK(nodes[index].usable);
    FB_CHECK(!nodes[index].expanded);
    nodes[index].expanded = true;
    if (nodes[index].parent != kNoRefinement) ++nodes[nodes[index].parent].expandedChildren;
    if (nodes[index].firstNode != kNoRefinement) return;
    nodes[index].firstNode = static_cast<std::uint32_t>(nodes.size());
    const std::uint32_t first = nodes[index].firstChild, count = nodes[index].childCount;
    for (std::uint32_t i = first; i < first + count; ++i) add(children[i], index, input, state, selection);
}

void RefinementTree::collapse(std::uint32_t index) {
    FB_CHECK(isInnermost(index));
    nodes[index].expanded = false;
    if (nodes[index].parent != kNoRefinement) --nodes[nodes[index].parent].expandedChildren;
}

void RefinementTree::finish(Selection& selection) const {
    for (const Refinement& r : nodes) {
        if (isReached(r)) selection.reached.push_back({r.node, r.expanded, r.boundBy, r.needMs, r.hadMs});
    }
}

double RefinementTree::drawnMs() const {
    double ms = 0.0;
    for (const Refinement& r : nodes) {
        if (!r.expanded && isReached(r)) ms += r.ownMs;
    }
    return ms;
}

void RefinementTree::add(NodeId node, std::uint32_t parent, const SelectInput& input, SelectState& state,
                         Selection& selection) {
    Refinement r;
    r.node = node;
    r.parent = parent;
    r.ownMs = nodeTimeMs(input.time, input.hierarchy, node);
    if (!input.hierarchy.isLeaf(node)) {
        gatherGroup(input, node, state, selection);
        r.firstChild = static_cast<std::uint32_t>(children.size());
        r.childCount = static_cast<std::uint32_t>(state.group.size());
        children.insert(children.end(), state.group.begin(), state.group.end());
        const GroupMemory memory = groupMemory(input, node, state);
        r.usable = r.childCount > 0 && memory == GroupMemory::loaded;
        r.boundBy = r.childCount == 0 ? BoundBy::view : r.usable ? BoundBy::time : boundByMemory(memory);
        weigh(r, input, state);
    }
    nodes.push_back(r);
}

void RefinementTree::weigh(Refinement& r, const SelectInput& input, const SelectState& state) const {
    double childrenMs = 0.0;
    for (const NodeId child : state.group) childrenMs += nodeTimeMs(input.time, input.hierarchy, child);
    r.gain = gain_ == GainMeasure::error ? errorGain(input, r.node, state) : benefitGain(input, r.node, state);
    r.extraMs = childrenMs - r.ownMs;
    r.value = r.extraMs > 0.0 ? r.gain / std::max(r.extraMs, kLeastExtraMs) : kSavingFactor * r.gain;
    r.value = std::min(r.value, kLargestValue);
}

}  // namespace fb
