// Payloads that have been read and wait for a decoder, or are being decoded, oldest first. Comes from the reading
// thread; what is decoded goes to the queue of finished loads. No locks here: the owner says who may call what.
#pragma once

#include <cstdint>
#include <vector>

#include "load/chunk_order.h"

namespace fb {

class DecodeStage {
  public:
    static constexpr std::size_t kAhead = 2;  // read while all decoders are busy

    struct Next {
        StartedLoad load;
        bool wanted = true;  // false: nobody wishes for it any more; it has left the stage
    };

    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    [[nodiscard]] std::uint64_t residentBytes() const { return residentBytes_; }
    [[nodiscard]] bool hasRoom(std::size_t decoders) const { return entries_.size() < decoders + kAhead; }
    [[nodiscard]] bool hasWaiting() const;
    // residentBytes: what it is going to take.
    void push(StartedLoad&& load, std::uint64_t residentBytes);
    // The oldest one that waits, hasWaiting() must hold: from now on it is being decoded, or it has been given up.
    [[nodiscard]] Next start();
    // One that was being decoded leaves. False where it has been given up meanwhile.
    [[nodiscard]] bool finish(NodeId node);

    // The newest wishes: isWished(node) says whether it is among them. What is not is given up, what is again is not.
    template <class IsWished>
    void settle(IsWished isWished) {
        for (Entry& entry : entries_) entry.wanted = isWished(entry.load.node);
    }

  private:
    struct Entry {
        StartedLoad load;  // without bytes once it is being decoded
        std::uint64_t residentBytes = 0;
        bool decoding = false;
        bool wanted = true;
    };
    Entry remove(std::size_t index);

    std::vector<Entry> entries_;  // few
    std::uint64_t residentBytes_ = 0;
};

}  // namespace fb
