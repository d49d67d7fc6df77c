// Numbers given to ids, again and again from the start without clearing a table. For the simplifiers' and the error
// measure's own vertex numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "build/block_mesh.h"

namespace fb {

class Numbering {
  public:
    explicit Numbering(std::size_t ids) : numbers_(ids, 0), stamps_(ids, 0) {}

    void restart() { ++stamp_; }
    // The number of `id` since the last restart, or kNone and `next` from now on.
    std::uint32_t findOrSet(std::uint32_t id, std::uint32_t next) {
        if (stamps_[id] == stamp_) return numbers_[id];
        stamps_[id] = stamp_;
        numbers_[id] = next;
        return kNone;
    }

  private:
    std::vector<std::uint32_t> numbers_, stamps_;
    std::uint32_t stamp_ = 0;
};

}  // namespace fb
