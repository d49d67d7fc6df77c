// Building: a BlockSource becomes a scene folder (thesis ch. 3, algorithms section 1).
// Blocks are built in parallel (oneTBB), each one alone in memory, and written as they finish; a killed build
// is taken up again by the packs that it had finished. A terrain comes last, as a block of its own (build_terrain.h).
#pragma once

#include <filesystem>

#include "base/result.h"
#include "import/source_scene.h"
#include "import/texture_store.h"
#include "scenefile/scene.h"
#include "settings/settings.h"

namespace fb {

// Where the time of building went, in seconds, added up over blocks and so over threads.
struct BuildPhases {
    double load = 0.0, textures = 0.0, simplify = 0.0, errors = 0.0, skirts = 0.0, dress = 0.0, atlas = 0.0,
           encode = 0.0, write = 0.0;

    void add(const BuildPhases& other);
};
struct NamedPhase {
    const char* name;
    double BuildPhases::*seconds;
};
// In the order of the work.
inline constexpr NamedPhase kBuildPhases[] = {
    {"load", &BuildPhases::load},     {"textures", &BuildPhases::textures}, {"simplify", &BuildPhases::simplify},
    {"errors", &BuildPhases::errors}, {"skirts", &BuildPhases::skirts},     {"dress", &BuildPhases::dress},
    {"atlas", &BuildPhases::atlas},   {"encode", &BuildPhases::encode},     {"write", &BuildPhases::write}};

// What happened to the pieces; told to the user and kept in tests.
struct BuildReport {
    std::uint64_t blocks = 0, reusedBlocks = 0, nodes = 0, emptyPieces = 0;
    std::uint64_t stuckNodes = 0;       // simplification stopped at more than 1.5 times its aim
    std::uint64_t sourceTriangles = 0;  // of the blocks, before cutting
    std::uint64_t leafTriangles = 0;    // after cutting
    double sourceAreaSquareMetres = 0.0, leafAreaSquareMetres = 0.0;
    double seconds = 0.0;  // as the clock on the wall goes
    BuildPhases phases;
    TextureStoreCounts textures;
    std::vector<std::string> warnings;

    // Counts, phases and warnings; each warning once.
    void add(BuildReport&& part);
};

// What can be counted of a block, built now or by an earlier build.
[[nodiscard]] BuildReport countsOf(const BuiltBlock& block);

// Builds one block: nodes breadth first with their content. `settings` as validated by the knob gate.
struct BlockBuild {
    BuiltBlock block;             // payload refs not set yet
    std::vector<NodeData> nodes;  // same order as block.nodes
    BuildReport report;
};
[[nodiscard]] Result<BlockBuild> buildBlock(const SourceBlock& source, const BuildSettings& settings,
                                            TextureStore& store);

// Decoded texels that are kept for the blocks to come; beyond, they are decoded again.
inline constexpr std::uint64_t kTextureCacheBytes = std::uint64_t{1} << 30;

// How to build; none of it changes what comes out.
struct BuildResources {
    std::uint64_t textureCacheBytes = kTextureCacheBytes;
    // What the process may take: program, cached textures and the blocks under construction, as estimated
    // (block_memory.h). A block that needs more is built alone, and the report says so. Meshes that were read from files
    // are the caller's. 0: no limit.
    std::uint64_t memoryLimitBytes = 0;
    std::uint32_t threads = 0;  // 0: one a core
};
// Less holds no block worth building.
inline constexpr std::uint64_t kLeastMemoryLimitBytes = 256'000'000;

// Builds every block of `source` into `folder`, the same for any number of threads, parts and bytes. Errors: folder not
// writable, a block that cannot be loaded, stopped by `progress`.
[[nodiscard]] Result<BuildReport> buildScene(const BlockSource& source, const BuildSettings& settings,
                                             const std::filesystem::path& folder, const Progress& progress,
                                             const BuildResources& resources = {});

// Building on several machines that share a folder: each builds one part, any time, and no scene; once all have
// succeeded, one of them joins. The caller holds the folder's lock meanwhile.
struct BuildPart {
    std::uint32_t index = 0, count = 1;
};
[[nodiscard]] Result<BuildReport> buildPart(const BlockSource& source, const BuildSettings& settings,
                                            const std::filesystem::path& folder, const Progress& progress,
                                            const BuildResources& resources, BuildPart part);
// Believes that the packs in the folder are those of these parts; builds the terrain and writes the scene.
[[nodiscard]] Result<BuildReport> joinParts(const BlockSource& source, const BuildSettings& settings,
                                            const std::filesystem::path& folder, const Progress& progress,
                                            const BuildResources& resources);

}  // namespace fb
