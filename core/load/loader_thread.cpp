// The loader's threads: one reads, chunk by chunk, some decode. What they share is in HandOver; beside it only the
// counters (atomic), the scene (const) and the source, which the reading thread alone uses.
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <string>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "load/decode_payload.h"
#include "load/hand_over.h"

namespace fb {
namespace {

constexpr int kNicer = 10, kNicest = 19;
constexpr std::size_t kCoresPerDecoder = 2;
constexpr double kLongestChunkSeconds = 10.0;  // however slow the disk shall be

// On Linux a thread has its own nice value. Where it may not be changed, loading is just less polite.
void becomeLoaderThread(const char* name) {
    const int inherited = getpriority(PRIO_PROCESS, 0);
    static_cast<void>(setpriority(PRIO_PROCESS, 0, std::min(inherited + kNicer, kNicest)));
    static_cast<void>(pthread_setname_np(pthread_self(), name));
}

std::size_t decodersFor(const LoadSettings& settings) {
    if (settings.decoders > 0) return static_cast<std::size_t>(settings.decoders);
    return std::max<std::size_t>(1, std::thread::hardware_concurrency() / kCoresPerDecoder);
}

class ThreadLoader final : public Loader {
  public:
    ThreadLoader(const Scene& scene, std::unique_ptr<PayloadSource> source)
        : scene_(scene),
          source_(source ? std::move(source) : std::make_unique<ScenePacks>(scene)),
          marks_(scene.hierarchy.size()) {
        dropped_.reserve(FinishedQueue::kCapacity);
        reader_ = std::thread([this] { read(); });
    }

    ~ThreadLoader() override {
        shared_.stop();
        reader_.join();
        for (std::thread& decoder : decoders_) decoder.join();
    }

    void publish(std::span<const Wish> wishes, const LoadSettings& settings) override {
        if (wishes.empty() && idle_) return;  // do not wake the thread for nothing
        idle_ = false;
        undelivered_.assign(wishes.begin(), wishes.end());
        undeliveredSettings_ = settings;
        deliversNothing_ = wishes.empty();
        marks_.mark(wishes);
        hasUndelivered_ = true;
        while (decoders_.size() < decodersFor(settings)) {
            decoders_.emplace_back([this, number = decoders_.size()] { decode(number); });
        }
        deliver();
    }

    bool take(FinishedLoad& finished, std::uint64_t capBytes) override {
        deliver();
        if (hasUndelivered_) return false;  // the old wishes say nothing about what is taken from now on
        return shared_.tryTake(finished, capBytes);
    }

    void advance(double) override {}

    double nowSeconds() const override { return millisecondsSince(begun_) / 1000.0; }

    LoaderCounters counters() const override {
        const auto of = [](const std::atomic<std::uint64_t>& count) { return count.load(std::memory_order_relaxed); };
        return {of(suspended_), of(cancelled_) + of(givenUp_) + droppedLoads_, of(bytesRead_),
                of(wastedBytes_) + of(givenUpBytes_) + droppedBytes_, of(seeks_)};
    }

  private:
    // --- Main thread ---
    void deliver() {
        if (!hasUndelivered_) return;
        if (!shared_.tryDeliver(marks_, undelivered_, undeliveredSettings_, decodersFor(undeliveredSettings_), dropped_))
            return;
        hasUndelivered_ = false;
        idle_ = deliversNothing_;
        for (const FinishedQueue::Entry& entry : dropped_) {
            ++droppedLoads_;
            droppedBytes_ += entry.payloadBytes;
        }
        dropped_.clear();
    }

    // --- Reading thread ---
    void read() {
        becomeLoaderThread("fb-loader");
        HandOver::Pace pace;
        for (HandOver::Work work; (work = shared_.waitForWork(order_, pace)) != HandOver::Work::end;) {
            if (work == HandOver::Work::read) readOneChunk(pace);
            publishCounters();
        }
    }

    void readOneChunk(const HandOver::Pace& pace) {
        StartedLoad& load = order_.choose();
        const NodeId node = load.node;  // the load itself may go with fresh wishes
        if (load.filledBytes == 0) load.stamps.firstRead = nowSeconds();
        const PayloadRef& payload = scene_.hierarchy.payload[node];
        try {
            load.bytes.resize(payload.sizeBytes);
        } catch (const std::exception& problem) {
            fail(node, {Error::Kind::failed, {}, nodePlace(node), std::string("cannot be read: ") + problem.what(), {}});
            return;
        }
        const std::uint64_t bytes = std::min(pace.chunkBytes, payload.sizeBytes - load.filledBytes);
        const std::span<std::uint8_t> into(load.bytes.data() + load.filledBytes, bytes);
        const SteadyClock::time_point begun = SteadyClock::now();
        static_cast<void>(order_.moveHead(payload.pack, payload.offset + load.filledBytes, bytes));
        if (Result<void> done = source_->readAt(payload.pack, payload.offset + load.filledBytes, into); !done) {
            if (done.error().place.empty()) done.error().place = nodePlace(node);
            fail(node, std::move(done.error()));
            return;
        }
        if (pace.bytesPerSecond > 0.0) {
            const std::chrono::duration<double> least(
                std::min(kLongestChunkSeconds, static_cast<double>(bytes) / pace.bytesPerSecond));
            shared_.sleepUntil(begun + std::chrono::duration_cast<SteadyClock::duration>(least));
        }
        load.filledBytes += bytes;
        order_.countRead(bytes);
        if (load.filledBytes < payload.sizeBytes) return;
        load.stamps.read = nowSeconds();
        publishCounters();  // before the main thread can see the load
        shared_.passOnRead(order_, node, scene_.hierarchy.residentBytes[node]);
    }

    void fail(NodeId node, Error error) {
        publishCounters();
        shared_.passOnFailed(order_, node, std::move(error));
    }

    void publishCounters() {
        suspended_.store(order_.counters().suspended, std::memory_order_relaxed);
        cancelled_.store(order_.counters().cancelled, std::memory_order_relaxed);
        bytesRead_.store(order_.counters().bytesRead, std::memory_order_relaxed);
        wastedBytes_.store(order_.counters().wastedBytes, std::memory_order_relaxed);
        seeks_.store(order_.counters().seeks, std::memory_order_relaxed);
    }

    // --- Decoding threads ---
    void decode(std::size_t number) {
        becomeLoaderThread("fb-decoder");
        while (std::optional<DecodeStage::Next> next = shared_.waitForPayload(number)) {
            if (!next->wanted || !decodeOne(next->load)) {
                givenUp_.fetch_add(1, std::memory_order_relaxed);
                givenUpBytes_.fetch_add(next->load.filledBytes, std::memory_order_relaxed);
            }
        }
    }

    // False where nobody wishes for it any more.
    bool decodeOne(StartedLoad& load) {
        Result<std::unique_ptr<DecodedNode>> content = decodePayload(scene_, load.node, load.bytes);
        load.stamps.decoded = nowSeconds();
        const std::uint64_t residentBytes = content ? scene_.hierarchy.residentBytes[load.node] : 0;
        return shared_.passOnDecoded({{load.node, std::move(content), load.stamps}, residentBytes, load.filledBytes});
    }

    const Scene& scene_;
    const std::unique_ptr<PayloadSource> source_;
    const SteadyClock::time_point begun_ = SteadyClock::now();
    HandOver shared_;
    std::atomic<std::uint64_t> suspended_{0}, cancelled_{0}, bytesRead_{0}, wastedBytes_{0}, seeks_{0};  // of order_
    std::atomic<std::uint64_t> givenUp_{0}, givenUpBytes_{0};  // of the decoders

    // Main thread.
    std::vector<Wish> undelivered_;
    LoadSettings undeliveredSettings_;
    bool hasUndelivered_ = false;
    bool deliversNothing_ = false;  // it is the empty list
    bool idle_ = true;              // the thread has heard last that nothing is wished for
    WishMarks marks_;
    std::vector<FinishedQueue::Entry> dropped_;
    std::uint64_t droppedLoads_ = 0, droppedBytes_ = 0;

    ChunkOrder order_;  // reading thread

    std::thread reader_;
    std::vector<std::thread> decoders_;
};

}  // namespace

std::unique_ptr<Loader> startLoaderThread(const Scene& scene, std::unique_ptr<PayloadSource> source) {
    return std::make_unique<ThreadLoader>(scene, std::move(source));
}

}  // namespace fb
