// Policy `maciel-shirley`: what is best now is only wished for; a switch is made when it was wished for in more frames
// running than a fixed number (Maciel and Shirley 1995; thesis 4.2, Hysteresis; algorithms 2.1). Nothing is more urgent
// than anything else, so times follow late.
#include <algorithm>

#include "select/select_best_first.h"
#include "select/select_policies.h"

namespace fb {
namespace {

// The children of what has just been switched begin coarse; what comes into view begins as it is wished for.
enum Entry : std::uint8_t { seenBefore, cameIntoView, justSwitched };

}  // namespace

void selectMacielShirley(const SelectInput& input, SelectState& state, Selection& selection) {
    refineBestFirst(input, state, selection);
    // The wish by node, as a frame's mark: what is refined in this frame's best front.
    for (const Refinement& r : state.tree.nodes) state.wishedFrame[r.node] = r.expanded ? input.frame : 0;

    RefinementTree& tree = state.tree;
    tree.start(input, state, selection);
    state.marks.assign(tree.nodes.size(), cameIntoView);  // by node of the tree
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const NodeId n = tree.nodes[i].node;
        const auto entry = state.wasSeen(n, input.frame) ? seenBefore : static_cast<Entry>(state.marks[i]);
        state.seenFrame[n] = input.frame;
        if (!tree.nodes[i].usable) {
            state.refined[n] = 0;
            state.waited[n] = 0.0f;
            continue;
        }
        const bool wish = state.wishedFrame[n] == input.frame;
        bool switched = false;
        if (entry != seenBefore) {
            state.refined[n] = entry == cameIntoView && wish ? 1 : 0;
            state.waited[n] = 0.0f;
        } else if (wish == (state.refined[n] != 0)) {
            state.waited[n] = 0.0f;
        } else if (static_cast<double>(++state.waited[n]) > input.settings.switchAfter) {
            state.refined[n] = wish ? 1 : 0;
            state.waited[n] = 0.0f;
            switched = true;
        }
        if (state.refined[n] == 0) {
            tree.nodes[i].boundBy = wish ? BoundBy::hysteresis : BoundBy::time;
            tree.nodes[i].needMs = tree.nodes[i].extraMs;
            if (!wish) ++selection.counters.refusedGroups;
            continue;
        }
        tree.expand(i, input, state, selection);
        state.marks.resize(tree.nodes.size(), switched ? justSwitched : cameIntoView);
    }
    tree.finish(selection);
}

}  // namespace fb
