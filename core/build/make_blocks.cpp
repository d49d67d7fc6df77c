#include "build/make_blocks.h"

#include <oneapi/tbb/parallel_for.h>

#include <optional>

#include "base/clock.h"
#include "build/block_memory.h"
#include "build/hash_block.h"
#include "build/memory_gate.h"

namespace fb {
namespace {

// What became of one block; merged in the order of the blocks, whichever thread made it.
struct FinishedBlock {
    BuiltBlock block;
    BuildReport report;
    std::optional<Error> error;

    void take(BuiltBlock&& reused) {
        report = countsOf(reused);
        block = std::move(reused);
    }
};

Result<void> writePack(const BlocksTask& task, std::uint32_t index, std::uint64_t blockHash,
                       BlockBuild& built) {
    Result<PackWriter> pack = PackWriter::create(task.folder, index);
    if (!pack) return passOn(pack);
    for (std::size_t i = 0; i < built.nodes.size(); ++i) {
        Result<std::vector<std::uint8_t>> payload = encodePayload(built.nodes[i]);
        if (!payload) return passOn(payload);
        Result<PayloadRef> ref = pack->append(*payload);
        if (!ref) return passOn(ref);
        built.block.nodes[i].payload = *ref;
    }
    return pack->finish(built.block, task.settingsHash, blockHash);
}

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

class BlockMaker {
  public:
    explicit BlockMaker(const BlocksTask& task) : task_(task), memory_(task.memoryLimitBytes) {}

    Result<void> make(std::uint32_t index, FinishedBlock& into) {
        if (task_.packsAreDone) {
            if (std::optional<BuiltBlock> done = takePack(task_.folder, index, task_.settingsHash)) {
                into.take(std::move(*done));
                return {};
            }
        }
        SteadyClock::time_point start = SteadyClock::now();
        Result<SourceBlock> source = task_.source.load(index);
        if (!source) return passOn(source);
        const std::uint64_t blockHash = hashBlock(*source, task_.textures);
        const double loadSeconds = secondsSinceLap(start);
        if (std::optional<BuiltBlock> reused =
                reusePack(task_.folder, index, task_.settingsHash, blockHash)) {
            into.take(std::move(*reused));
            into.report.reusedBlocks = 1;
            return {};
        }
        const std::uint64_t bytes =
            task_.memoryLimitBytes > 0 ? estimateBlockBytes(*source, task_.textures) : 0;
        const MemoryGate::Pass pass = memory_.enter(bytes);
        Result<BlockBuild> built = buildBlock(*source, task_.settings, task_.textures);
        if (!built) return passOn(built);
        start = SteadyClock::now();
        if (!built->nodes.empty()) {
            if (Result<void> written = writePack(task_, index, blockHash, *built); !written) return written;
        }
        into.report = std::move(built->report);
        into.report.phases.load += loadSeconds;
        into.report.phases.write += secondsSinceLap(start);
        into.block = std::move(built->block);
        if (task_.memoryLimitBytes > 0 && bytes > task_.memoryLimitBytes) {
            into.report.warnings.push_back("block " + source->name + " takes about " + megabytes(bytes) +
                                           " alone, more than the memory limit leaves for blocks (" +
                                           megabytes(task_.memoryLimitBytes) + "): smaller blocks help");
        }
        return {};
    }

  private:
    const BlocksTask& task_;
    MemoryGate memory_;
};

}  // namespace

Result<MadeBlocks> makeBlocks(const BlocksTask& task, ProgressGate& gate) {
    const std::size_t all = task.source.blockCount();
    std::vector<std::uint32_t> indices;
    for (std::size_t i = task.part.index; i < all; i += task.part.count)
        indices.push_back(static_cast<std::uint32_t>(i));
    std::vector<FinishedBlock> finished(indices.size());
    BlockMaker maker(task);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, indices.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                if (gate.stopped()) return;
                if (Result<void> made = maker.make(indices[i], finished[i]); !made) {
                    finished[i].error = std::move(made.error());
                    gate.stop();
                    return;
                }
                gate.blockDone();
            }
        },
        tbb::simple_partitioner());

    MadeBlocks made;
    for (FinishedBlock& block : finished) {
        if (block.error) return tl::make_unexpected(std::move(*block.error));
        made.report.add(std::move(block.report));
        made.blocks.push_back(std::move(block.block));
    }
    return made;
}

}  // namespace fb
