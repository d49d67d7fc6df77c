#include <sys/resource.h>

#include <algorithm>

#include "base/hash.h"
#include "scenefile/limits.h"
#include "scenefile/open_parts.h"

namespace fb {
namespace {

// Every pack stays open, and the usual soft limit of 1024 files is less than a large scene has blocks. The
// hard limit is the system's word; beyond it the opening itself fails and says so.
void allowOpenFiles(std::size_t packs) {
    constexpr rlim_t kOthers = 256;  // the program's own: libraries, devices, sockets
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    const rlim_t wanted = std::min(limit.rlim_max, static_cast<rlim_t>(packs) + kOthers);
    if (limit.rlim_cur >= wanted) return;
    limit.rlim_cur = wanted;
    ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

Result<void> checkSceneFolder(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (std::filesystem::is_directory(folder, ignored)) return {};
    const bool there = std::filesystem::exists(folder, ignored);
    return failure(folder.string(), {},
                   there ? "is not a scene: a scene is a folder" : "there is no such scene",
                   "frontbench build INPUT... -o OUT.fbscene makes one");
}

Result<SceneToml> readSceneToml(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "scene.toml";
    Result<std::vector<std::uint8_t>> bytes = readFile(path, kMaxSceneTomlBytes);
    if (!bytes) return passOn(bytes);
    return parseSceneToml({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

Result<OpenedHierarchy> readHierarchy(const std::filesystem::path& folder) {
    constexpr std::uint64_t kCap =
        kHierarchyHeaderBytes + kMaxBlocks * kBlockRecordBytes + kMaxNodes * kNodeRecordBytes;
    const std::filesystem::path path = folder / "hierarchy.bin";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return failure(path.string(), {}, "is missing: the scene is not complete",
                       "build it again; the blocks that are finished are kept");
    }
    Result<std::vector<std::uint8_t>> bytes = readFile(path, kCap);
    if (!bytes) return passOn(bytes);
    Result<HierarchyFile> file = parseHierarchyFile(*bytes, path.string());
    if (!file) return passOn(file);
    return OpenedHierarchy{std::move(*file), hashBytes(bytes->data(), bytes->size())};
}

Result<void> checkBelongTogether(const std::filesystem::path& folder, const SceneToml& toml,
                                 const OpenedHierarchy& hierarchy) {
    if (toml.hierarchyHash == hierarchy.hash) return {};
    return failure((folder / "scene.toml").string(), {},
                   "was written with another hierarchy.bin (" + hashText(toml.hierarchyHash) + ", not " +
                       hashText(hierarchy.hash) + ")",
                   "build it again");
}

Result<FileReader> openPack(const std::filesystem::path& folder, const StoredPack& stored) {
    Result<FileReader> pack = FileReader::open(folder / packName(stored.number));
    if (!pack) return pack;
    const std::string file = pack->path().string();
    if (pack->sizeBytes() != stored.sizeBytes) {
        return failure(file, {},
                       "has " + std::to_string(pack->sizeBytes()) + " bytes instead of " +
                           std::to_string(stored.sizeBytes),
                       "the file is damaged or of another build: build it again");
    }
    Result<PackSeal> seal = readSeal(*pack);
    if (!seal) return passOn(seal);
    if (seal->checksum != stored.seal) {
        return failure(file, "trailer",
                       "the seal is " + hashText(seal->checksum) + " instead of " + hashText(stored.seal),
                       "the file is damaged or of another build: build it again");
    }
    return pack;
}

Result<Scene> openScene(const std::filesystem::path& folder) {
    if (Result<void> there = checkSceneFolder(folder); !there) return passOn(there);
    Result<OpenedHierarchy> hierarchy = readHierarchy(folder);
    if (!hierarchy) return passOn(hierarchy);
    Result<SceneToml> toml = readSceneToml(folder);
    if (!toml) return passOn(toml);
    if (Result<void> same = checkBelongTogether(folder, *toml, *hierarchy); !same) return passOn(same);

    Scene scene;
    scene.folder = folder;
    scene.info = std::move(toml->info);
    scene.sceneHash = hierarchy->hash;
    scene.packs.resize(std::size_t{hierarchy->file.packs.back().number} + 1);
    allowOpenFiles(hierarchy->file.packs.size());
    for (const StoredPack& stored : hierarchy->file.packs) {
        Result<FileReader> pack = openPack(folder, stored);
        if (!pack) return passOn(pack);
        scene.packs[stored.number] = std::move(*pack);
    }
    scene.hierarchy = std::move(hierarchy->file.hierarchy);
    return scene;
}

Result<std::vector<std::uint8_t>> readPayload(const Scene& scene, NodeId node) {
    const PayloadRef& payload = scene.hierarchy.payload[node];
    return readVerified(scene.packs[payload.pack], payload, "node " + std::to_string(node));
}

}  // namespace fb
