// The simulated disk: time in whole nanoseconds, one chunk after the other, the same order and suspension as
// the thread (chunk_order.h). A chunk that has begun is read to its end, whatever is wished meanwhile; an
// idle disk begins when it is next told that time goes on, at the time before that step. Decoding takes no
// time.
#include <algorithm>
#include <cmath>
#include <utility>

#include "load/chunk_order.h"
#include "load/decode_payload.h"
#include "load/finished_queue.h"
#include "load/loader.h"

namespace fb {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
constexpr double kNanosecondsPerMillisecond = 1e6;
constexpr double kNanosecondsPerMicrosecond = 1e3;  // 1 MB/s is 1 byte a microsecond

class ModelLoader final : public Loader {
  public:
    ModelLoader(const Scene& scene, const ModelSettings& model, bool readContent)
        : scene_(scene),
          packs_(scene),
          readContent_(readContent),
          nanosecondsPerByte_(kNanosecondsPerMicrosecond / model.diskMBps),
          latencyNs_(std::llround(model.diskLatencyMs * kNanosecondsPerMillisecond)),
          marks_(scene.hierarchy.size()) {}

    void publish(std::span<const Wish> wishes, const LoadSettings& settings) override {
        wishes_.assign(wishes.begin(), wishes.end());
        chunkBytes_ = chunkBytes(settings);
        marks_.mark(wishes);
        marks_.settle(queue_, wishes_, dropped_);
        for (const FinishedQueue::Entry& entry : dropped_) {
            ++droppedLoads_;
            droppedBytes_ += entry.payloadBytes;
        }
        dropped_.clear();
        fresh_ = true;
    }

    bool take(FinishedLoad& finished, std::uint64_t capBytes) override {
        if (queue_.empty() || queue_.front().residentBytes > capBytes) return false;
        finished = queue_.pop().load;
        if (readContent_) readContentOf(finished);
        return true;
    }

    void advance(double seconds) override {
        if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
        const std::int64_t end = nowNs_ + std::llround(seconds * kNanosecondsPerSecond);
        while (reading_ != kNoNode || begin()) {
            if (chunkEndNs_ > end) break;
            nowNs_ = chunkEndNs_;
            endChunk();
        }
        nowNs_ = end;
    }

    double nowSeconds() const override { return static_cast<double>(nowNs_) / kNanosecondsPerSecond; }

    LoaderCounters counters() const override {
        LoaderCounters counters = order_.counters();
        counters.cancelled += droppedLoads_;
        counters.wastedBytes += droppedBytes_;
        return counters;
    }

  private:
    void readContentOf(FinishedLoad& finished) {
        Result<std::vector<std::uint8_t>> bytes = readPayloadFrom(scene_, packs_, finished.node);
        if (bytes) {
            finished.content = decodePayload(scene_, finished.node, *bytes);
        } else {
            finished.content = passOn(bytes);
            finished.fault = LoadFault::read;
        }
    }

    void adoptFresh() {
        if (!fresh_) return;
        fresh_ = false;
        order_.adopt(wishes_);
    }

    // Begins the next chunk now; false when there is nothing to read or no room for what is finished.
    bool begin() {
        adoptFresh();
        if (!queue_.hasRoom() || !order_.hasWork()) return false;
        StartedLoad& load = order_.choose();
        if (load.filledBytes == 0) load.stamps.firstRead = nowSeconds();
        const PayloadRef& payload = scene_.hierarchy.payload[load.node];
        const std::uint64_t offset = payload.offset + load.filledBytes;
        readingBytes_ = std::min<std::uint64_t>(chunkBytes_, payload.sizeBytes - load.filledBytes);
        const bool follows = order_.moveHead(payload.pack, offset, readingBytes_);
        chunkEndNs_ = nowNs_ + (follows ? 0 : latencyNs_) +
                      std::llround(static_cast<double>(readingBytes_) * nanosecondsPerByte_);
        reading_ = load.node;
        return true;
    }

    void endChunk() {
        const NodeId node = std::exchange(reading_, kNoNode);
        StartedLoad& load = order_.choose();  // still that node: wishes are taken over between chunks only
        load.filledBytes += readingBytes_;
        order_.countRead(readingBytes_);
        const std::uint64_t payloadBytes = scene_.hierarchy.payload[node].sizeBytes;
        if (load.filledBytes < payloadBytes) return;
        load.stamps.read = load.stamps.decoded = nowSeconds();
        adoptFresh();
        if (!order_.isStarted(node)) return;
        queue_.push({{node, nullptr, order_.release(node).stamps}, scene_.hierarchy.residentBytes[node], payloadBytes});
    }

    const Scene& scene_;
    ScenePacks packs_;
    const bool readContent_;
    const double nanosecondsPerByte_;
    const std::int64_t latencyNs_;

    std::int64_t nowNs_ = 0;
    NodeId reading_ = kNoNode;  // the chunk under way
    std::uint64_t readingBytes_ = 0;
    std::int64_t chunkEndNs_ = 0;
    std::uint64_t chunkBytes_ = 1;
    ChunkOrder order_;
    std::vector<Wish> wishes_;
    bool fresh_ = false;
    FinishedQueue queue_;
    WishMarks marks_;
    std::vector<FinishedQueue::Entry> dropped_;
    std::uint64_t droppedLoads_ = 0, droppedBytes_ = 0;
};

}  // namespace

std::unique_ptr<Loader> makeModelLoader(const Scene& scene, const ModelSettings& model, bool readContent) {
    return std::make_unique<ModelLoader>(scene, model, readContent);
}

}  // namespace fb
