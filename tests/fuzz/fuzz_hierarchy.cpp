// The readers of a scene folder on any bytes; the first byte chooses which: hierarchy.bin, a pack's trailer,
// scene.toml. Checksums are put right before parsing, else no mutation would reach the rules behind them.
// What is accepted must keep every rule of checkHierarchy() and give the same bytes again.
#include <cstdlib>
#include <cstring>

#include "base/hash.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/pack_format.h"
#include "scenefile/scene_toml.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::size_t at, std::uint64_t value) {
    std::memcpy(&bytes[at], &value, sizeof value);
}

void fuzzHierarchy(Bytes bytes) {
    if (bytes.size() < fb::kHierarchyHeaderBytes) return;
    std::memcpy(bytes.data(), "fbscene\n", 8);
    std::memcpy(&bytes[8], &fb::kSceneFormatVersion, 4);
    // As many nodes as there are bytes for; the number of blocks is the fuzzer's.
    const std::size_t tables = bytes.size() - fb::kHierarchyHeaderBytes;
    const std::size_t blocks = bytes[12];
    const std::size_t blockBytes = blocks * fb::kBlockRecordBytes;
    if (blockBytes > tables) return;
    const std::size_t nodes = (tables - blockBytes) / fb::kNodeRecordBytes;
    bytes.resize(fb::kHierarchyHeaderBytes + blockBytes + nodes * fb::kNodeRecordBytes);
    const std::uint32_t counts[3] = {static_cast<std::uint32_t>(blocks), static_cast<std::uint32_t>(nodes),
                                     0};
    std::memcpy(&bytes[12], counts, sizeof counts);
    const std::uint8_t* first = bytes.data() + fb::kHierarchyHeaderBytes;
    put(bytes, 24, fb::hashBytes(first, blockBytes));
    put(bytes, 32, fb::hashBytes(first + blockBytes, nodes * fb::kNodeRecordBytes));
    put(bytes, 40, fb::hashBytes(bytes.data(), 40));
    const fb::Result<fb::HierarchyFile> file = fb::parseHierarchyFile(bytes, "fuzz");
    if (!file) return;
    if (!fb::checkHierarchy(file->hierarchy) || fb::encodeHierarchyFile(*file) != bytes) std::abort();
}

void fuzzTrailer(Bytes bytes) {
    if (bytes.size() < fb::kLeastTrailerBytes) return;
    const std::size_t nodes =
        (bytes.size() - (fb::kLeastTrailerBytes - fb::kBuiltNodeBytes)) / fb::kBuiltNodeBytes;
    bytes.resize(fb::kLeastTrailerBytes - fb::kBuiltNodeBytes + nodes * fb::kBuiltNodeBytes);
    std::memcpy(bytes.data(), fb::kTrailerMagic.data(), 8);
    put(bytes, 64, nodes);
    put(bytes, bytes.size() - 16, bytes.size());
    put(bytes, bytes.size() - 8, fb::hashBytes(bytes.data(), bytes.size() - 8));
    const fb::Result<fb::PackTrailer> trailer = fb::parseTrailer(bytes, "fuzz");
    if (!trailer) return;
    (void)fb::checkHierarchy(fb::joinBlocks({trailer->block}));  // must not stop on a parsed trailer
    if (fb::encodeTrailer(*trailer) != bytes) std::abort();
}

void fuzzToml(const Bytes& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const fb::Result<fb::SceneToml> scene = fb::parseSceneToml(text, "fuzz");
    if (!scene) return;
    fb::Hierarchy hierarchy;
    hierarchy.resize(1);
    hierarchy.rootCount = 1;
    if (!fb::parseSceneToml(fb::sceneTomlText(*scene, hierarchy).value(), "again")) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const Bytes bytes(data + 1, data + size);
    switch (data[0] % 3) {
        case 0:
            fuzzHierarchy(bytes);
            break;
        case 1:
            fuzzTrailer(bytes);
            break;
        default:
            fuzzToml(bytes);
    }
    return 0;
}
