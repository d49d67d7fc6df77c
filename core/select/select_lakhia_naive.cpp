// Policy `lakhia-naive`: time slices without hysteresis (thesis 4.2, Time Slicing; algorithms 2.1). A loaded group is
// drawn while its share is larger than what its visible members need.
#include "select/select_policies.h"
#include "select/sibling_group.h"

namespace fb {
namespace {

Reached decideNaively(const SelectInput& input, NodeId n, double shareMs, SelectState& state, Selection& selection) {
    if (input.hierarchy.isLeaf(n)) return {n, false, BoundBy::leaf};
    gatherGroup(input, n, state, selection);
    if (state.group.empty()) return {n, false, BoundBy::view};
    double needMs = 0.0;
    for (NodeId child : state.group) needMs += timeNeeded(input, child);
    const GroupMemory memory = groupMemory(input, n, state);
    if (!(shareMs > needMs)) {
        if (memory == GroupMemory::loaded) ++selection.counters.refusedGroups;
        return {n, false, BoundBy::time, needMs, shareMs};
    }
    if (memory != GroupMemory::loaded) return {n, false, boundByMemory(memory), needMs, shareMs};
    shareOut(input, shareMs, state, selection.counters);
    return {n, true, BoundBy::leaf, needMs, shareMs};
}

}  // namespace

void selectLakhiaNaive(const SelectInput& input, SelectState& state, Selection& selection) {
    gatherGroup(input, kNoNode, state, selection);
    shareOut(input, rootShare(input), state, selection.counters);
    descendBySlices(state, selection,
                    [&](NodeId n, double sliceMs) { return decideNaively(input, n, sliceMs, state, selection); });
}

}  // namespace fb
