#include "build/build_terrain.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "base/check.h"
#include "base/hash.h"
#include "build/terrain_node.h"
#include "build/terrain_tree.h"
#include "scenefile/pack_format.h"

namespace fb {
namespace {

// Leaves are joined into parts over this many levels, over more where there would be too many parts.
constexpr std::uint32_t kPartLevels = 4, kMostParts = 1024;

// Runs `work(i)` for all i in parallel until one fails or the caller says stop.
class PartRunner {
  public:
    PartRunner(const TerrainTask& task, std::size_t total) : task_(task), total_(total) {}

    template <class Work>
    Result<void> run(std::size_t count, Work&& work) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t i = range.begin(); i < range.end() && !stopped_; ++i) {
                    Result<void> done = work(i);
                    const std::scoped_lock lock(mutex_);
                    if (!done && !fault_) fault_ = std::move(done.error());
                    ++done_;
                    if (fault_ || !tell()) stopped_ = true;
                }
            },
            tbb::simple_partitioner());
        if (fault_) return tl::make_unexpected(*fault_);
        if (stopped_) return failure(task_.folder.string(), {}, "the build was stopped");
        return {};
    }

  private:
    bool tell() const {
        return !task_.goesOn || task_.goesOn(static_cast<double>(done_) / static_cast<double>(total_));
    }

    const TerrainTask& task_;
    std::size_t total_, done_ = 0;
    std::mutex mutex_;
    std::atomic<bool> stopped_ = false;
    std::optional<Error> fault_;
};

// Bounds and errors of parents contain their children's; children stand behind their parents.
void growParents(std::vector<BuiltNode>& nodes) {
    for (std::size_t i = nodes.size(); i-- > 1;) {
        BuiltNode& parent = nodes[nodes[i].parentInBlock];
        parent.bounds.grow(nodes[i].bounds);
        parent.geometricErrorMetres = std::max(parent.geometricErrorMetres, nodes[i].geometricErrorMetres);
    }
}

class TerrainBuilder {
  public:
    explicit TerrainBuilder(const TerrainTask& task)
        : task_(task), info_(task.source.info()), work_(task.folder / "terrain-work") {
        hash_ = Hasher().text("terrain").number(kTerrainBuilderVersion).number(info_.sourceHash).digest();
    }

    Result<BuiltTerrain> run() {
        if (std::optional<BuiltBlock> reused =
                reusePack(task_.folder, task_.pack, task_.settingsHash, hash_)) {
            result_.block = std::move(*reused);
            result_.report = countsOf(result_.block);
            result_.report.reusedBlocks = 1;
            return std::move(result_);
        }
        Result<TerrainGrid> grid = makeTerrainGrid(info_);
        if (!grid) return passOn(grid);
        layout_ = layOutTerrain(info_.columns, info_.rows,
                                static_cast<std::uint64_t>(task_.settings.desiredTriangles));
        if (Result<void> made = makeFolder(work_); !made) return passOn(made);
        Result<TerrainHeights> heights =
            TerrainHeights::make(task_.source, *grid, layout_.sideExponent(0) + 1, work_);
        if (!heights) return passOn(heights);
        Result<TerrainDrape> drape = TerrainDrape::make(task_.source, work_);
        if (!drape) return passOn(drape);
        Result<TerrainTree> tree = makeTerrainTree(*heights, layout_);
        if (!tree) return passOn(tree);
        tree_ = std::move(*tree);
        const TerrainBuild build{*heights, *grid, layout_,
                                 static_cast<std::uint64_t>(task_.settings.desiredTriangles)};
        const TerrainLook look{info_, *drape, task_.settings, leafDrapeLevel(info_, layout_, task_.settings)};
        result_.block.grid = grid->grid;
        result_.block.kind = BlockKind::terrain;
        if (Result<void> built = buildNodes(build, look); !built) return passOn(built);
        if (Result<void> joined = join(); !joined) return passOn(joined);
        result_.report = countsOf(result_.block);
        std::error_code ignored;
        std::filesystem::remove_all(work_, ignored);
        return std::move(result_);
    }

  private:
    // A part: the nodes below one of level partLevel_, breadth first, as numbers of the whole tree.
    [[nodiscard]] std::vector<std::uint32_t> nodesOfPart(std::size_t part) const {
        std::vector<std::uint32_t> nodes{tree_.firstOfLevel[partLevel_] + static_cast<std::uint32_t>(part)};
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const TerrainTree::Node& node = tree_.nodes[nodes[i]];
            for (std::uint32_t c = 0; c < node.childCount; ++c) nodes.push_back(node.firstChild + c);
        }
        return nodes;
    }

    Result<void> buildNodes(const TerrainBuild& build, const TerrainLook& look) {
        partLevel_ = layout_.depth > kPartLevels ? layout_.depth - kPartLevels : 0;
        while (partLevel_ > 0 && tree_.countOfLevel(partLevel_) > kMostParts) --partLevel_;
        const std::uint32_t above = tree_.firstOfLevel[partLevel_], parts = tree_.countOfLevel(partLevel_);
        parts_.resize(parts);
        result_.block.nodes.resize(tree_.nodes.size());
        upper_.resize(above);
        PartRunner runner(task_, parts + std::size_t{above});
        if (Result<void> ran = runner.run(parts, [&](std::size_t i) { return buildPart(build, look, i); });
            !ran)
            return ran;
        return runner.run(above, [&](std::size_t i) -> Result<void> {
            Result<TerrainNode> node = makeTerrainNode(build, look, tree_.nodes[i].tile);
            if (!node) return passOn(node);
            Result<std::vector<std::uint8_t>> payload = encodePayload(node->data);
            if (!payload) return passOn(payload);
            upper_[i] = std::move(*payload);
            result_.block.nodes[i] = node->record;
            return {};
        });
    }

    Result<void> buildPart(const TerrainBuild& build, const TerrainLook& look, std::size_t part) {
        const auto number = static_cast<std::uint32_t>(part);
        const std::uint64_t partHash = Hasher().number(hash_).number(std::uint64_t{number}).digest();
        const std::vector<std::uint32_t> nodes = nodesOfPart(part);
        std::optional<BuiltBlock> block = reusePack(work_, number, task_.settingsHash, partHash);
        if (!block || block->nodes.size() != nodes.size()) {
            Result<BuiltBlock> made = writePart(build, look, nodes, number, partHash);
            if (!made) return passOn(made);
            block = std::move(*made);
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) result_.block.nodes[nodes[i]] = block->nodes[i];
        Result<FileReader> file = FileReader::open(work_ / packName(number));
        if (!file) return passOn(file);
        parts_[part] = std::move(*file);
        return {};
    }

    Result<BuiltBlock> writePart(const TerrainBuild& build, const TerrainLook& look,
                                 const std::vector<std::uint32_t>& nodes, std::uint32_t number,
                                 std::uint64_t partHash) {
        Result<PackWriter> pack = PackWriter::create(work_, number);
        if (!pack) return passOn(pack);
        BuiltBlock block;
        block.grid = result_.block.grid;
        block.kind = BlockKind::terrain;
        std::uint32_t nextChild = 1;
        std::vector<std::uint32_t> parents(nodes.size(), 0);
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const TerrainTree::Node& node = tree_.nodes[nodes[i]];
            for (std::uint32_t c = 0; c < node.childCount; ++c) parents[nextChild++] = i;
            Result<TerrainNode> made = makeTerrainNode(build, look, node.tile);
            if (!made) return passOn(made);
            Result<std::vector<std::uint8_t>> payload = encodePayload(made->data);
            if (!payload) return passOn(payload);
            Result<PayloadRef> ref = pack->append(*payload);
            if (!ref) return passOn(ref);
            made->record.payload = *ref;
            made->record.parentInBlock = parents[i];
            made->record.childCount = node.childCount;
            made->record.level = static_cast<std::uint8_t>(node.tile.level - partLevel_);
            block.nodes.push_back(made->record);
        }
        growParents(block.nodes);
        if (Result<void> finished = pack->finish(block, task_.settingsHash, partHash); !finished)
            return passOn(finished);
        return block;
    }

    // All payloads breadth first into the block's pack.
    Result<void> join() {
        Result<PackWriter> pack = PackWriter::create(task_.folder, task_.pack);
        if (!pack) return passOn(pack);
        std::vector<BuiltNode>& nodes = result_.block.nodes;
        std::vector<std::uint8_t> bytes;
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const TerrainTree::Node& node = tree_.nodes[i];
            if (i >= upper_.size()) {
                const PayloadRef& from = nodes[i].payload;
                bytes.resize(from.sizeBytes);
                if (Result<void> read = parts_[from.pack].readAt(from.offset, bytes); !read) return read;
                if (hashBytes(bytes.data(), bytes.size()) != from.checksum) {
                    return failure(parts_[from.pack].path().string(), "byte " + std::to_string(from.offset),
                                   "checksum does not match", "build it again");
                }
            }
            Result<PayloadRef> ref = pack->append(i < upper_.size() ? upper_[i] : bytes);
            if (!ref) return passOn(ref);
            nodes[i].payload = *ref;
            nodes[i].parentInBlock = node.parent;
            nodes[i].childCount = node.childCount;
            nodes[i].level = static_cast<std::uint8_t>(node.tile.level);
        }
        growParents(nodes);
        // A map has no triangles but those of its leaves.
        const BuildReport counts = countsOf(result_.block);
        result_.block.sourceTriangles = counts.leafTriangles;
        result_.block.sourceAreaSquareMetres = counts.leafAreaSquareMetres;
        return pack->finish(result_.block, task_.settingsHash, hash_);
    }

    const TerrainTask& task_;
    const TerrainInfo& info_;
    std::filesystem::path work_;
    std::uint64_t hash_ = 0;
    TerrainLayout layout_;
    TerrainTree tree_;
    std::uint32_t partLevel_ = 0;
    std::vector<FileReader> parts_;
    std::vector<std::vector<std::uint8_t>> upper_;  // payloads of the nodes above the parts
    BuiltTerrain result_;
};

}  // namespace

Result<BuiltTerrain> buildTerrain(const TerrainTask& task) {
    return TerrainBuilder(task).run();
}

}  // namespace fb
