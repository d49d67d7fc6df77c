// Policy `full`: every visible leaf, whatever it takes; coarser only where children are not loaded. The reference that
// image errors are measured against.
#include "select/select_policies.h"
#include "select/sibling_group.h"

namespace fb {

void selectFull(const SelectInput& input, SelectState& state, Selection& selection) {
    gatherGroup(input, kNoNode, state, selection);
    descendBySlices(input, 1.0, state, selection, [&](NodeId n, double) -> Reached {
        if (input.hierarchy.isLeaf(n)) return {n, false, BoundBy::leaf};
        gatherGroup(input, n, state, selection);
        if (state.group.empty()) return {n, false, BoundBy::view};
        const GroupMemory memory = groupMemory(input, n, state);
        if (memory != GroupMemory::loaded) return {n, false, boundByMemory(memory)};
        return {n, true, BoundBy::leaf};
    });
}

}  // namespace fb
