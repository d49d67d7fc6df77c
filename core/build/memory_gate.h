// Lets so much work in at a time that its memory stays within a limit. Used by make_blocks, one request a
// block.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace fb {

class MemoryGate {
  public:
    // 0: no limit.
    explicit MemoryGate(std::uint64_t limitBytes) : limit_(limitBytes) {}

    // Held while the work goes on.
    class Pass {
      public:
        Pass(Pass&& other) noexcept : gate_(other.gate_), bytes_(other.bytes_) { other.gate_ = nullptr; }
        Pass& operator=(Pass&&) = delete;
        ~Pass() {
            if (gate_ != nullptr) gate_->leave(bytes_);
        }

      private:
        friend class MemoryGate;
        Pass(MemoryGate& gate, std::uint64_t bytes) : gate_(&gate), bytes_(bytes) {}
        MemoryGate* gate_;
        std::uint64_t bytes_;
    };

    // Waits, first come first served, until `bytes` fit beside what is inside. What is larger than the limit
    // waits until nothing else is inside, and is let in: a build goes on.
    [[nodiscard]] Pass enter(std::uint64_t bytes);

    [[nodiscard]] std::uint64_t limitBytes() const { return limit_; }
    // The most that was inside at one time.
    [[nodiscard]] std::uint64_t peakBytes() const;

  private:
    void leave(std::uint64_t bytes);

    std::uint64_t limit_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::uint64_t insideBytes_ = 0, peakBytes_ = 0;
    std::uint64_t inside_ = 0, nextTicket_ = 0, serving_ = 0;
};

}  // namespace fb
