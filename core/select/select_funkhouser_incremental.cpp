// Policy `funkhouser-incremental`: the Adaptive Display algorithm's second form (Funkhouser and Sequin 1993; thesis 5.1)
// on a hierarchy (algorithms 2.1). Starts with what was drawn; makes the best refinement that is left, takes the worst ones
// back until the rest fits, and so on, until one would be made and taken back in the same frame. Roots are always drawn.
#include <algorithm>

#include "select/select_policies.h"

namespace fb {
namespace {

enum Mark : std::uint8_t { untouched, made, takenBack };

class Exchange {
  public:
    Exchange(const SelectInput& input, SelectState& state, Selection& selection)
        : input_(input), state_(state), selection_(selection), tree_(state.tree) {}

    void run() {
        tree_.start(input_, state_, selection_);
        continueFromBefore();
        totalMs_ = input_.time.fixedMs + tree_.drawnMs();
        state_.marks.assign(tree_.nodes.size(), untouched);
        listBoth();
        takeBackUntilItFits();
        while (makeBest() && takeBackUntilItFits()) continue;
        keep();
    }

  private:
    // What comes into view comes in its coarsest form.
    void continueFromBefore() {
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            const NodeId n = tree_.nodes[i].node;
            const bool before = state_.wasSeen(n, input_.frame) && state_.refined[n] != 0;
            if (before && tree_.nodes[i].usable) tree_.expand(i, input_, state_, selection_);
        }
    }

    void listBoth() {
        state_.heap.clear();
        state_.heapDown.clear();
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            if (tree_.isInnermost(i)) push(state_.heapDown, i, true);
            if (tree_.nodes[i].usable && !tree_.nodes[i].expanded) push(state_.heap, i, false);
        }
    }

    void push(std::vector<std::uint32_t>& heap, std::uint32_t i, bool lowestFirst) {
        heap.push_back(i);
        std::ranges::push_heap(heap, ByValue{tree_, lowestFirst});
    }
    std::uint32_t pop(std::vector<std::uint32_t>& heap, bool lowestFirst) {
        std::ranges::pop_heap(heap, ByValue{tree_, lowestFirst});
        const std::uint32_t i = heap.back();
        heap.pop_back();
        return i;
    }

    // False where nothing is left to be made, or the best has been taken back in this frame.
    bool makeBest() {
        while (!state_.heap.empty()) {
            const std::uint32_t best = pop(state_.heap, false);
            if (tree_.nodes[best].expanded || !tree_.isReached(tree_.nodes[best])) continue;
            if (state_.marks[best] == takenBack) return false;
            const auto end = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.expand(best, input_, state_, selection_);
            totalMs_ += tree_.nodes[best].extraMs;
            state_.marks[best] = made;
            state_.marks.resize(tree_.nodes.size(), untouched);
            push(state_.heapDown, best, true);
            for (std::uint32_t i = end; i < tree_.nodes.size(); ++i) {
                if (tree_.nodes[i].usable) push(state_.heap, i, false);
            }
            return true;
        }
        return false;
    }

    // False where one that was made in this frame had to go again.
    bool takeBackUntilItFits() {
        bool isStable = true;
        while (totalMs_ > input_.targetMs && !state_.heapDown.empty()) {
            const std::uint32_t worst = pop(state_.heapDown, true);
            if (!tree_.isInnermost(worst)) continue;
            Refinement& r = tree_.nodes[worst];
            tree_.collapse(worst);
            totalMs_ -= r.extraMs;
            r.needMs = r.extraMs;
            r.hadMs = input_.targetMs - totalMs_;
            if (state_.marks[worst] == made) isStable = false;
            state_.marks[worst] = takenBack;
            push(state_.heap, worst, false);
            if (r.parent != kNoRefinement && tree_.isInnermost(r.parent)) push(state_.heapDown, r.parent, true);
        }
        return isStable;
    }

    void keep() {
        for (const Refinement& r : tree_.nodes) {
            if (!tree_.isReached(r)) continue;
            state_.seenFrame[r.node] = input_.frame;
            state_.refined[r.node] = r.expanded ? 1 : 0;
            if (r.usable && !r.expanded) ++selection_.counters.refusedGroups;
        }
        tree_.finish(selection_);
    }

    const SelectInput& input_;
    SelectState& state_;
    Selection& selection_;
    RefinementTree& tree_;
    double totalMs_ = 0.0;
};

}  // namespace

void selectFunkhouserIncremental(const SelectInput& input, SelectState& state, Selection& selection) {
    Exchange(input, state, selection).run();
}

}  // namespace fb
