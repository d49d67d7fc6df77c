#include "build/build_scene.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "base/clock.h"
#include "base/folder_lock.h"
#include "build/block_memory.h"
#include "build/build_terrain.h"
#include "build/hash_block.h"
#include "build/make_blocks.h"

namespace fb {
namespace {

// Of a limited memory, so much may hold decoded textures; the rest is for blocks.
constexpr std::uint64_t kTextureShare = 4;

SceneInfo describe(const BlocksTask& task, const BuildReport& report, const std::vector<BuiltBlock>& blocks) {
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
    info.desiredTriangles = static_cast<std::uint64_t>(task.settings.desiredTriangles);
    info.levelFactor = static_cast<std::uint64_t>(task.settings.levelFactor);
    for (const std::filesystem::path& file : source.files) info.sourceFiles.push_back(file.string());
    info.reportLines = source.report.lines();
    info.walks = source.walks;
    return info;
}

tl::unexpected<Error> stopped(const std::filesystem::path& folder) {
    return failure(folder.string(), {}, "the build was stopped",
                   "finished blocks are kept: run it again to go on");
}

// What writers that were killed had begun (AtomicFile). The folder is locked, and nobody else writes into it.
void removeLeftovers(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const std::filesystem::path& where : {folder, folder / "blocks"}) {
        std::vector<std::filesystem::path> leftovers;
        for (const auto& entry : std::filesystem::directory_iterator(where, ignored)) {
            if (entry.path().extension() == ".part") leftovers.push_back(entry.path());
        }
        for (const std::filesystem::path& file : leftovers) std::filesystem::remove(file, ignored);
    }
}

// One building of a scene, or of a part of it.
class SceneBuilder {
  public:
    SceneBuilder(const BlockSource& source, const BuildSettings& settings,
                 const std::filesystem::path& folder, const Progress& progress,
                 const BuildResources& resources, BuildPart part, bool packsAreDone)
        : threads_(tbb::global_control::max_allowed_parallelism, threadsOf(resources)),
          textures_(cacheBytes(resources)),
          task_{source, settings,    folder, hashBuildSettings(settings), textures_, blockBytes(resources),
                part,   packsAreDone},
          gate_(progress,
                std::max<std::size_t>((source.blockCount() + part.count - 1 - part.index) / part.count, 1)) {}

    Result<BuildReport> buildBlocks() {
        gate_.tell("build blocks", 0.0);
        Result<MadeBlocks> made = makeBlocks(task_, gate_);
        if (!made) return passOn(made);
        if (gate_.stopped()) return stopped(task_.folder);
        made_ = std::move(*made);
        return finishReport();
    }

    Result<BuildReport> buildAll() {
        if (Result<BuildReport> blocks = buildBlocks(); !blocks) return blocks;
        if (Result<void> terrain = addTerrain(); !terrain) return passOn(terrain);
        gate_.tell("write scene", 0.0);
        if (gate_.stopped()) return stopped(task_.folder);
        if (made_.report.nodes == 0)
            return failure(task_.source.info().name, {}, "there is no triangle to build a scene from");
        const SceneInfo info = describe(task_, made_.report, made_.blocks);
        if (Result<void> written = writeScene(task_.folder, info, made_.blocks); !written)
            return passOn(written);
        gate_.tell("write scene", 1.0);
        return finishReport();
    }

  private:
    static std::uint64_t shareable(const BuildResources& resources) {
        return std::max(resources.memoryLimitBytes, kLeastMemoryLimitBytes) - kProgramBytes;
    }
    static std::uint64_t cacheBytes(const BuildResources& resources) {
        if (resources.memoryLimitBytes == 0) return resources.textureCacheBytes;
        return std::min(resources.textureCacheBytes, shareable(resources) / kTextureShare);
    }
    static std::uint64_t blockBytes(const BuildResources& resources) {
        return resources.memoryLimitBytes == 0 ? 0 : shareable(resources) - cacheBytes(resources);
    }

    Result<void> addTerrain() {
        const TerrainSource* terrain = task_.source.terrain();
        if (terrain == nullptr) return {};
        const auto goesOn = [&](double fraction) {
            gate_.tell("build terrain", fraction);
            return !gate_.stopped();
        };
        Result<BuiltTerrain> built =
            buildTerrain({*terrain, task_.settings, task_.folder,
                          static_cast<std::uint32_t>(task_.source.blockCount()), task_.settingsHash, goesOn});
        if (!built && gate_.stopped()) return stopped(task_.folder);
        if (!built) return passOn(built);
        made_.report.add(std::move(built->report));
        made_.blocks.push_back(std::move(built->block));
        return {};
    }

    BuildReport finishReport() const {
        BuildReport report = made_.report;
        report.textures = textures_.counts();
        report.seconds = millisecondsSince(start_) / 1000.0;
        return report;
    }

    static std::size_t threadsOf(const BuildResources& resources) {
        const auto cores = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
        return resources.threads == 0 ? cores : resources.threads;
    }

    SteadyClock::time_point start_ = SteadyClock::now();
    tbb::global_control threads_;
    TextureStore textures_;
    BlocksTask task_;
    ProgressGate gate_;
    MadeBlocks made_;
};

}  // namespace

Result<BuildReport> buildScene(const BlockSource& source, const BuildSettings& settings,
                               const std::filesystem::path& folder, const Progress& progress,
                               const BuildResources& resources) {
    if (Result<void> made = makeFolder(folder); !made) return passOn(made);
    Result<FolderLock> lock = FolderLock::take(folder);
    if (!lock) return passOn(lock);
    removeLeftovers(folder);
    return SceneBuilder(source, settings, folder, progress, resources, {}, false).buildAll();
}

Result<BuildReport> buildPart(const BlockSource& source, const BuildSettings& settings,
                              const std::filesystem::path& folder, const Progress& progress,
                              const BuildResources& resources, BuildPart part) {
    if (Result<void> made = makeFolder(folder); !made) return passOn(made);
    return SceneBuilder(source, settings, folder, progress, resources, part, false).buildBlocks();
}

Result<BuildReport> joinParts(const BlockSource& source, const BuildSettings& settings,
                              const std::filesystem::path& folder, const Progress& progress,
                              const BuildResources& resources) {
    removeLeftovers(folder);
    return SceneBuilder(source, settings, folder, progress, resources, {}, true).buildAll();
}

}  // namespace fb
