#include "open_source.h"

#include "import/city.h"
#include "import/import_files.h"

namespace fb::bench {

Result<std::unique_ptr<BlockSource>> makeCityOf(std::size_t blocks, const BenchOptions& options) {
    CityOptions city;
    const std::uint64_t texelsOfBlock = city.texels / city.blocks;
    city.blocks = blocks;
    city.triangles = blocks * options.blockTriangles;
    city.texels = blocks * texelsOfBlock;
    return makeCity(city);
}

Result<std::unique_ptr<BlockSource>> openSource(const BenchOptions& options) {
    return options.meshes.empty() ? makeCityOf(options.blocks, options)
                                  : importFiles(options.meshes, {}, nullptr);
}

Result<std::vector<SourceBlock>> loadBlocks(const BlockSource& source) {
    std::vector<SourceBlock> blocks;
    for (std::size_t i = 0; i < source.blockCount(); ++i) {
        Result<SourceBlock> block = source.load(i);
        if (!block) return passOn(block);
        blocks.push_back(std::move(*block));
    }
    return blocks;
}

}  // namespace fb::bench
