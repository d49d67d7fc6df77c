// Policy `frontbench`, our own (algorithms section 3): what is drawn stays until something is clearly better. Time that is
// left goes to the refinement with the largest gain for its time, once it has fitted for a while; time that is missing is
// taken from where it brings least; and time changes hands only where it brings several times as much there.
#include <algorithm>

#include "select/givers.h"
#include "select/select_policies.h"

namespace fb {
namespace {

constexpr double kEnterLess = 0.77, kEnterMore = 1.3;  // of the price: what comes into view, refined before or not
constexpr double kLeastWait = 0.03;                    // of refine_wait
constexpr int kFasterWithRoom = 4;
constexpr double kEmergencyMargins = 3.0, kMostHighMark = 1.05;
constexpr double kRestFrom = 2.0, kRestFor = 2.0;  // seconds
constexpr double kUrgent = 4.0;        // times exchange_factor times the price: does not wait
constexpr double kPriceSeconds = 1.0;  // in which the price falls to a third while nobody is refused

class Trade {
  public:
    Trade(const SelectInput& input, SelectState& state, Selection& selection)
        : in_(input), s_(input.settings), state_(state), selection_(selection), tree_(state.tree) {}

    void run() {
        tree_.start(in_, state_, selection_, s_.gainMeasure);
        if (tree_.nodes.empty()) return;
        const double rest = std::clamp((state_.restSeconds - kRestFrom) / kRestFor, 0.0, 1.0);
        patience_ = state_.patience = 1.0 + (s_.restFactor - 1.0) * rest;
        continueFromBefore();
        weighTotal();
        if (tooMuch_) {
            giveBack();
        } else {
            spend();
        }
        tree_.finish(selection_);
    }

  private:
    // Step 2.
    void continueFromBefore() {
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            const NodeId n = tree_.nodes[i].node;
            const bool wasSeen = state_.wasSeen(n, in_.frame);
            state_.seenFrame[n] = in_.frame;
            if (!tree_.nodes[i].usable) {
                set(n, false);
                continue;
            }
            if (!wasSeen) {
                const bool before = state_.refined[n] != 0;
                const double bar = state_.price * (before ? kEnterLess : kEnterMore);
                set(n, state_.price > 0.0 ? tree_.nodes[i].value > bar : before);
            }
            if (state_.refined[n] != 0) tree_.expand(i, in_, state_, selection_);
        }
    }

    // Step 3: over seconds the device is as fast as it was over seconds; in an emergency, as it was just now.
    void weighTotal() {
        const double nowMs = in_.time.fixedMs + tree_.drawnMs();
        totalMs_ = nowMs * in_.time.slowRatio;
        // What the estimate cannot tell from noise must switch nothing.
        const double marginMs = s_.margin * in_.time.residualMs, target = in_.targetMs;
        const auto mark = [&](double of) { return target * (1.0 + patience_ * (of - 1.0)); };
        const double emergencyMs =
            std::max(mark(s_.emergencyMark), target + kEmergencyMargins * patience_ * marginMs);
        if (nowMs > emergencyMs) totalMs_ = std::max(totalMs_, nowMs);
        middleMs_ = target - patience_ * marginMs;
        const double limitMs =
            std::clamp(target + patience_ * marginMs, mark(s_.highMark), mark(std::max(kMostHighMark, s_.highMark)));
        // Time is spent only where it is there over seconds and right now.
        tooMuch_ = totalMs_ > limitMs;
        if (!tooMuch_) totalMs_ = std::max(totalMs_, nowMs);
        scale_ = nowMs > 0.0 ? totalMs_ / nowMs : 1.0;
    }

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
        while (totalMs_ > middleMs_ && !heap.empty()) {
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
        const double unused = middleMs_ > 0.0 ? 1.0 - totalMs_ / middleMs_ : 0.0;
        const double wait = patience_ * s_.refineWait * std::clamp(1.0 - unused / s_.urgency, kLeastWait, 1.0);
        const std::int64_t mostMade = s_.refineRate * (unused > s_.urgency ? kFasterWithRoom : 1);
        const ByValue order{tree_};
        std::vector<std::uint32_t>& heap = state_.heap;
        heap.clear();
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            if (tree_.nodes[i].usable && !tree_.nodes[i].expanded) heap.push_back(i);
        }
        std::ranges::make_heap(heap, order);
        const double priceBefore = state_.price;
        double bestRefused = 0.0;
        std::int64_t made = 0, failed = 0;
        while (!heap.empty()) {
            std::ranges::pop_heap(heap, order);
            const std::uint32_t best = heap.back();
            heap.pop_back();
            // A giver of an exchange takes its children's refinements with it.
            if (!tree_.isReached(tree_.nodes[best])) continue;
            // The search is over, but for what takes no more time.
            if (failed >= s_.refineRate && tree_.nodes[best].extraMs > 0.0) {
                refuse(tree_.nodes[best], BoundBy::time);
                continue;
            }
            float& waited = state_.waited[tree_.nodes[best].node];
            const double value = tree_.nodes[best].value;
            if (extraMs(best) <= 0.0 || totalMs_ + extraMs(best) <= middleMs_) {
                // What brings far more than what was refused last does not wait; nor does anything while nothing is refused.
                const bool isUrgent = patience_ == 1.0 && value > kUrgent * s_.exchangeFactor * priceBefore;
                waited += static_cast<float>(in_.dtSeconds);
                if (isUrgent || (static_cast<double>(waited) >= wait && made < mostMade)) {
                    expand(best);
                    ++made;
                } else {
                    refuse(tree_.nodes[best], BoundBy::hysteresis);
                }
                continue;
            }
            bestRefused = std::max(bestRefused, value);
            considerExchange(best, waited);
            ++failed;
        }
        // It falls slowly: a moment without anybody refused says little.
        state_.price = std::max(bestRefused, priceBefore * kPriceSeconds / (kPriceSeconds + in_.dtSeconds));
    }

    // Where others may be given up for it that are worth less by enough.
    void considerExchange(std::uint32_t taker, float& waited) {
        const double ratio = givers_.find(tree_, taker, (totalMs_ - middleMs_) / scale_, s_.exchangeFactor);
        const bool isWorthIt = ratio > s_.exchangeFactor;
        waited = isWorthIt ? waited + static_cast<float>(in_.dtSeconds * ratio / s_.exchangeFactor)
                           : std::max(0.0f, waited - static_cast<float>(in_.dtSeconds));
        if (!isWorthIt || static_cast<double>(waited) < patience_ * s_.exchangeWait) {
            refuse(tree_.nodes[taker], isWorthIt ? BoundBy::hysteresis : BoundBy::time);
            return;
        }
        for (const std::uint32_t giver : givers_.chosen()) collapse(giver);
        expand(taker);
        for (const std::uint32_t giver : givers_.chosen()) refuse(tree_.nodes[giver], BoundBy::time);
    }

    [[nodiscard]] double extraMs(std::uint32_t i) const { return scale_ * tree_.nodes[i].extraMs; }
    void set(NodeId n, bool refined) {
        state_.refined[n] = refined ? 1 : 0;
        state_.waited[n] = 0.0f;
    }
    void collapse(std::uint32_t i) {
        tree_.collapse(i);
        totalMs_ -= extraMs(i);
        set(tree_.nodes[i].node, false);
    }
    // Its children begin coarse in this frame: one level a frame.
    void expand(std::uint32_t i) {
        const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.expand(i, in_, state_, selection_);
        totalMs_ += extraMs(i);
        set(tree_.nodes[i].node, true);
        for (std::uint32_t c = first; c < tree_.nodes.size(); ++c) {
            set(tree_.nodes[c].node, false);
            state_.seenFrame[tree_.nodes[c].node] = in_.frame;
            if (tree_.nodes[c].usable) refuse(tree_.nodes[c], BoundBy::hysteresis);
        }
    }
    void refuse(Refinement& r, BoundBy reason) {
        r.boundBy = reason;
        r.needMs = scale_ * r.extraMs;
        r.hadMs = middleMs_ - totalMs_;
        if (reason == BoundBy::time) ++selection_.counters.refusedGroups;
    }

    const SelectInput& in_;
    const SelectSettings& s_;
    SelectState& state_;
    Selection& selection_;
    RefinementTree& tree_;
    double totalMs_ = 0.0, middleMs_ = 0.0, scale_ = 1.0, patience_ = 1.0;
    bool tooMuch_ = false;
    Givers givers_;
};

}  // namespace

void selectFrontbench(const SelectInput& input, SelectState& state, Selection& selection) {
    Trade(input, state, selection).run();
}

}  // namespace fb
