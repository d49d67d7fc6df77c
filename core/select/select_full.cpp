// Policy `full`: every visible leaf, whatever it takes; coarser only where children are not loaded. The reference that
// image errors are measured against.
#include "select/select_policies.h"

namespace fb {

void selectFull(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    tree.start(input, state, selection);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        if (tree.nodes[i].usable) tree.expand(i, input, state, selection);
    }
    tree.finish(selection);
}

}  // namespace fb
