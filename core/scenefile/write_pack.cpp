#include <array>

#include "base/check.h"
#include "base/hash.h"
#include "scenefile/limits.h"
#include "scenefile/pack_format.h"

namespace fb {
namespace {

Result<void> pad(AtomicFile& file) {
    constexpr std::array<std::uint8_t, kPackAlignment> zeros{};
    return file.write(std::span(zeros).first(alignPayload(file.offset()) - file.offset()));
}

// The block's references must be those that append() gave, in order: reusePack() and checkScene() ask for it.
void checkOwnReferences(const BuiltBlock& block, std::uint32_t pack, std::uint64_t endOfPayloads) {
    std::uint64_t expected = kPackHeaderBytes;
    for (const BuiltNode& node : block.nodes) {
        FB_CHECK(node.payload.pack == pack);
        FB_CHECK(node.payload.offset == expected);
        expected = alignPayload(node.payload.offset + node.payload.sizeBytes);
    }
    FB_CHECK(expected == endOfPayloads);
}

}  // namespace

Result<PackWriter> PackWriter::create(const std::filesystem::path& sceneFolder, std::uint32_t block) {
    const std::filesystem::path path = sceneFolder / packName(block);
    if (block >= kMaxBlocks) {
        return failure(path.string(), {}, "a scene has at most " + std::to_string(kMaxBlocks) + " blocks");
    }
    if (Result<void> made = makeFolder(path.parent_path()); !made) return passOn(made);
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return passOn(file);
    PackWriter writer;
    writer.file_ = std::move(*file);
    writer.block_ = block;
    if (Result<void> written = writer.file_.write(encodePackHeader(block)); !written) return passOn(written);
    return writer;
}

Result<PayloadRef> PackWriter::append(std::span<const std::uint8_t> payload) {
    FB_CHECK(!payload.empty());
    FB_CHECK(payload.size() <= ~std::uint32_t{0});
    PayloadRef ref;
    ref.pack = block_;
    ref.offset = file_.offset();
    ref.sizeBytes = static_cast<std::uint32_t>(payload.size());
    ref.checksum = hashBytes(payload.data(), payload.size());
    if (Result<void> written = file_.write(payload); !written) return passOn(written);
    if (Result<void> padded = pad(file_); !padded) return passOn(padded);
    return ref;
}

Result<void> PackWriter::finish(const BuiltBlock& block, std::uint64_t settingsHash,
                                std::uint64_t blockHash) {
    FB_CHECK(!block.nodes.empty());
    checkOwnReferences(block, block_, file_.offset());
    if (Result<void> written = file_.write(encodeTrailer({settingsHash, blockHash, block})); !written)
        return written;
    return file_.finish();
}

}  // namespace fb
