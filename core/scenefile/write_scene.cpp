#include "base/hash.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/pack_format.h"
#include "scenefile/scene_toml.h"

namespace fb {
namespace {

Result<StoredPack> sealedPack(const std::filesystem::path& folder, std::uint32_t number) {
    Result<FileReader> pack = FileReader::open(folder / packName(number));
    if (!pack) return passOn(pack);
    Result<PackSeal> seal = readSeal(*pack);
    if (!seal) return passOn(seal);
    return StoredPack{number, seal->packBytes, seal->checksum};
}

}  // namespace

Result<void> writeScene(const std::filesystem::path& folder, const SceneInfo& info,
                        const std::vector<BuiltBlock>& blocks) {
    HierarchyFile file;
    for (const BuiltBlock& block : blocks) {
        if (block.nodes.empty()) continue;
        Result<StoredPack> pack = sealedPack(folder, block.nodes[0].payload.pack);
        if (!pack) return passOn(pack);
        file.packs.push_back(*pack);
    }
    file.hierarchy = joinBlocks(blocks);
    const std::vector<std::uint8_t> bytes = encodeHierarchyFile(file);
    const std::filesystem::path path = folder / "hierarchy.bin";
    // What a reader would refuse is not written.
    if (Result<HierarchyFile> readable = parseHierarchyFile(bytes, path.string()); !readable)
        return passOn(readable);

    const SceneToml about{info, hashBytes(bytes.data(), bytes.size())};
    Result<std::string> text = sceneTomlText(about, file.hierarchy);
    if (!text) return passOn(text);
    if (Result<void> written = writeFileAtomically(folder / "scene.toml", *text); !written) return written;
    return writeFileAtomically(path, bytes);
}

}  // namespace fb
