#include "build/build_scene.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "base/clock.h"
#include "base/folder_lock.h"
#include "build/build_terrain.h"
#include "build/hash_block.h"

namespace fb {
namespace {

// What became of one block; merged in the order of the blocks, whichever thread made it.
struct FinishedBlock {
    BuiltBlock block;
    BuildReport report;
    std::optional<Error> error;
};

struct SceneTask {
    const BlockSource& source;
    const BuildSettings& settings;
    const std::filesystem::path& folder;
    std::uint64_t settingsHash;
    TextureStore& textures;
};

double areaOf(const SourceMesh& mesh) {
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t.x];
        area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    }
    return area;
}

// What can be said of a block that an earlier build finished.
BuildReport reportReused(const SourceBlock& source, const BuiltBlock& block) {
    BuildReport report;
    report.blocks = report.reusedBlocks = 1;
    report.nodes = block.nodes.size();
    report.sourceTriangles = source.mesh.triangles.size();
    report.sourceAreaSquareMetres = areaOf(source.mesh);
    for (const BuiltNode& node : block.nodes) {
        if (node.childCount > 0) continue;
        report.leafTriangles +=
            std::uint64_t{node.texturedTriangles} + node.untexturedTriangles - node.skirtTriangles;
        report.leafAreaSquareMetres += static_cast<double>(node.areaSquareMetres);
    }
    return report;
}

Result<void> writePack(const SceneTask& task, std::uint32_t index, std::uint64_t blockHash,
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

Result<void> makeBlock(const SceneTask& task, std::uint32_t index, FinishedBlock& into) {
    SteadyClock::time_point start = SteadyClock::now();
    Result<SourceBlock> source = task.source.load(index);
    if (!source) return passOn(source);
    const std::uint64_t blockHash = hashBlock(*source, task.textures);
    const double loadSeconds = secondsSinceLap(start);
    if (std::optional<BuiltBlock> reused = reusePack(task.folder, index, task.settingsHash, blockHash)) {
        into.report = reportReused(*source, *reused);
        into.block = std::move(*reused);
        return {};
    }
    Result<BlockBuild> built = buildBlock(*source, task.settings, task.textures);
    if (!built) return passOn(built);
    start = SteadyClock::now();
    if (!built->nodes.empty()) {
        if (Result<void> written = writePack(task, index, blockHash, *built); !written) return written;
    }
    into.report = std::move(built->report);
    into.report.phases.load += loadSeconds;
    into.report.phases.write += secondsSinceLap(start);
    into.block = std::move(built->block);
    return {};
}

// Tells `progress`, one thread at a time and with fractions that never fall, and remembers when it says stop.
class ProgressGate {
  public:
    ProgressGate(const Progress& progress, std::size_t blocks) : progress_(progress), blocks_(blocks) {}

    [[nodiscard]] bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
    void stop() { stopped_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool stoppedByCaller() const { return stoppedByCaller_; }
    void blockDone() {
        const std::scoped_lock lock(mutex_);
        ++done_;
        tell("build blocks", static_cast<double>(done_) / static_cast<double>(blocks_));
    }
    void tell(std::string_view phase, double fraction) {
        if (!progress_ || stoppedByCaller_ || progress_(phase, fraction)) return;
        stoppedByCaller_ = true;
        stop();
    }

  private:
    const Progress& progress_;
    std::size_t blocks_, done_ = 0;
    std::mutex mutex_;
    std::atomic<bool> stopped_ = false;
    bool stoppedByCaller_ = false;  // under mutex_ while blocks are built
};

void merge(BuildReport& total, BuildReport&& part) {
    total.phases.add(part.phases);
    total.blocks += part.blocks;
    total.reusedBlocks += part.reusedBlocks;
    total.nodes += part.nodes;
    total.emptyPieces += part.emptyPieces;
    total.stuckNodes += part.stuckNodes;
    total.sourceTriangles += part.sourceTriangles;
    total.leafTriangles += part.leafTriangles;
    total.sourceAreaSquareMetres += part.sourceAreaSquareMetres;
    total.leafAreaSquareMetres += part.leafAreaSquareMetres;
    for (std::string& line : part.warnings) {
        if (std::find(total.warnings.begin(), total.warnings.end(), line) == total.warnings.end()) {
            total.warnings.push_back(std::move(line));
        }
    }
}

SceneInfo describe(const SceneTask& task, const BuildReport& report, const std::vector<BuiltBlock>& blocks) {
    const SourceInfo& source = task.source.info();
    SceneInfo info;
    info.name = source.name;
    info.program = std::string("frontbench ") + FB_VERSION;
    info.origin = source.origin;
    info.up = source.up;
    for (const BuiltBlock& block : blocks) {
        if (!block.nodes.empty())
            info.bounds.grow(Box3d{block.nodes[0].bounds.min, block.nodes[0].bounds.max});
    }
    info.sourceTriangles = report.sourceTriangles;
    info.sourceAreaSquareMetres = report.sourceAreaSquareMetres;
    info.sourceHash = source.sourceHash;
    info.buildSettingsHash = task.settingsHash;
    for (const std::filesystem::path& file : source.files) info.sourceFiles.push_back(file.string());
    info.reportLines = source.report.lines();
    info.walks = source.walks;
    return info;
}

}  // namespace

void BuildPhases::add(const BuildPhases& other) {
    for (double BuildPhases::* phase :
         {&BuildPhases::load, &BuildPhases::textures, &BuildPhases::simplify, &BuildPhases::errors, &BuildPhases::skirts,
          &BuildPhases::dress, &BuildPhases::atlas, &BuildPhases::encode, &BuildPhases::write}) {
        this->*phase += other.*phase;
    }
}

Result<BuildReport> buildScene(const BlockSource& source, const BuildSettings& settings,
                               const std::filesystem::path& folder, const Progress& progress,
                               std::uint64_t textureCacheBytes) {
    const SteadyClock::time_point start = SteadyClock::now();
    const std::size_t count = source.blockCount();
    if (Result<void> made = makeFolder(folder); !made) return passOn(made);
    Result<FolderLock> lock = FolderLock::take(folder);
    if (!lock) return passOn(lock);
    TextureStore textures(textureCacheBytes);
    const SceneTask task{source, settings, folder, hashBuildSettings(settings), textures};
    std::vector<FinishedBlock> finished(count);
    ProgressGate gate(progress, std::max<std::size_t>(count, 1));
    gate.tell("build blocks", 0.0);
    // One block a task: as many blocks are in memory as there are threads.
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                if (gate.stopped()) return;
                if (Result<void> made = makeBlock(task, static_cast<std::uint32_t>(i), finished[i]); !made) {
                    finished[i].error = std::move(made.error());
                    gate.stop();
                    return;
                }
                gate.blockDone();
            }
        },
        tbb::simple_partitioner());

    BuildReport report;
    std::vector<BuiltBlock> blocks;
    for (FinishedBlock& block : finished) {
        if (block.error) return tl::make_unexpected(std::move(*block.error));
        merge(report, std::move(block.report));
        blocks.push_back(std::move(block.block));
    }
    if (const TerrainSource* terrain = task.source.terrain(); terrain != nullptr && !gate.stopped()) {
        const auto goesOn = [&](double fraction) {
            gate.tell("build terrain", fraction);
            return !gate.stopped();
        };
        Result<BuiltTerrain> built = buildTerrain({*terrain, settings, folder, static_cast<std::uint32_t>(count),
                                                   task.settingsHash, goesOn});
        if (!built && !gate.stopped()) return passOn(built);
        if (built) {
            merge(report, std::move(built->report));
            blocks.push_back(std::move(built->block));
        }
    }
    if (!gate.stopped()) gate.tell("write scene", 0.0);
    if (gate.stopped()) {
        return failure(folder.string(), {}, "the build was stopped",
                       "finished blocks are kept: run it again to go on");
    }
    if (report.nodes == 0)
        return failure(source.info().name, {}, "there is no triangle to build a scene from");
    if (Result<void> written = writeScene(folder, describe(task, report, blocks), blocks); !written) {
        return passOn(written);
    }
    gate.tell("write scene", 1.0);
    report.textures = textures.counts();
    report.seconds = millisecondsSince(start) / 1000.0;
    return report;
}

}  // namespace fb
