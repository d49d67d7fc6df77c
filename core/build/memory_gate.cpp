#include "build/memory_gate.h"

#include <algorithm>

namespace fb {

MemoryGate::Pass MemoryGate::enter(std::uint64_t bytes) {
    std::unique_lock lock(mutex_);
    const std::uint64_t ticket = nextTicket_++;
    changed_.wait(lock, [&] {
        return ticket == serving_ && (limit_ == 0 || inside_ == 0 || insideBytes_ + bytes <= limit_);
    });
    ++serving_;
    ++inside_;
    insideBytes_ += bytes;
    peakBytes_ = std::max(peakBytes_, insideBytes_);
    changed_.notify_all();
    return {*this, bytes};
}

void MemoryGate::leave(std::uint64_t bytes) {
    const std::scoped_lock lock(mutex_);
    --inside_;
    insideBytes_ -= bytes;
    changed_.notify_all();
}

std::uint64_t MemoryGate::peakBytes() const {
    const std::scoped_lock lock(mutex_);
    return peakBytes_;
}

}  // namespace fb
