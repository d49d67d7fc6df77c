// Loaders: wishes in, finished nodes out (thesis 4.3, Incremental Pre-fetching). Between two chunks the loader looks at
// the wishes again; a more urgent node suspends the one under way, whose bytes are kept.
// Two kinds behind one interface: a thread of low priority that reads the disk, and a simulated disk that runs on model
// time and gives the same result on every machine.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "base/result.h"
#include "load/plan_loads.h"
#include "scenefile/scene.h"

namespace fb {

struct FinishedLoad {
    NodeId node = kNoNode;
    Result<std::unique_ptr<DecodedNode>> content;  // null content: the null device needs none
};

struct LoaderCounters {
    std::uint64_t suspended = 0, cancelled = 0, bytesRead = 0, wastedBytes = 0;
};

class Loader {
  public:
    virtual ~Loader() = default;
    // Main thread, never blocks: replaces the wishes. A node under way that is no longer wished for is cancelled and
    // its bytes are dropped; one that is wished for with less priority is suspended.
    virtual void publish(std::span<const Wish> wishes, const LoadSettings& settings) = 0;
    // Main thread, never blocks: the next finished load that is still wished for, or false.
    [[nodiscard]] virtual bool take(FinishedLoad& finished) = 0;
    // Model time goes on; nothing for the thread.
    virtual void advance(double seconds) = 0;
    [[nodiscard]] virtual LoaderCounters counters() const = 0;
};

// Starts the thread; the destructor stops and joins it. `scene` must outlive it.
[[nodiscard]] std::unique_ptr<Loader> startLoaderThread(const Scene& scene);

// `readContent`: finished nodes carry what is on the real disk (for pictures), else null.
[[nodiscard]] std::unique_ptr<Loader> makeModelLoader(const Scene& scene, const ModelSettings& model, bool readContent);

// One frame of the main thread's side: takes finished loads within the upload budget and makes them resident.
// Returns the bytes uploaded. A failed node is retried with back-off (0.5 s, doubling, 4 tries), then given up for good;
// `onFault` hears each once.
struct UploadInput {
    const Hierarchy& hierarchy;
    const LoadSettings& settings;
    double nowSeconds;
    std::function<void(const Error&)> onFault;
};
std::uint64_t takeFinishedLoads(const UploadInput& input, Loader& loader, NodeDevice& device, Residency& residency);

// Loads all roots before the first frame (thesis 4.2, Initialization).
[[nodiscard]] Result<void> loadRoots(const Scene& scene, NodeDevice& device, Residency& residency, bool readContent);

}  // namespace fb
