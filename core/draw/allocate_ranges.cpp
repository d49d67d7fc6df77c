#include "draw/allocate_ranges.h"

#include <algorithm>

#include "base/check.h"

namespace fb {

RangeAllocator::RangeAllocator(std::uint32_t units) : units_(units), freeUnits_(units) {
    if (units > 0) free_.push_back({0, units});
}

std::optional<std::uint32_t> RangeAllocator::allocate(std::uint32_t length) {
    FB_CHECK(length > 0u);
    const auto range = std::ranges::find_if(free_, [&](const Range& r) { return r.length >= length; });
    if (range == free_.end()) return std::nullopt;
    const std::uint32_t offset = range->offset;
    range->offset += length;
    range->length -= length;
    if (range->length == 0) free_.erase(range);
    freeUnits_ -= length;
    return offset;
}

void RangeAllocator::release(std::uint32_t offset, std::uint32_t length) {
    FB_CHECK(length > 0u);
    FB_CHECK(offset <= units_);
    FB_CHECK(length <= units_ - offset);
    const auto after = std::ranges::lower_bound(free_, offset, {}, &Range::offset);
    const bool hasBefore = after != free_.begin();
    if (hasBefore) FB_CHECK((std::prev(after)->offset + std::prev(after)->length) <= offset);
    if (after != free_.end()) FB_CHECK((offset + length) <= after->offset);

    const bool touchesBefore = hasBefore && std::prev(after)->offset + std::prev(after)->length == offset;
    const bool touchesAfter = after != free_.end() && after->offset == offset + length;
    freeUnits_ += length;
    if (touchesBefore && touchesAfter) {
        std::prev(after)->length += length + after->length;
        free_.erase(after);
    } else if (touchesBefore) {
        std::prev(after)->length += length;
    } else if (touchesAfter) {
        after->offset = offset;
        after->length += length;
    } else {
        free_.insert(after, {offset, length});
    }
}

}  // namespace fb
