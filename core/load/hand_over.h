// The one place where the threads of a loader meet: the main thread brings wishes and takes finished loads, one thread
// reads, some decode. One mutex guards all of it. Whoever holds it swaps or moves a few values: reading, decoding and
// freeing happen outside. The main thread only ever tries the lock: the others have a low OS priority and may be off the
// processor while they hold it. What could not be delivered is delivered with the next call.
//
// A load that is being decoded or finished is neither among the wishes nor known to the reading thread; so it is loaded
// again only if it is wished for again after it was taken.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

#include "base/clock.h"
#include "load/chunk_order.h"
#include "load/decode_stage.h"
#include "load/finished_queue.h"

namespace fb {

class HandOver {
  public:
    // --- Main thread ---
    // False where somebody holds the lock: nothing has happened. `marks` knows the wishes. On success `wishes` holds older
    // ones, for their memory, and `dropped` the finished loads that nobody wishes for.
    [[nodiscard]] bool tryDeliver(WishMarks& marks, std::vector<Wish>& wishes, const LoadSettings& settings,
                                  std::size_t decoders, std::vector<FinishedQueue::Entry>& dropped);
    [[nodiscard]] bool tryTake(FinishedLoad& finished, std::uint64_t capBytes);
    void stop();

    // --- Reading thread: `order` is its own, and hears of wishes that have come meanwhile ---
    enum class Work { read, adopted, end };
    struct Pace {
        std::uint64_t chunkBytes = 1;
        double bytesPerSecond = 0.0;  // 0: no limit
    };
    // Waits until there is something to read and room for it, or wishes have been taken over, or the thread must end.
    [[nodiscard]] Work waitForWork(ChunkOrder& order, Pace& pace);
    // Until then, or until the thread must end.
    void sleepUntil(SteadyClock::time_point end);
    // All is read: on to the decoders, unless it is no longer wished for.
    void passOnRead(ChunkOrder& order, NodeId node, std::uint64_t residentBytes);
    // It failed: on to the main thread.
    void passOnFailed(ChunkOrder& order, NodeId node, Error error);

    // --- Decoding threads, numbered from 0; those beyond the number of decoders wait ---
    // Nothing: the thread must end.
    [[nodiscard]] std::optional<DecodeStage::Next> waitForPayload(std::size_t decoder);
    // False where it has been given up meanwhile.
    [[nodiscard]] bool passOnDecoded(FinishedQueue::Entry&& entry);

  private:
    bool adoptFresh(ChunkOrder& order, std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool hasRoom() const;

    std::mutex mutex_;
    std::condition_variable readable_, decodable_;
    std::vector<Wish> incoming_;
    Pace incomingPace_;
    std::size_t decoders_ = 1;
    bool fresh_ = false, stopping_ = false;
    DecodeStage stage_;
    FinishedQueue queue_;
    std::vector<Wish> adopted_;  // the reading thread's
};

}  // namespace fb
