#include "load/chunk_order.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace fb {
namespace {

constexpr std::uint64_t kSkippedBytes = 4096;

}  // namespace

std::uint64_t chunkBytes(const LoadSettings& settings) {
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(settings.chunkKiB * 1024.0));
}

void ChunkOrder::adopt(std::vector<Wish>& wishes) {
    const NodeId underWay = current_ == kNone ? kNoNode : wishes_[current_].node;
    wishes_.swap(wishes);
    first_ = 0;
    current_ = kNone;
    for (std::size_t i = 0; i < wishes_.size() && underWay != kNoNode; ++i) {
        if (wishes_[i].node == underWay) current_ = i;
    }
    std::erase_if(started_, [this](const StartedLoad& load) {
        if (isWished(load.node)) return false;
        ++counters_.cancelled;
        counters_.wastedBytes += load.filledBytes;
        return true;
    });
}

bool ChunkOrder::hasWork() {
    while (first_ < wishes_.size() && wishes_[first_].node == kNoNode) ++first_;
    return first_ < wishes_.size();
}

StartedLoad& ChunkOrder::choose() {
    FB_CHECK(hasWork());
    if (current_ == kNone || wishes_[current_].priority < wishes_[first_].priority) {
        if (current_ != kNone) {
            ++counters_.suspended;
            if (StartedLoad* load = findStarted(wishes_[current_].node)) ++load->stamps.suspensions;
        }
        current_ = first_;
    }
    const NodeId node = wishes_[current_].node;
    if (StartedLoad* load = findStarted(node)) return *load;
    started_.push_back({node, 0, {}, {}});
    return started_.back();
}

bool ChunkOrder::moveHead(std::uint32_t pack, std::uint64_t offsetBytes, std::uint64_t bytes) {
    const bool follows = headKnown_ && pack == headPack_ && offsetBytes >= headOffset_ && offsetBytes - headOffset_ < kSkippedBytes;
    if (!follows) ++counters_.seeks;
    headKnown_ = true;
    headPack_ = pack;
    headOffset_ = offsetBytes + bytes;
    return follows;
}

bool ChunkOrder::isWished(NodeId node) const {
    return std::any_of(wishes_.begin() + static_cast<std::ptrdiff_t>(first_), wishes_.end(),
                       [node](const Wish& wish) { return wish.node == node; });
}

bool ChunkOrder::isStarted(NodeId node) const {
    return std::ranges::find(started_, node, &StartedLoad::node) != started_.end();
}

StartedLoad ChunkOrder::release(NodeId node) {
    std::size_t i = first_;
    while (wishes_[i].node != node) ++i;
    wishes_[i].node = kNoNode;
    if (current_ == i) current_ = kNone;
    StartedLoad* const found = findStarted(node);
    FB_CHECK(found != nullptr);
    StartedLoad load = std::move(*found);
    started_.erase(started_.begin() + (found - started_.data()));
    return load;
}

StartedLoad* ChunkOrder::findStarted(NodeId node) {
    for (StartedLoad& load : started_) {
        if (load.node == node) return &load;
    }
    return nullptr;
}

}  // namespace fb
