// hierarchy.bin: the scene description file of the thesis (design section 5), as bytes.
//   header       magic, version, numbers of blocks and nodes, checksums of both tables and of itself (48
//   bytes) block table  pack number, kind, grid, length and seal of the pack (56 bytes a block) node table   one
//   record a node, breadth first (124 bytes a node)
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenefile/hierarchy.h"

namespace fb {

// The pack that a block's payloads lie in. Length and seal tie hierarchy.bin to the packs of the same build.
struct StoredPack {
    std::uint32_t number = 0;  // blocks/NNNNN.pack; ascending
    std::uint64_t sizeBytes = 0;
    std::uint64_t seal = 0;  // see pack_format.h
};

struct HierarchyFile {
    Hierarchy hierarchy;
    std::vector<StoredPack> packs;  // by block
};

[[nodiscard]] std::vector<std::uint8_t> encodeHierarchyFile(const HierarchyFile& file);

// Checks everything that can be known without the packs: checksums, counts against the bytes left,
// checkHierarchy(), and that payloads lie inside their packs. `what` names the file in the error.
[[nodiscard]] Result<HierarchyFile> parseHierarchyFile(std::span<const std::uint8_t> bytes,
                                                       const std::string& what);

inline constexpr std::uint64_t kHierarchyHeaderBytes = 48;
inline constexpr std::uint64_t kBlockRecordBytes = 56;
inline constexpr std::uint64_t kNodeRecordBytes = 124;

}  // namespace fb
