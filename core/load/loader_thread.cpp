// The loader thread.
//
// Hand-over point: `mutex_` guards incoming_, incomingChunkBytes_, fresh_, stopping_ and queue_; nothing else
// is shared but the counters (atomic), the scene (const) and the source. Whoever holds the mutex swaps or
// moves a few values: reading, decoding and freeing happen outside. The main thread only ever tries the lock:
// the loader has a low OS priority and may be off the processor while it holds it. What could not be
// delivered is delivered with the next call. A load that is in the queue is neither in incoming_ nor known to
// the loader; so it is loaded again only if it is wished for again after it was taken.
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "load/chunk_order.h"
#include "load/decode_payload.h"
#include "load/finished_queue.h"
#include "load/loader.h"

namespace fb {
namespace {

constexpr int kNicer = 10, kNicest = 19;

// On Linux a thread has its own nice value. Where it may not be changed, loading is just less polite.
void lowerThreadPriority() {
    const int inherited = getpriority(PRIO_PROCESS, 0);
    static_cast<void>(setpriority(PRIO_PROCESS, 0, std::min(inherited + kNicer, kNicest)));
    static_cast<void>(pthread_setname_np(pthread_self(), "fb-loader"));
}

class ThreadLoader final : public Loader {
  public:
    ThreadLoader(const Scene& scene, std::unique_ptr<PayloadSource> source)
        : scene_(scene),
          source_(source ? std::move(source) : std::make_unique<ScenePacks>(scene)),
          marks_(scene.hierarchy.size()) {
        dropped_.reserve(FinishedQueue::kCapacity);
        thread_ = std::thread([this] { run(); });
    }

    ~ThreadLoader() override {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        changed_.notify_one();
        thread_.join();
    }

    void publish(std::span<const Wish> wishes, const LoadSettings& settings) override {
        if (wishes.empty() && idle_) return;  // do not wake the thread for nothing
        idle_ = false;
        undelivered_.assign(wishes.begin(), wishes.end());
        undeliveredChunkBytes_ = chunkBytes(settings);
        deliversNothing_ = wishes.empty();
        marks_.mark(wishes);
        hasUndelivered_ = true;
        deliver();
    }

    bool take(FinishedLoad& finished, std::uint64_t capBytes) override {
        deliver();
        if (hasUndelivered_) return false;  // the old wishes say nothing about what is taken from now on
        {
            const std::unique_lock lock(mutex_, std::try_to_lock);
            if (!lock || queue_.empty() || queue_.front().residentBytes > capBytes) return false;
            finished = queue_.pop().load;
        }
        changed_.notify_one();  // there is room in the queue
        return true;
    }

    void advance(double) override {}

    double nowSeconds() const override { return millisecondsSince(begun_) / 1000.0; }

    LoaderCounters counters() const override {
        return {suspended_.load(std::memory_order_relaxed),
                cancelled_.load(std::memory_order_relaxed) + droppedLoads_,
                bytesRead_.load(std::memory_order_relaxed),
                wastedBytes_.load(std::memory_order_relaxed) + droppedBytes_,
                seeks_.load(std::memory_order_relaxed)};
    }

  private:
    // --- Main thread ---
    void deliver() {
        if (!hasUndelivered_) return;
        {
            const std::unique_lock lock(mutex_, std::try_to_lock);
            if (!lock) return;
            marks_.settle(queue_, undelivered_, dropped_);
            incoming_.swap(undelivered_);
            incomingChunkBytes_ = undeliveredChunkBytes_;
            fresh_ = true;
        }
        changed_.notify_one();
        hasUndelivered_ = false;
        idle_ = deliversNothing_;
        for (const FinishedQueue::Entry& entry : dropped_) {
            ++droppedLoads_;
            droppedBytes_ += entry.payloadBytes;
        }
        dropped_.clear();
    }

    // --- Loader thread ---
    void run() {
        lowerThreadPriority();
        while (waitForWork()) {
            readOneChunk();
            publishCounters();
        }
    }

    // Takes over wishes that have come meanwhile, with `lock` held; they are examined without it.
    void adoptFresh(std::unique_lock<std::mutex>& lock) {
        while (fresh_) {
            adopted_.swap(incoming_);
            chunkBytes_ = incomingChunkBytes_;
            fresh_ = false;
            lock.unlock();
            order_.adopt(adopted_);
            publishCounters();
            lock.lock();
        }
    }

    // False when the thread must end.
    bool waitForWork() {
        std::unique_lock lock(mutex_);
        while (true) {
            adoptFresh(lock);
            if (stopping_) return false;
            if (queue_.hasRoom() && order_.hasWork()) return true;
            changed_.wait(lock);
        }
    }

    void readOneChunk() {
        StartedLoad& load = order_.choose();
        if (load.filledBytes == 0) load.stamps.firstRead = nowSeconds();
        const PayloadRef& payload = scene_.hierarchy.payload[load.node];
        try {
            load.bytes.resize(payload.sizeBytes);
        } catch (const std::exception& problem) {
            handOver(load, failure({}, nodePlace(load.node), std::string("cannot be read: ") + problem.what()));
            return;
        }
        const std::uint64_t bytes = std::min(chunkBytes_, payload.sizeBytes - load.filledBytes);
        const std::span<std::uint8_t> into(load.bytes.data() + load.filledBytes, bytes);
        static_cast<void>(order_.moveHead(payload.pack, payload.offset + load.filledBytes, bytes));
        if (Result<void> read = source_->readAt(payload.pack, payload.offset + load.filledBytes, into);
            !read) {
            if (read.error().place.empty()) read.error().place = nodePlace(load.node);
            handOver(load, passOn(read));
            return;
        }
        load.filledBytes += bytes;
        order_.countRead(bytes);
        if (load.filledBytes < payload.sizeBytes || isStopping()) return;
        load.stamps.read = nowSeconds();
        Result<std::unique_ptr<DecodedNode>> content = decodePayload(scene_, load.node, load.bytes);
        load.stamps.decoded = nowSeconds();
        handOver(load, std::move(content));
    }

    bool isStopping() {
        const std::lock_guard lock(mutex_);
        return stopping_;
    }

    void handOver(const StartedLoad& load, Result<std::unique_ptr<DecodedNode>> content) {
        const NodeId node = load.node;  // the load itself may go with fresh wishes
        const std::uint64_t residentBytes = content ? scene_.hierarchy.residentBytes[node] : 0;
        FinishedQueue::Entry entry{{node, std::move(content), load.stamps}, residentBytes, load.filledBytes};
        publishCounters();  // before the main thread can see the load
        std::unique_lock lock(mutex_);
        adoptFresh(lock);
        if (!order_.isWished(node)) return;  // cancelled when the wishes were taken over
        queue_.push(std::move(entry));
        lock.unlock();
        order_.finish(node);
    }

    void publishCounters() {
        suspended_.store(order_.counters().suspended, std::memory_order_relaxed);
        cancelled_.store(order_.counters().cancelled, std::memory_order_relaxed);
        bytesRead_.store(order_.counters().bytesRead, std::memory_order_relaxed);
        wastedBytes_.store(order_.counters().wastedBytes, std::memory_order_relaxed);
        seeks_.store(order_.counters().seeks, std::memory_order_relaxed);
    }

    const Scene& scene_;
    const std::unique_ptr<PayloadSource> source_;
    const SteadyClock::time_point begun_ = SteadyClock::now();

    // Main thread.
    std::vector<Wish> undelivered_;
    std::uint64_t undeliveredChunkBytes_ = 1;
    bool hasUndelivered_ = false;
    bool deliversNothing_ = false;  // it is the empty list
    bool idle_ = true;              // the thread has heard last that nothing is wished for
    WishMarks marks_;
    std::vector<FinishedQueue::Entry> dropped_;
    std::uint64_t droppedLoads_ = 0, droppedBytes_ = 0;

    // Hand-over point.
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Wish> incoming_;
    std::uint64_t incomingChunkBytes_ = 1;
    bool fresh_ = false;
    bool stopping_ = false;
    FinishedQueue queue_;
    std::atomic<std::uint64_t> suspended_{0}, cancelled_{0}, bytesRead_{0}, wastedBytes_{0}, seeks_{0};

    // Loader thread.
    ChunkOrder order_;
    std::vector<Wish> adopted_;
    std::uint64_t chunkBytes_ = 1;

    std::thread thread_;
};

}  // namespace

std::unique_ptr<Loader> startLoaderThread(const Scene& scene, std::unique_ptr<PayloadSource> source) {
    return std::make_unique<ThreadLoader>(scene, std::move(source));
}

}  // namespace fb
