// Policy `coarse`: the visible roots. The lower end of what any policy can draw, and the whole front where nothing but
// level 0 is loaded.
#include "select/select_policies.h"
#include "select/sibling_group.h"

namespace fb {

void selectCoarse(const SelectInput& input, SelectState& state, Selection& selection) {
    gatherGroup(input, kNoNode, state, selection);
    for (NodeId n : state.group) {
        const bool leaf = input.hierarchy.isLeaf(n);
        selection.reached.push_back({n, false, leaf ? BoundBy::leaf : BoundBy::policy});
    }
}

}  // namespace fb
