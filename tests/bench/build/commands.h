// The commands of bench_build: each measures one side of model preparation and prints a table. All numbers
// but times and memory are the same on every run.
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "settings/settings.h"

namespace fb::bench {

struct BenchOptions {
    std::vector<std::filesystem::path> meshes;  // none: the built-in city
    std::size_t blocks = 4;                     // of that city; scaling: of the largest one
    std::size_t blockTriangles = 44000;         // of each block of that city
    std::size_t samples = 200000;               // points a direction
    std::size_t rounds = 3;                     // of what is timed
    std::size_t copies = 2;                     // a side of the grid
    Settings settings;                          // of which the group "build" counts
};

// Both simplifiers on every level of the same blocks: speed and error.
[[nodiscard]] Result<void> timeSimplifiers(const BenchOptions& options);
// Each level against the source, beside one plain simplification of the whole to as many triangles.
[[nodiscard]] Result<void> compareDeviation(const BenchOptions& options);
// A whole build in multiples of one plain simplification to a quarter; one thread each.
[[nodiscard]] Result<void> compareRatio(const BenchOptions& options);
// Cities of 1, 2, 4, … blocks: time and memory.
[[nodiscard]] Result<void> measureScaling(const BenchOptions& options);
// A grid of copies that share their textures: triangles and texels a second, decoding, memory.
[[nodiscard]] Result<void> measureThroughput(const BenchOptions& options);

}  // namespace fb::bench
