// Policy `erikson`: the node with the largest error in pixels first, until the next one would exceed a number of triangles
// (Erikson et al. 2001; algorithms 2.1). The number is what the newest measured frame drew, times target over actual.
#include <algorithm>

#include "select/screen_error.h"
#include "select/select_policies.h"

namespace fb {
namespace {

double triangleBudget(const SelectInput& input) {
    const MeasuredFront& m = input.measured;
    if (m.triangles > 0 && m.actualMs > 0.0)
        return static_cast<double>(m.triangles) * input.targetMs / m.actualMs;
    const double oneMs = 0.5 * (input.time.texturedMs + input.time.untexturedMs);
    return oneMs > 0.0 ? std::max(0.0, input.targetMs - input.time.fixedMs) / oneMs : 0.0;
}

}  // namespace

void selectErikson(const SelectInput& input, SelectState& state, Selection& selection) {
    RefinementTree& tree = state.tree;
    const ByValue lessError{tree};
    const auto trianglesOf = [&](NodeId n) { return static_cast<double>(input.hierarchy.triangles(n)); };
    double triangles = 0.0;
    state.heap.clear();
    const auto offer = [&](std::uint32_t from) {
        for (std::uint32_t i = from; i < tree.nodes.size(); ++i) {
            Refinement& r = tree.nodes[i];
            r.value = nodeErrorPixels(input.hierarchy, r.node, input.view);
            if (!r.usable || !(r.value > 0.0)) continue;
            state.heap.push_back(i);
            std::ranges::push_heap(state.heap, lessError);
        }
    };
    tree.start(input, state, selection);
    for (const Refinement& r : tree.nodes) triangles += trianglesOf(r.node);
    offer(0);
    const double budget = triangleBudget(input);
    while (!state.heap.empty()) {
        std::ranges::pop_heap(state.heap, lessError);
        const std::uint32_t worst = state.heap.back();
        state.heap.pop_back();
        Refinement& r = tree.nodes[worst];
        double more = -trianglesOf(r.node);
        for (std::uint32_t i = 0; i < r.childCount; ++i) more += trianglesOf(tree.children[r.firstChild + i]);
        r.needMs = r.extraMs;
        if (triangles + more > budget) break;
        triangles += more;
        const auto end = static_cast<std::uint32_t>(tree.nodes.size());
        tree.expand(worst, input, state, selection);
        offer(end);
    }
    for (Refinement& r : tree.nodes) {
        if (r.expanded || r.childCount == 0) continue;
        if (!(r.value > 0.0)) r.boundBy = BoundBy::policy;
        if (r.boundBy == BoundBy::time) ++selection.counters.refusedGroups;
    }
    tree.finish(selection);
}

}  // namespace fb
