// Policy `greedy`: the increments of Mason and Blake, as Zach uses them (algorithms 2.1). From the visible roots on, the
// refinement with the largest gain for its time is made, if it fits; one that does not is passed over.
#include <algorithm>

#include "select/select_best_first.h"
#include "select/select_policies.h"

namespace fb {

void refineBestFirst(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    const ByValue lessValue{tree};
    state.heap.clear();
    const auto offer = [&](std::uint32_t from) {
        for (std::uint32_t i = from; i < tree.nodes.size(); ++i) {
            if (!tree.nodes[i].usable) continue;
            state.heap.push_back(i);
            std::ranges::push_heap(state.heap, lessValue);
        }
    };
    tree.start(input, state, selection);
    double totalMs = input.time.fixedMs + tree.drawnMs();
    offer(0);
    while (!state.heap.empty()) {
        std::ranges::pop_heap(state.heap, lessValue);
        const std::uint32_t best = state.heap.back();
        state.heap.pop_back();
        Refinement& r = tree.nodes[best];
        r.needMs = r.extraMs;
        r.hadMs = input.targetMs - totalMs;
        if (r.extraMs > r.hadMs) continue;
        totalMs += r.extraMs;
        const auto end = static_cast<std::uint32_t>(tree.nodes.size());
        tree.expand(best, input, state, selection);
        offer(end);
    }
}

void selectGreedy(const SelectInput& input, SelectState& state, Selection& selection) {
    refineBestFirst(input, state, selection);
    for (const Refinement& r : state.tree.nodes) {
        if (r.usable && !r.expanded) ++selection.counters.refusedGroups;
    }
    state.tree.finish(selection);
}

}  // namespace fb
