// Runs work in a forked child, so that its peak of resident memory and its processor time are its own. The
// caller has no threads yet and holds little memory: a child starts from what its parent has.
#pragma once

#include <cstdint>
#include <functional>

#include "base/result.h"
#include "build/build_scene.h"

namespace fb::bench {

// What of a build crosses the pipe: plain numbers only.
struct BuildNumbers {
    std::uint64_t blocks = 0, nodes = 0, triangles = 0;
    std::uint64_t textures = 0, texels = 0;  // of the source, each texture once; where the caller counts them
    double seconds = 0.0;
    BuildPhases phases;
    TextureStoreCounts store;
};

[[nodiscard]] BuildNumbers numbersOf(const BuildReport& report);

struct ApartRun {
    BuildNumbers build;
    double threadSeconds = 0.0;  // user and system, all threads
    double peakMiB = 0.0;
};

[[nodiscard]] Result<ApartRun> runApart(const std::function<Result<BuildNumbers>()>& work);

}  // namespace fb::bench
