#include "select/sibling_group.h"

#include <algorithm>

#include "select/priority.h"

namespace fb {

void gatherGroup(const SelectInput& input, NodeId parent, SelectState& state, Selection& selection) {
    state.group.clear();
    state.priorities.clear();
    const Hierarchy& h = input.hierarchy;
    const NodeId first = parent == kNoNode ? 0 : h.firstChild[parent];
    const std::uint32_t count = parent == kNoNode ? h.rootCount : h.childCount[parent];
    for (NodeId n = first; n < first + count; ++n) {
        const NodeView seen = lookAtNode(h, n, input.view, input.settings, input.effects, selection.counters.effectWork);
        ++selection.counters.visited;
        if (!seen.visible) continue;
        selection.counters.repairedPriorities += seen.repaired ? 1 : 0;
        state.group.push_back(n);
        state.priorities.push_back(seen.priority);
    }
}

GroupMemory groupMemory(const SelectInput& input, NodeId parent, const SelectState& state) {
    const NodeId first = input.hierarchy.firstChild[parent];
    bool loaded = true;
    bool refused = false;
    const auto look = [&](NodeId n) {
        loaded = loaded && input.loaded[n] != 0;
        refused = refused || input.memoryRefused[n] != 0;
    };
    if (input.settings.needAllChildren) {
        for (NodeId n = first; n < first + input.hierarchy.childCount[parent]; ++n) look(n);
    } else {
        for (NodeId n : state.group) look(n);
    }
    if (loaded) return GroupMemory::loaded;
    return refused ? GroupMemory::refused : GroupMemory::missing;
}

double rootShare(const SelectInput& input) { return std::max(input.shareMs, 0.05 * input.targetMs); }

}  // namespace fb
