#include <cstdio>
#include <map>

#include "commands.h"
#include "copied_source.h"
#include "open_source.h"
#include "run_apart.h"
#include "worlds/scratch_folder.h"

namespace fb::bench {
namespace {

// Counts each readable texture of the source once; files by their path.
Result<void> countTextures(const BlockSource& source, BuildNumbers& numbers) {
    TextureStore store(kTextureCacheBytes);
    std::map<std::string, std::uint64_t> texels;
    for (std::size_t i = 0; i < source.blockCount(); ++i) {
        Result<SourceBlock> block = source.load(i);
        if (!block) return passOn(block);
        for (const SourceTexture& texture : block->textures) {
            const Result<StoredTexture> stored = store.open(texture);
            if (!stored) continue;
            // Pictures inside a block are its own.
            const std::string key =
                texture.file.empty() ? block->name + '\n' + texture.name : texture.file.string();
            texels[key] = static_cast<std::uint64_t>(stored->header.width) *
                          static_cast<std::uint64_t>(stored->header.height);
        }
    }
    numbers.textures = texels.size();
    for (const auto& [key, count] : texels) numbers.texels += count;
    return {};
}

Result<BuildNumbers> buildCopies(const BenchOptions& options) {
    Result<std::unique_ptr<BlockSource>> source = openSource(options);
    if (!source) return passOn(source);
    BuildNumbers textures;
    if (Result<void> counted = countTextures(**source, textures); !counted) return passOn(counted);
    const std::unique_ptr<BlockSource> copied = copySource(std::move(*source), options.copies);
    const ScratchFolder folder;
    Result<BuildReport> report = buildScene(*copied, options.settings.build, folder.path(), nullptr);
    if (!report) return passOn(report);
    BuildNumbers numbers = numbersOf(*report);
    numbers.textures = textures.textures;
    numbers.texels = textures.texels;
    return numbers;
}

}  // namespace

Result<void> measureThroughput(const BenchOptions& options) {
    Result<ApartRun> run = runApart([&] { return buildCopies(options); });
    if (!run) return passOn(run);
    const BuildNumbers& build = run->build;
    const std::size_t copies = options.copies * options.copies;
    const auto texels = static_cast<double>(build.texels), shown = texels * static_cast<double>(copies);
    const std::string name = options.meshes.empty() ? "city" : options.meshes.front().stem().string();
    std::printf("throughput: %zu x %zu copies of %s, all phases, reading the files left out\n",
                options.copies, options.copies, name.c_str());
    std::printf("%zu blocks, %zu nodes, %zu triangles: %.2f s wall, %.2f s of threads, peak %.0f MiB\n",
                build.blocks, build.nodes, build.triangles, build.seconds, run->threadSeconds, run->peakMiB);
    std::printf("%.0f triangles/s\n", static_cast<double>(build.triangles) / build.seconds);
    std::printf("%.0f texels/s (texels of the source's %zu textures times the copies that show them: %.4g)\n",
                shown / build.seconds, build.textures, shown);
    std::printf(
        "textures: %zu opened, %zu texels decoded of %.0f in the source (each %.3f times), %zu started "
        "over\n",
        build.store.opened, build.store.texelsDecoded, texels,
        texels > 0.0 ? static_cast<double>(build.store.texelsDecoded) / texels : 0.0,
        build.store.startedOver);
    std::printf("phases, thread seconds:");
    for (const auto& [phase, seconds] : kBuildPhases) std::printf(" %s %.2f", phase, build.phases.*seconds);
    std::printf("\n");
    return {};
}

}  // namespace fb::bench
