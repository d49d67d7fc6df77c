// Reading packs back: their frame, their payloads, and reusePack() for a build that was killed.
#include <algorithm>

#include "base/hash.h"
#include "scenefile/byte_stream.h"
#include "scenefile/pack_format.h"

namespace fb {
namespace {

constexpr std::uint64_t kSealBytes = 16;  // length and checksum of the trailer

Result<void> checkPackHeader(const FileReader& pack, std::uint32_t block) {
    std::uint8_t bytes[kPackHeaderBytes];
    if (Result<void> read = pack.readAt(0, bytes); !read) return read;
    ByteReader in(bytes);
    const std::string file = pack.path().string();
    if (!in.isText(kPackMagic)) return failure(file, "header", "is not a pack", "build it again");
    if (const auto version = in.get<std::uint32_t>(); version != kSceneFormatVersion) {
        return failure(file, "header",
                       "made by version " + std::to_string(version) + "; this program reads " +
                           std::to_string(kSceneFormatVersion),
                       "build it again");
    }
    if (const auto number = in.get<std::uint32_t>(); number != block) {
        return failure(file, "header", "is the pack of block " + std::to_string(number), "was it renamed?");
    }
    return {};
}

Result<void> checkPadding(const FileReader& pack, std::uint64_t from, std::uint64_t to) {
    std::uint8_t bytes[kPackAlignment] = {};
    const std::span<std::uint8_t> padding = std::span(bytes).first(to - from);
    if (Result<void> read = pack.readAt(from, padding); !read) return read;
    if (std::ranges::any_of(padding, [](std::uint8_t b) { return b != 0; })) {
        return failure(pack.path().string(), "byte " + std::to_string(from),
                       "there must be zeros between payloads");
    }
    return {};
}

Result<void> checkLayout(const FileReader& pack, std::uint32_t block, const BuiltBlock& built,
                         std::uint64_t end) {
    std::uint64_t offset = kPackHeaderBytes;
    for (std::size_t i = 0; i < built.nodes.size(); ++i) {
        const PayloadRef& ref = built.nodes[i].payload;
        const bool fits =
            ref.pack == block && ref.offset == offset && ref.sizeBytes > 0 && ref.sizeBytes <= end - offset;
        const std::uint64_t next = fits ? alignPayload(offset + ref.sizeBytes) : 0;
        if (!fits || next > end) {
            return failure(pack.path().string(), "node " + std::to_string(i) + " of the block",
                           "its payload is not where it should be");
        }
        if (Result<void> zeros = checkPadding(pack, offset + ref.sizeBytes, next); !zeros) return zeros;
        offset = next;
    }
    if (offset != end)
        return failure(pack.path().string(), "byte " + std::to_string(offset), "belongs to no node");
    return {};
}

}  // namespace

Result<PackSeal> readSeal(const FileReader& pack) {
    PackSeal seal;
    seal.packBytes = pack.sizeBytes();
    const std::string hint = "build it again";
    if (seal.packBytes < kPackHeaderBytes + kSealBytes) {
        return failure(pack.path().string(), {}, "is too short to be a pack", hint);
    }
    std::uint8_t bytes[kSealBytes];
    if (Result<void> read = pack.readAt(seal.packBytes - kSealBytes, bytes); !read) return passOn(read);
    ByteReader in(bytes);
    in.get(seal.trailerBytes);
    in.get(seal.checksum);
    if (seal.trailerBytes < kSealBytes || seal.trailerBytes > seal.packBytes - kPackHeaderBytes) {
        return failure(pack.path().string(), "trailer", "its length is not what it says", hint);
    }
    return seal;
}

Result<PackTrailer> readPackFrame(const FileReader& pack, std::uint32_t block) {
    const Result<PackSeal> seal = readSeal(pack);
    if (!seal) return tl::make_unexpected(seal.error());
    if (Result<void> header = checkPackHeader(pack, block); !header) return passOn(header);
    std::vector<std::uint8_t> bytes(seal->trailerBytes);
    const std::uint64_t start = seal->packBytes - seal->trailerBytes;
    if (Result<void> read = pack.readAt(start, bytes); !read) return passOn(read);
    Result<PackTrailer> trailer = parseTrailer(bytes, pack.path().string());
    if (!trailer) return trailer;
    const Hierarchy alone = joinBlocks({trailer->block});
    if (Result<void> sound = checkHierarchy(alone); !sound) {
        Error error = std::move(sound.error());
        error.file = pack.path().string();
        error.place += " of the block";
        return tl::make_unexpected(std::move(error));
    }
    if (Result<void> layout = checkLayout(pack, block, trailer->block, start); !layout) return passOn(layout);
    return trailer;
}

Result<std::vector<std::uint8_t>> readVerified(const FileReader& pack, const PayloadRef& payload,
                                               const std::string& place) {
    const std::string where = place + " at byte " + std::to_string(payload.offset);
    const std::uint64_t size = pack.sizeBytes();
    if (payload.offset > size || payload.sizeBytes > size - payload.offset) {
        return failure(pack.path().string(), where, "lies beyond the end of the file", "build it again");
    }
    std::vector<std::uint8_t> bytes(payload.sizeBytes);
    if (Result<void> read = pack.readAt(payload.offset, bytes); !read) return passOn(read);
    const std::uint64_t found = hashBytes(bytes.data(), bytes.size());
    if (found != payload.checksum) {
        return failure(
            pack.path().string(), where,
            "checksum does not match: " + hashText(found) + " instead of " + hashText(payload.checksum),
            "the file is damaged: build it again");
    }
    return bytes;
}

std::optional<BuiltBlock> takePack(const std::filesystem::path& sceneFolder, std::uint32_t block,
                                   std::uint64_t settingsHash) {
    Result<FileReader> pack = FileReader::open(sceneFolder / packName(block));
    if (!pack) return std::nullopt;
    Result<PackTrailer> trailer = readPackFrame(*pack, block);
    if (!trailer || trailer->settingsHash != settingsHash) return std::nullopt;
    return std::move(trailer->block);
}

std::optional<BuiltBlock> reusePack(const std::filesystem::path& sceneFolder, std::uint32_t block,
                                    std::uint64_t settingsHash, std::uint64_t blockHash) {
    Result<FileReader> pack = FileReader::open(sceneFolder / packName(block));
    if (!pack) return std::nullopt;
    Result<PackTrailer> trailer = readPackFrame(*pack, block);
    if (!trailer || trailer->settingsHash != settingsHash || trailer->blockHash != blockHash)
        return std::nullopt;
    for (const BuiltNode& node : trailer->block.nodes) {
        if (!readVerified(*pack, node.payload, {})) return std::nullopt;
    }
    return std::move(trailer->block);
}

}  // namespace fb
