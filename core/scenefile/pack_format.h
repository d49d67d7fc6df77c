// The bytes of a pack, blocks/NNNNN.pack:
//   header   magic, version, block number (16 bytes)
//   payloads in breadth-first order, each at a multiple of 8 bytes, gaps filled with zeros
//   trailer  magic, settings hash, block hash, grid, kind of block, triangles and area of
//            its source, node count, node records, then length and
//   checksum of the trailer
// The trailer is what makes a pack whole: a killed build takes up packs that have one. Its checksum, the
// file's last 8 bytes, covers the payloads' checksums and so stands for the whole pack; hierarchy.bin keeps
// it as the pack's seal.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_io.h"
#include "scenefile/scene.h"

namespace fb {

inline constexpr std::string_view kPackMagic = "fbpack\r\n";
inline constexpr std::string_view kTrailerMagic = "fbtrail\n";
inline constexpr std::uint32_t kPackHeaderBytes = 16;
inline constexpr std::uint32_t kPackAlignment = 8;
inline constexpr std::uint32_t kBuiltNodeBytes = 112;
inline constexpr std::uint32_t kLeastTrailerBytes = 104 + kBuiltNodeBytes;  // of a block with one node

struct PackTrailer {
    std::uint64_t settingsHash = 0, blockHash = 0;
    BuiltBlock block;
};

// The sealed end of a pack, as found on disk.
struct PackSeal {
    std::uint64_t packBytes = 0;
    std::uint64_t trailerBytes = 0;
    std::uint64_t checksum = 0;
};

[[nodiscard]] constexpr std::uint64_t alignPayload(std::uint64_t offset) {
    return (offset + kPackAlignment - 1) / kPackAlignment * kPackAlignment;
}

// "blocks/00003.pack".
[[nodiscard]] std::filesystem::path packName(std::uint32_t block);

[[nodiscard]] std::vector<std::uint8_t> encodePackHeader(std::uint32_t block);
[[nodiscard]] std::vector<std::uint8_t> encodeTrailer(const PackTrailer& trailer);

// Structure only: a parsed trailer's nodes are in breadth-first order and may be given to joinBlocks().
[[nodiscard]] Result<PackTrailer> parseTrailer(std::span<const std::uint8_t> bytes, const std::string& what);

// Reads the last bytes of a pack; an error when it is not whole.
[[nodiscard]] Result<PackSeal> readSeal(const FileReader& pack);

// Everything but the payloads: header, trailer with its checksum, structure of the block, and that the
// payloads fill the pack from its header to its trailer in order, with zeros between.
[[nodiscard]] Result<PackTrailer> readPackFrame(const FileReader& pack, std::uint32_t block);

// The bytes that `payload` points at, verified. `place` names them in the error.
[[nodiscard]] Result<std::vector<std::uint8_t>> readVerified(const FileReader& pack,
                                                             const PayloadRef& payload,
                                                             const std::string& place);

}  // namespace fb
