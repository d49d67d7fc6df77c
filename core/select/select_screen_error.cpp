// Policy `screen-error`: refines whatever would be wrong by more than a number of pixels, whatever it takes: what viewers
// of 3D Tiles do (algorithms 2.1). The error is the bound of algorithms section 8.
#include "select/screen_error.h"
#include "select/select_policies.h"

namespace fb {

void selectScreenError(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    tree.start(input, state, selection);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const NodeId node = tree.nodes[i].node;
        if (tree.nodes[i].childCount == 0) continue;
        if (!(nodeErrorPixels(input.hierarchy, node, input.view) > input.settings.pixelThreshold)) {
            tree.nodes[i].boundBy = BoundBy::policy;
        } else if (tree.nodes[i].usable) {
            tree.expand(i, input, state, selection);
        }
    }
    tree.finish(selection);
}

}  // namespace fb
