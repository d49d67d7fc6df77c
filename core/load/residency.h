// Which nodes are in memory: states, bytes, and the device that holds the content (thesis 4.3, algorithms
// section 4). Comes from the root load, then changed by planLoads and takeFinishedLoads; the selection reads
// `loaded` and `memoryRefused`. Owned and changed by the main thread alone; the loader thread never sees it.
//
//   unloaded --reserve--> wanted --taken from the loader--> ready --uploaded--> resident --evicted-->
//   unloaded wanted, ready --an error--> failedTemporarily --retried--> wanted; the fourth error in a row:
//   failed, for good
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "base/units.h"
#include "scenefile/hierarchy.h"
#include "scenefile/node_data.h"

namespace fb {

enum class NodeState : std::uint8_t { unloaded, wanted, ready, resident, failedTemporarily, failed };

// A node is tried this often; the wait after failure i (1, 2, …) is kFirstRetrySeconds * 2^(i - 1).
inline constexpr int kLoadTries = 4;
inline constexpr double kFirstRetrySeconds = 0.5;

// Holds the content of resident nodes: the GPU, or nothing (tests, model clock without pictures).
class NodeDevice {
  public:
    virtual ~NodeDevice() = default;
    // Main thread. An error (out of memory) leaves the device as it was.
    [[nodiscard]] virtual Result<void> upload(NodeId node, const DecodedNode& content) = 0;
    virtual void release(NodeId node) = 0;
};

class NullDevice final : public NodeDevice {
  public:
    [[nodiscard]] Result<void> upload(NodeId, const DecodedNode&) override { return {}; }
    void release(NodeId) override {}
};

// Where a try to load a node ended: its bytes could not be read, they are damaged or no content that fits the hierarchy,
// or the device did not take it.
enum class LoadFault : std::uint8_t { read, content, upload };
inline constexpr std::size_t kLoadFaultCount = 3;
inline constexpr std::array<std::string_view, kLoadFaultCount> kLoadFaultNames = {"read", "content", "upload"};

// requested = completed + cancelled + failed + in flight, at any time (the roots' first load is not counted).
struct LoadCounters {
    std::uint64_t requested = 0;  // reservations, retries included
    std::uint64_t completed = 0;  // became resident
    std::uint64_t cancelled = 0;  // requests withdrawn, whether or not the loader had begun
    std::uint64_t failed = 0;     // tries that ended in an error: the sum of faults
    std::array<std::uint64_t, kLoadFaultCount> faults{};  // by LoadFault
    std::uint64_t retried = 0;    // of requested: after a fault
    std::uint64_t givenUp = 0;    // nodes that failed for good
    std::uint64_t evicted = 0;    // resident nodes given up
    std::uint64_t suspended = 0;  // loads that stepped back for a more urgent one; the loader's count
    std::uint64_t bytes = 0;      // read from disk; the loader's count
    std::uint64_t seeks = 0;      // chunks that did not follow the one before on disk; the loader's count
};

// What a load may take before it is resident: its payload, and what it is decoded into.
[[nodiscard]] inline std::uint64_t flightBytes(const Hierarchy& hierarchy, NodeId node) {
    return hierarchy.residentBytes[node] + hierarchy.payload[node].sizeBytes;
}

struct Residency {
    std::vector<NodeState> state;
    std::vector<std::uint8_t> loaded;           // 1 where resident: the snapshot that the selection reads
    std::vector<std::uint8_t> memoryRefused;    // 1 where the last plan had no room for it
    std::vector<std::uint32_t> loadedChildren;  // a node with loaded children is never evicted
    std::vector<NodeId> resident;               // in no particular order
    std::vector<NodeId> inFlight;         // wanted or ready: their bytes are reserved; in no particular order
    std::vector<std::uint32_t> position;  // of a resident or in-flight node in its list: removal in O(1)
    std::vector<double> retryAtSeconds;   // failedTemporarily: not before this time
    std::vector<std::uint8_t> failures;   // since the node was last resident
    // Of a node's children, when they were evicted last: when, and for what priority. They come back only when they would not
    // go again for as much (sibling_groups.h).
    std::vector<double> evictedAtSeconds, evictedFor;
    std::uint64_t residentBytes = 0;
    std::uint64_t residentTextureBytes = 0;  // of them: textures with mip levels
    std::uint64_t reservedBytes = 0;  // of inFlight: flightBytes() of each
    std::uint64_t texturedTriangles = 0, untexturedTriangles = 0;  // of resident nodes
    std::uint64_t peakBytes = 0;      // of residentBytes + reservedBytes
    LoadCounters counters;

    void reset(const Hierarchy& hierarchy);
    void setResident(const Hierarchy& hierarchy,
                     NodeId node);  // from ready, wanted or unloaded; moves its bytes
    void setUnloaded(const Hierarchy& hierarchy, NodeId node);  // evicts or gives up; counts nothing
    void reserve(const Hierarchy& hierarchy, NodeId node);      // unloaded or failedTemporarily -> wanted; counts retries
    // wanted or ready -> failedTemporarily, or failed after the last try; counts those given up.
    void setFailed(const Hierarchy& hierarchy, NodeId node, double nowSeconds);

    [[nodiscard]] std::uint64_t totalBytes() const { return residentBytes + reservedBytes; }
    [[nodiscard]] bool isInFlight(NodeId node) const {
        return state[node] == NodeState::wanted || state[node] == NodeState::ready;
    }
};

}  // namespace fb
