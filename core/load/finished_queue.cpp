#include "load/finished_queue.h"

#include <utility>

#include "base/check.h"

namespace fb {

void FinishedQueue::push(Entry&& entry) {
    FB_CHECK(count_ < kCapacity);
    bytes_ += entry.residentBytes;
    ring_[(head_ + count_) % kCapacity] = std::move(entry);
    ++count_;
}

FinishedQueue::Entry FinishedQueue::pop() {
    FB_CHECK(!empty());
    Entry entry = std::move(ring_[head_]);
    bytes_ -= entry.residentBytes;
    head_ = (head_ + 1) % kCapacity;
    --count_;
    return entry;
}

void WishMarks::mark(std::span<const Wish> wishes) {
    ++now_;
    for (const Wish& wish : wishes) markedAt_[wish.node] = now_;
}

void WishMarks::settle(FinishedQueue& queue, std::vector<Wish>& wishes, std::vector<FinishedQueue::Entry>& dropped,
                       DecodeStage* stage) {
    if (queue.empty() && (stage == nullptr || stage->size() == 0)) return;
    const auto isWished = [this](NodeId node) {
        if (!isMarked(node)) return false;
        markedAt_[node] = 0;
        return true;
    };
    queue.removeIf([&](const FinishedQueue::Entry& entry) { return !isWished(entry.load.node); }, dropped);
    if (stage != nullptr) stage->settle(isWished);
    std::erase_if(wishes, [this](const Wish& wish) { return !isMarked(wish.node); });
}

}  // namespace fb
