// What the policies that walk down sibling groups share: which children are seen, whether the group may be drawn, and
// time slices (thesis 4.2, algorithms 2 items 2 to 5).
#pragma once

#include "select/select.h"
#include "select/slices.h"

namespace fb {

// The visible children of `parent`, or the visible roots for kNoNode, appended to state.group; their priorities to
// state.priorities. Both are cleared first.
void gatherGroup(const SelectInput& input, NodeId parent, SelectState& state, Selection& selection);

enum class GroupMemory : std::uint8_t { loaded, missing, refused };  // refused: the budget has no room for it
[[nodiscard]] GroupMemory groupMemory(const SelectInput& input, NodeId parent, const SelectState& state);

[[nodiscard]] inline BoundBy boundByMemory(GroupMemory memory) {
    return memory == GroupMemory::refused ? BoundBy::memory : BoundBy::load;
}

[[nodiscard]] inline double timeNeeded(const SelectInput& input, NodeId node) {
    return nodeTimeMs(input.time, input.hierarchy, node);
}

// The share time of the roots, which a heavy overhead may not make negative (algorithms 5, case 11).
[[nodiscard]] double rootShare(const SelectInput& input);

// Breadth first from the group in state.group: each node waits in the queue with its
// slice; decide(node, sliceMs) says whether it is expanded and then leaves the visible children in state.group, their slices of
// it in state.slices; so does the caller for the first group.
template <class Decide>
void descendBySlices(SelectState& state, Selection& selection, const Decide& decide) {
    state.queue.clear();
    state.shares.clear();
    const auto queueGroup = [&] {
        state.queue.insert(state.queue.end(), state.group.begin(), state.group.end());
        state.shares.insert(state.shares.end(), state.slices.begin(), state.slices.end());
    };
    queueGroup();
    for (std::size_t next = 0; next < state.queue.size(); ++next) {
        const double sliceMs = state.shares[next];
        const Reached reached = decide(state.queue[next], sliceMs);
        if (reached.expanded) queueGroup();
        selection.reached.push_back(reached);
    }
}

}  // namespace fb
