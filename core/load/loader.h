// Loaders: wishes in, finished nodes out (thesis 4.3, Incremental Pre-fetching). Between two chunks the
// loader looks at the wishes again; a more urgent node suspends the one under way, whose bytes are kept. Two
// kinds behind one interface: a thread of low priority that reads the disk, and a simulated disk that runs on
// model time and gives the same result on every machine.
//
// Threads: everything in this header is called on the main thread. The loader thread sees the scene (const),
// the payload source, and what passes through its one hand-over point (loader_thread.cpp); never Residency,
// never the GPU.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "base/result.h"
#include "load/payload_source.h"
#include "load/plan_loads.h"
#include "scenefile/scene.h"

namespace fb {

// Of one load, in seconds of Loader::nowSeconds(); not a number: it did not come so far.
struct LoadStamps {
    double firstRead = std::numeric_limits<double>::quiet_NaN(), read = firstRead, decoded = firstRead;
    std::uint32_t suspensions = 0;  // how often it stepped back for a more urgent one
};

class LoadTimeline;

struct FinishedLoad {
    NodeId node = kNoNode;
    Result<std::unique_ptr<DecodedNode>> content;  // null content: the null device needs none
    LoadStamps stamps{};
    LoadFault fault = LoadFault::content;  // where content is an error
};

struct LoaderCounters {
    std::uint64_t suspended = 0;  // a load under way stepped back for a more urgent one
    std::uint64_t cancelled = 0;  // loads begun or finished whose wish was withdrawn
    std::uint64_t bytesRead = 0;
    std::uint64_t wastedBytes = 0;  // of bytesRead, for cancelled loads
    std::uint64_t seeks = 0;        // chunks that did not follow the one before on disk
};

class Loader {
  public:
    virtual ~Loader() = default;
    // Never blocks: replaces the wishes. A node under way that is no longer wished for is cancelled and its
    // bytes are dropped; one that is wished for with less priority is suspended.
    virtual void publish(std::span<const Wish> wishes, const LoadSettings& settings) = 0;
    // Never blocks: the next finished load that is still wished for, if it takes at most `capBytes` in memory
    // (a failed one takes none); or false, also when the loader is just handing something over: ask again in
    // the next frame.
    [[nodiscard]] virtual bool take(FinishedLoad& finished, std::uint64_t capBytes) = 0;
    // Model time goes on; nothing for the thread.
    virtual void advance(double seconds) = 0;
    [[nodiscard]] virtual LoaderCounters counters() const = 0;
    // The clock of the stamps: since the loader began, as it is where loads are made.
    [[nodiscard]] virtual double nowSeconds() const = 0;
};

// Starts the thread; the destructor stops and joins it, within one chunk or one node's decoding. `scene` must
// outlive it. `source`: null for the scene's packs.
[[nodiscard]] std::unique_ptr<Loader> startLoaderThread(const Scene& scene,
                                                        std::unique_ptr<PayloadSource> source = nullptr);

// A chunk takes diskLatencyMs where it does not follow the one before on disk, and its bytes at diskMBps
// (10^6 bytes). `readContent`: finished nodes carry what is on the real disk (for pictures), else null.
[[nodiscard]] std::unique_ptr<Loader> makeModelLoader(const Scene& scene, const ModelSettings& model,
                                                      bool readContent);

// One frame of the main thread's side: takes finished loads within the budgets of bytes and time, one node at least
// whatever its size, and makes them resident; a null content is uploaded as an empty one. Returns the bytes
// made resident. A node that failed to load or to upload is tried again after 0.5 s, 1 s and 2 s, then given
// up for good (residency.h); its parent stays drawn. `onFault` hears each failed try once.
struct UploadInput {
    const Hierarchy& hierarchy;
    const LoadSettings& settings;
    double nowSeconds;
    std::function<void(const Error&)> onFault;
    double limitMs = 0.0;  // of this machine's time; 0: no limit, as model time must not depend on it
    LoadTimeline* timeline = nullptr;  // hears of uploads and failures, where there is one
};
std::uint64_t takeFinishedLoads(const UploadInput& input, Loader& loader, NodeDevice& device,
                                Residency& residency);

// Loads all roots before the first frame (thesis 4.2, Initialization). The error names the node; then nothing
// is resident.
[[nodiscard]] Result<void> loadRoots(const Scene& scene, NodeDevice& device, Residency& residency,
                                     bool readContent);

}  // namespace fb
