// Parts of a page of fixed size: hands out ranges, takes them back and joins neighbours that are free.
// In: lengths in any unit. Out: offsets in that unit. The first place that fits is taken, so the same calls
// give the same places on every machine and late pages run empty.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace fb {

class RangeAllocator {
  public:
    explicit RangeAllocator(std::uint32_t units = 0);

    // Nothing where no free range is long enough. length > 0.
    [[nodiscard]] std::optional<std::uint32_t> allocate(std::uint32_t length);
    // A range as it was handed out.
    void release(std::uint32_t offset, std::uint32_t length);

    [[nodiscard]] std::uint32_t usedUnits() const { return units_ - freeUnits_; }
    [[nodiscard]] bool empty() const { return freeUnits_ == units_; }
    [[nodiscard]] std::size_t freeRanges() const { return free_.size(); }

  private:
    struct Range {
        std::uint32_t offset, length;
    };
    std::uint32_t units_, freeUnits_;
    std::vector<Range> free_;  // by offset; no two touch
};

}  // namespace fb
