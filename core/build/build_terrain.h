// Building the ground: a height map becomes one block of the scene, a quadtree of its own (terrain_layout.h)
// with the same node records and payloads as any block. Comes from BlockSource::terrain(); build_scene calls
// it after the blocks of meshes. Out of core: the map and its picture are read once into work files in the
// scene's folder; squares of some hundred nodes are built in parallel, each kept as a pack of its own in the
// work folder, so that a killed build goes on where it was (the few nodes above them are made again), and
// joined into the block's pack in the end. The same bytes come out whatever the number of threads. Levels are
// those of the quadtree; the error of an inner node is a bound (terrain_error.h), raised to its children's.
#pragma once

#include "build/build_scene.h"
#include "import/terrain_source.h"

namespace fb {

// Raised whenever the same map and settings give other nodes than before.
inline constexpr std::uint64_t kTerrainBuilderVersion = 1;

struct TerrainTask {
    const TerrainSource& source;
    const BuildSettings& settings;
    const std::filesystem::path& folder;  // the scene's
    std::uint32_t pack = 0;               // the number of the block's pack
    std::uint64_t settingsHash = 0;
    std::function<bool(double fraction)> goesOn;  // false stops; called by one thread at a time
};

struct BuiltTerrain {
    BuiltBlock block;
    BuildReport report;
};
// The pack is written when this returns. An error "was stopped" when goesOn() says so.
[[nodiscard]] Result<BuiltTerrain> buildTerrain(const TerrainTask& task);

}  // namespace fb
