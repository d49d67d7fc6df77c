// The last frames, in a ring: what the panels draw.
#pragma once

#include <cstddef>
#include <vector>

#include "measure/frame_record.h"

namespace fb {

class History {
  public:
    explicit History(std::size_t capacity = 4096) : ring_(capacity == 0 ? 1 : capacity) {}

    void push(const FrameRecord& record) {
        ring_[next_] = record;
        next_ = (next_ + 1) % ring_.size();
        if (size_ < ring_.size()) ++size_;
    }
    void clear() { next_ = size_ = 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    // 0 is the oldest frame kept, size() - 1 the newest.
    [[nodiscard]] const FrameRecord& operator[](std::size_t i) const {
        return ring_[(next_ + ring_.size() - size_ + i) % ring_.size()];
    }
    [[nodiscard]] const FrameRecord& newest() const { return (*this)[size_ - 1]; }

  private:
    std::vector<FrameRecord> ring_;
    std::size_t next_ = 0, size_ = 0;
};

}  // namespace fb
