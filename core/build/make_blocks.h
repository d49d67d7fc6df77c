// Makes the packs of a scene's blocks, or of one part of them, in parallel (oneTBB): as many blocks are in
// memory as there are threads, and no more than the memory limit lets in. What an earlier build finished is
// taken over. Used by build_scene; calls build_block.
#pragma once

#include "build/build_scene.h"
#include "build/progress_gate.h"

namespace fb {

struct BlocksTask {
    const BlockSource& source;
    const BuildSettings& settings;
    const std::filesystem::path& folder;
    std::uint64_t settingsHash = 0;
    TextureStore& textures;
    std::uint64_t memoryLimitBytes = 0;  // for blocks, without the store; 0: none
    BuildPart part;                      // blocks index, index + count, ...
    bool packsAreDone = false;           // and are of this source: they are taken unread
};

// The same for any number of threads.
struct MadeBlocks {
    std::vector<BuiltBlock> blocks;  // in the order of the source
    BuildReport report;
};
// Ends early once the gate is stopped; whether it was is for the caller to ask.
[[nodiscard]] Result<MadeBlocks> makeBlocks(const BlocksTask& task, ProgressGate& gate);

}  // namespace fb
