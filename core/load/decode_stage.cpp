#include "load/decode_stage.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace fb {

bool DecodeStage::hasWaiting() const {
    return std::ranges::any_of(entries_, [](const Entry& entry) { return !entry.decoding; });
}

void DecodeStage::push(StartedLoad&& load, std::uint64_t residentBytes) {
    entries_.push_back({std::move(load), residentBytes, false, true});
    residentBytes_ += residentBytes;
}

DecodeStage::Next DecodeStage::start() {
    std::size_t i = 0;
    while (i < entries_.size() && entries_[i].decoding) ++i;
    FB_CHECK(i < entries_.size());
    if (!entries_[i].wanted) return {remove(i).load, false};
    Entry& entry = entries_[i];
    entry.decoding = true;
    Next next{std::move(entry.load), true};
    entry.load.node = next.load.node;  // what the wishes are held against
    return next;
}

bool DecodeStage::finish(NodeId node) {
    std::size_t i = 0;
    while (i < entries_.size() && !(entries_[i].decoding && entries_[i].load.node == node)) ++i;
    FB_CHECK(i < entries_.size());
    return remove(i).wanted;
}

DecodeStage::Entry DecodeStage::remove(std::size_t index) {
    Entry entry = std::move(entries_[index]);
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(index));
    residentBytes_ -= entry.residentBytes;
    return entry;
}

}  // namespace fb
