// The bounded queue of finished loads between a loader and the main thread, oldest first, and the marks by
// which finished loads and wishes are held against each other. No locks here: the owner says who may call
// what.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "load/decode_stage.h"
#include "load/loader.h"

namespace fb {

class FinishedQueue {
  public:
    static constexpr std::size_t kCapacity = 256;
    static constexpr std::uint64_t kCapacityBytes = std::uint64_t{64} << 20;  // exceeded by one load at most

    struct Entry {
        FinishedLoad load;
        std::uint64_t residentBytes = 0;  // 0 for a failed load
        std::uint64_t payloadBytes = 0;   // read from disk for it
    };

    FinishedQueue() : ring_(kCapacity) {}

    [[nodiscard]] bool empty() const { return count_ == 0; }
    // Also for what is on its way here.
    [[nodiscard]] bool hasRoom(std::size_t coming = 0, std::uint64_t comingBytes = 0) const {
        return count_ + coming < kCapacity && bytes_ + comingBytes < kCapacityBytes;
    }
    void push(Entry&& entry);  // hasRoom() must hold
    [[nodiscard]] const Entry& front() const { return ring_[head_]; }
    [[nodiscard]] Entry pop();

    template <class Remove>
    void removeIf(Remove remove, std::vector<Entry>& into) {
        for (std::size_t left = count_; left > 0; --left) {
            Entry entry = pop();
            if (remove(entry)) {
                into.push_back(std::move(entry));
            } else {
                push(std::move(entry));
            }
        }
    }

  private:
    std::vector<Entry> ring_;
    std::size_t head_ = 0, count_ = 0;
    std::uint64_t bytes_ = 0;
};

// The newest wishes as a set.
class WishMarks {
  public:
    explicit WishMarks(std::size_t nodes) : markedAt_(nodes, 0) {}
    void mark(std::span<const Wish> wishes);

    // Moves finished loads that nobody wishes for any more to `dropped`, gives those up that are being decoded, and takes
    // wishes that are finished or being decoded already out of `wishes` (mark() them first).
    void settle(FinishedQueue& queue, std::vector<Wish>& wishes, std::vector<FinishedQueue::Entry>& dropped,
                DecodeStage* stage = nullptr);

  private:
    [[nodiscard]] bool isMarked(NodeId node) const { return markedAt_[node] == now_; }

    std::vector<std::uint64_t> markedAt_;
    std::uint64_t now_ = 0;
};

}  // namespace fb
