// Runs one build, of `frontbench build` or `frontbench city`: in a guarded child process, or under mpirun in one child a
// rank, which share the blocks, and a last one that joins them.
#pragma once

#include <functional>
#include <memory>

#include "app/commands.h"
#include "build/build_scene.h"

namespace fb {

struct BuildJob {
    std::string what;  // names the source in errors
    std::function<Result<std::unique_ptr<BlockSource>>(const Progress&)> openSource;  // called in the child
    BuildSettings settings;
    BuildResources resources;
    std::filesystem::path output;
    ProgressStyle progress = ProgressStyle::automatic;
    bool phases = false;
};
[[nodiscard]] Result<void> runJob(const BuildJob& job);

}  // namespace fb
