// Which payload a loader reads next: the most urgent wish; the one under way goes on until a more urgent one
// appears, then it is suspended and its bytes are kept while it is wished for (thesis 4.3, Incremental
// Pre-fetching). In: wishes. Out: the load that the next chunk belongs to. Used by the loader thread and by
// the simulated disk, each on one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "load/loader.h"

namespace fb {

[[nodiscard]] std::uint64_t chunkBytes(const LoadSettings& settings);  // at least 1

struct StartedLoad {
    NodeId node = kNoNode;
    std::uint64_t filledBytes = 0;
    std::vector<std::uint8_t> bytes;  // stays empty on the simulated disk
    LoadStamps stamps;
};

class ChunkOrder {
  public:
    // Takes over the newest wishes (falling priority) and leaves the old ones in `wishes`, for their memory.
    // What has been started and is no longer wished for is dropped.
    void adopt(std::vector<Wish>& wishes);

    [[nodiscard]] bool hasWork();
    // The load to go on with or to start; hasWork() must hold. Valid until the next call of a member.
    [[nodiscard]] StartedLoad& choose();
    // Chosen, and wished for ever since; what was dropped and is wished for again begins anew.
    [[nodiscard]] bool isStarted(NodeId node) const;
    // A started load has been read, well or not: it is neither wished for nor started any more.
    [[nodiscard]] StartedLoad release(NodeId node);

    // Where a disk's head stands after the chunk that is read next. True where it follows the one before: the padding between
    // two payloads of a pack costs no seek, a disk reads whole blocks, and ahead.
    [[nodiscard]] bool moveHead(std::uint32_t pack, std::uint64_t offsetBytes, std::uint64_t bytes);

    [[nodiscard]] const LoaderCounters& counters() const { return counters_; }
    void countRead(std::uint64_t bytes) { counters_.bytesRead += bytes; }

  private:
    static constexpr std::size_t kNone = ~std::size_t{0};
    [[nodiscard]] StartedLoad* findStarted(NodeId node);
    [[nodiscard]] bool isWished(NodeId node) const;

    std::vector<Wish> wishes_;          // finished ones have kNoNode
    std::size_t first_ = 0;             // no unfinished wish stands before it
    std::size_t current_ = kNone;       // the wish under way
    std::vector<StartedLoad> started_;  // few: the one under way and those suspended
    LoaderCounters counters_;
    bool headKnown_ = false;  // where the chunk before ended
    std::uint32_t headPack_ = 0;
    std::uint64_t headOffset_ = 0;
};

}  // namespace fb
