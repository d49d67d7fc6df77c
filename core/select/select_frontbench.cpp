// Policy `frontbench`, our own (algorithms section 3): what is drawn stays until something is clearly better. Time that is
// left goes to the refinement with the largest gain for its time, the sooner the more it gains; time that is missing is
// taken from where it brings least; and time changes hands only where it brings several times as much there. What was not
// in the picture before does not wait: nobody sees it switch.
#include <algorithm>

#include "select/continue_front.h"
#include "select/frontbench_marks.h"
#include "select/givers.h"
#include "select/screen_error.h"
#include "select/select_policies.h"

namespace fb {
namespace {

constexpr double kLeastWait = 0.03;  // of refine_wait
constexpr int kFasterWithRoom = 4;
constexpr double kRestFrom = 2.0, kRestFor = 2.0;  // seconds
constexpr double kPriceSeconds = 1.0;  // in which the price falls to a half while nobody is refused
constexpr double kLeastPrice = 1e-300, kMostHaste = 1e6;

class Trade {
  public:
    Trade(const SelectInput& input, SelectState& state, Selection& selection)
        : in_(input), s_(input.settings), state_(state), selection_(selection), tree_(state.tree) {}

    void run() {
        tree_.start(in_, state_, selection_, s_.gainMeasure);
        if (tree_.nodes.empty()) return;
        const double rest = std::clamp((state_.restSeconds - kRestFrom) / kRestFor, 0.0, 1.0);
        patience_ = state_.patience = 1.0 + (s_.restFactor - 1.0) * rest;
        continueFront(in_, state_, selection_);
        marks_ = frontbenchMarks(in_, in_.time.fixedMs + tree_.drawnMs(), patience_);
        if (marks_.tooMuch) {
            giveBack();
        } else {
            spend();
        }
        tree_.finish(selection_);
    }

  private:
    // Step 4.
    void giveBack() {
        const ByValue order{tree_, true};
        std::vector<std::uint32_t>& heap = state_.heapDown;
        heap.clear();
        const auto offer = [&](std::uint32_t i) {
            if (!tree_.isInnermost(i) || !(tree_.nodes[i].extraMs > 0.0)) return;
            heap.push_back(i);
            std::ranges::push_heap(heap, order);
        };
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) offer(i);
        while (marks_.totalMs > marks_.middleMs && !heap.empty()) {
            std::ranges::pop_heap(heap, order);
            const std::uint32_t least = heap.back();
            heap.pop_back();
            collapse(least);
            state_.price = tree_.nodes[least].value;
            if (tree_.nodes[least].parent != kNoRefinement) offer(tree_.nodes[least].parent);
        }
        for (Refinement& r : tree_.nodes) {
            if (r.usable && !r.expanded && tree_.isReached(r)) refuse(r, BoundBy::time);
        }
    }

    // Step 5.
    void spend() {
        const double unused = marks_.middleMs > 0.0 ? 1.0 - marks_.totalMs / marks_.middleMs : 0.0;
        waitSeconds_ = patience_ * s_.refineWait * std::clamp(1.0 - unused / s_.urgency, kLeastWait, 1.0);
        leftToMake_ = s_.refineRate * (unused > s_.urgency ? kFasterWithRoom : 1);
        const double priceBefore = state_.price;
        double bestRefused = 0.0;
        std::int64_t failed = 0;
        state_.heap.clear();
        offerFrom(0);
        while (!state_.heap.empty()) {
            std::ranges::pop_heap(state_.heap, ByValue{tree_});
            const std::uint32_t best = state_.heap.back();
            state_.heap.pop_back();
            // A giver of an exchange takes its children's refinements with it.
            if (!tree_.isReached(tree_.nodes[best])) continue;
            const bool isFree = extraMs(best) <= 0.0;
            // So many better ones wait for time that the others leave it to them.
            if (failed == s_.refineRate && !isFree) {
                refuse(tree_.nodes[best], BoundBy::time);
            } else if (isFree || marks_.totalMs + extraMs(best) <= marks_.middleMs) {
                spendOn(best, priceBefore);
            } else {
                bestRefused = std::max(bestRefused, tree_.nodes[best].value);
                considerExchange(best);
                ++failed;
            }
        }
        // It falls slowly: a moment without anybody refused says little.
        state_.price = std::max(bestRefused, priceBefore * kPriceSeconds / (kPriceSeconds + in_.dtSeconds));
    }

    void offerFrom(std::size_t first) {
        for (std::size_t i = first; i < tree_.nodes.size(); ++i) {
            if (!tree_.nodes[i].usable || tree_.nodes[i].expanded) continue;
            state_.heap.push_back(static_cast<std::uint32_t>(i));
            std::ranges::push_heap(state_.heap, ByValue{tree_});
        }
    }

    // It fits.
    void spendOn(std::uint32_t taker, double priceBefore) {
        const Refinement& r = tree_.nodes[taker];
        float& waited = state_.waited[r.node];
        if (r.isNew) {
            const std::size_t first = tree_.nodes.size();
            expand(taker);
            for (std::size_t c = first; c < tree_.nodes.size(); ++c) tree_.nodes[c].isNew = true;
            offerFrom(first);
            return;
        }
        const double haste = glaring(r) * r.value / std::max(kLeastPrice, s_.exchangeFactor * priceBefore);
        waited += static_cast<float>(in_.dtSeconds * std::clamp(haste, 1.0, kMostHaste));
        if (static_cast<double>(waited) >= waitSeconds_ && leftToMake_ > 0) {
            expand(taker);
            --leftToMake_;
        } else {
            refuse(tree_.nodes[taker], BoundBy::hysteresis);
        }
    }

    // It does not, but others may be given up for it that are worth less by enough.
    void considerExchange(std::uint32_t taker) {
        const double missingMs = (marks_.totalMs - marks_.middleMs) / marks_.scale;
        const double ratio = givers_.find(tree_, taker, missingMs, s_.exchangeFactor);
        const bool isWorthIt = ratio > s_.exchangeFactor;
        const double most = patience_ * s_.exchangeWait;
        double waited = static_cast<double>(state_.waited[tree_.nodes[taker].node]);
        waited = isWorthIt ? waited + in_.dtSeconds * glaring(tree_.nodes[taker]) * ratio / s_.exchangeFactor
                           : std::max(0.0, std::min(waited, most) - in_.dtSeconds);
        state_.waited[tree_.nodes[taker].node] = static_cast<float>(waited);
        if (!isWorthIt || (waited < most && !tree_.nodes[taker].isNew)) {
            refuse(tree_.nodes[taker], isWorthIt ? BoundBy::hysteresis : BoundBy::time);
            return;
        }
        for (const std::uint32_t giver : givers_.chosen()) collapse(giver);
        expand(taker);
        for (const std::uint32_t giver : givers_.chosen()) refuse(tree_.nodes[giver], BoundBy::time);
    }

    // At least 1: what is plainly wrong is put right sooner; a switch shows less than that does.
    [[nodiscard]] double glaring(const Refinement& r) const {
        return std::max(1.0, nodeErrorPixels(in_.hierarchy, r.node, in_.view) / s_.waitPixels);
    }
    [[nodiscard]] double extraMs(std::uint32_t i) const { return marks_.scale * tree_.nodes[i].extraMs; }
    void collapse(std::uint32_t i) {
        tree_.collapse(i);
        marks_.totalMs -= extraMs(i);
        state_.setRefined(tree_.nodes[i].node, false);
    }
    // Its children begin coarse, and wait for the next frame.
    void expand(std::uint32_t i) {
        const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.expand(i, in_, state_, selection_);
        marks_.totalMs += extraMs(i);
        state_.setRefined(tree_.nodes[i].node, true);
        for (std::uint32_t c = first; c < tree_.nodes.size(); ++c) {
            state_.setRefined(tree_.nodes[c].node, false);
            state_.seenFrame[tree_.nodes[c].node] = in_.frame;
            if (tree_.nodes[c].usable) refuse(tree_.nodes[c], BoundBy::hysteresis);
        }
    }
    void refuse(Refinement& r, BoundBy reason) {
        r.boundBy = reason;
        r.needMs = marks_.scale * r.extraMs;
        r.hadMs = marks_.middleMs - marks_.totalMs;
        if (reason == BoundBy::time) ++selection_.counters.refusedGroups;
    }

    const SelectInput& in_;
    const SelectSettings& s_;
    SelectState& state_;
    Selection& selection_;
    RefinementTree& tree_;
    FrontbenchMarks marks_;
    double patience_ = 1.0, waitSeconds_ = 0.0;
    std::int64_t leftToMake_ = 0;
    Givers givers_;
};

}  // namespace

void selectFrontbench(const SelectInput& input, SelectState& state, Selection& selection) {
    Trade(input, state, selection).run();
}

}  // namespace fb
