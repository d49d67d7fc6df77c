// What the benchmarks prepare: mesh files as `frontbench build` would take them, or the built-in city.
#pragma once

#include <memory>

#include "commands.h"
#include "import/source_scene.h"

namespace fb::bench {

// Of blocks of `options.blockTriangles` triangles and the default city's texels.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> makeCityOf(std::size_t blocks,
                                                              const BenchOptions& options);

[[nodiscard]] Result<std::unique_ptr<BlockSource>> openSource(const BenchOptions& options);

[[nodiscard]] Result<std::vector<SourceBlock>> loadBlocks(const BlockSource& source);

}  // namespace fb::bench
