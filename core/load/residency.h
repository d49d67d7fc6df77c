// Which nodes are in memory: states, bytes, and the device that holds the content. Owned and changed by the main thread
// alone; the loader thread never sees it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "scenefile/hierarchy.h"
#include "scenefile/node_data.h"

namespace fb {

enum class NodeState : std::uint8_t { unloaded, wanted, ready, resident, failedTemporarily, failed };

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

struct LoadCounters {
    std::uint64_t requested = 0, completed = 0, suspended = 0, cancelled = 0, evicted = 0, bytes = 0, failed = 0;
};

struct Residency {
    std::vector<NodeState> state;
    std::vector<std::uint8_t> loaded;         // 1 where resident: the snapshot that the selection reads
    std::vector<std::uint8_t> memoryRefused;  // 1 where the last plan had no room for it
    std::vector<std::uint32_t> loadedChildren;  // a node with loaded children is never evicted
    std::vector<NodeId> resident;             // in no particular order
    std::vector<NodeId> inFlight;             // wanted or ready: their bytes are reserved
    std::vector<double> retryAtSeconds;       // failedTemporarily: not before this time
    std::vector<std::uint8_t> failures;
    std::uint64_t residentBytes = 0;
    std::uint64_t reservedBytes = 0;          // of inFlight
    std::uint64_t peakBytes = 0;              // of residentBytes + reservedBytes
    LoadCounters counters;

    void reset(const Hierarchy& hierarchy);
    void setResident(const Hierarchy& hierarchy, NodeId node);    // from ready or unloaded; moves its bytes
    void setUnloaded(const Hierarchy& hierarchy, NodeId node);    // evicts or gives up; counts nothing
    void reserve(const Hierarchy& hierarchy, NodeId node);        // unloaded -> wanted
    [[nodiscard]] std::uint64_t totalBytes() const { return residentBytes + reservedBytes; }
};

}  // namespace fb
