#include "load/hand_over.h"

#include <utility>

namespace fb {
namespace {

constexpr double kBytesPerMB = 1e6;

}  // namespace

bool HandOver::tryDeliver(WishMarks& marks, std::vector<Wish>& wishes, const LoadSettings& settings,
                          std::size_t decoders, std::vector<FinishedQueue::Entry>& dropped) {
    {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return false;
        marks.settle(queue_, wishes, dropped, &stage_);
        incoming_.swap(wishes);
        incomingPace_ = {chunkBytes(settings), settings.diskLimitMBps * kBytesPerMB};
        decoders_ = decoders;
        fresh_ = true;
    }
    readable_.notify_one();
    decodable_.notify_all();  // there may be more decoders than before
    return true;
}

bool HandOver::tryTake(FinishedLoad& finished, std::uint64_t capBytes) {
    {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock || queue_.empty() || queue_.front().residentBytes > capBytes) return false;
        finished = queue_.pop().load;
    }
    readable_.notify_one();  // there is room in the queue
    return true;
}

void HandOver::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    readable_.notify_one();
    decodable_.notify_all();
}

// With `lock` held; the wishes are examined without it.
bool HandOver::adoptFresh(ChunkOrder& order, std::unique_lock<std::mutex>& lock) {
    const bool any = fresh_;
    while (fresh_) {
        adopted_.swap(incoming_);
        fresh_ = false;
        lock.unlock();
        order.adopt(adopted_);
        lock.lock();
    }
    return any;
}

bool HandOver::hasRoom() const {
    return stage_.hasRoom(decoders_) && queue_.hasRoom(stage_.size(), stage_.residentBytes());
}

HandOver::Work HandOver::waitForWork(ChunkOrder& order, Pace& pace) {
    std::unique_lock lock(mutex_);
    while (true) {
        if (adoptFresh(order, lock)) return Work::adopted;
        pace = incomingPace_;
        if (stopping_) return Work::end;
        if (hasRoom() && order.hasWork()) return Work::read;
        readable_.wait(lock);
    }
}

void HandOver::sleepUntil(SteadyClock::time_point end) {
    std::unique_lock lock(mutex_);
    readable_.wait_until(lock, end, [this] { return stopping_; });
}

void HandOver::passOnRead(ChunkOrder& order, NodeId node, std::uint64_t residentBytes) {
    {
        std::unique_lock lock(mutex_);
        adoptFresh(order, lock);
        if (!order.isStarted(node)) return;  // cancelled when the wishes were taken over
        stage_.push(order.release(node), residentBytes);
    }
    decodable_.notify_all();  // one alone might be beyond the number of decoders
}

void HandOver::passOnFailed(ChunkOrder& order, NodeId node, Error error) {
    std::unique_lock lock(mutex_);
    adoptFresh(order, lock);
    if (!order.isStarted(node)) return;
    const StartedLoad load = order.release(node);
    queue_.push({{node, tl::make_unexpected(std::move(error)), load.stamps, LoadFault::read}, 0, load.filledBytes});
    lock.unlock();
}

std::optional<DecodeStage::Next> HandOver::waitForPayload(std::size_t decoder) {
    std::optional<DecodeStage::Next> next;
    {
        std::unique_lock lock(mutex_);
        decodable_.wait(lock, [&] { return stopping_ || (decoder < decoders_ && stage_.hasWaiting()); });
        if (stopping_) return {};
        next = stage_.start();
    }
    if (!next->wanted) readable_.notify_one();  // it has left
    return next;
}

bool HandOver::passOnDecoded(FinishedQueue::Entry&& entry) {
    bool wanted = false;
    {
        const std::lock_guard lock(mutex_);
        wanted = stage_.finish(entry.load.node);
        if (wanted) queue_.push(std::move(entry));
    }
    readable_.notify_one();  // there is room for another payload
    return wanted;
}

}  // namespace fb
