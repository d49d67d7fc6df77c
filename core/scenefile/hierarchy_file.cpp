#include "scenefile/hierarchy_file.h"

#include "base/check.h"
#include "base/hash.h"
#include "scenefile/byte_stream.h"
#include "scenefile/level_field.h"
#include "scenefile/limits.h"
#include "scenefile/node_data.h"
#include "scenefile/pack_format.h"

namespace fb {
namespace {

constexpr std::string_view kMagic = "fbscene\n";

void putBlock(ByteWriter& out, const BlockGrid& grid, BlockKind kind, const StoredPack& pack) {
    out.put(pack.number)
        .put(std::uint32_t{static_cast<std::uint8_t>(kind)})
        .put(grid.origin)
        .put(grid.step)
        .put(pack.sizeBytes)
        .put(pack.seal);
}

void putNode(ByteWriter& out, const Hierarchy& h, NodeId n) {
    out.put(n).put(h.parent[n]).put(h.firstChild[n]).put(h.childCount[n]);
    out.put(packLevel(h.level[n], h.stuck[n] != 0)).put(h.block[n]).put(h.bounds[n].min).put(h.bounds[n].max);
    out.put(h.texturedTriangles[n]).put(h.untexturedTriangles[n]).put(h.skirtTriangles[n]).put(h.vertices[n]);
    out.put(h.staticBenefit[n]).put(h.averageNormal[n]).put(h.normalCoherence[n]);
    out.put(h.areaSquareMetres[n])
        .put(h.geometricErrorMetres[n])
        .put(h.borderErrorMetres[n])
        .put(h.textureWidth[n])
        .put(h.textureHeight[n]);
    const PayloadRef& payload = h.payload[n];
    out.put(payload.pack).put(payload.offset).put(payload.sizeBytes).put(payload.checksum);
}

// False when id or level cannot be.
bool getNode(ByteReader& in, Hierarchy& h, NodeId n) {
    const auto id = in.get<std::uint32_t>();
    in.get(h.parent[n]);
    in.get(h.firstChild[n]);
    in.get(h.childCount[n]);
    bool stuck = false;
    const bool isLevel = unpackLevel(in.get<std::uint32_t>(), h.level[n], stuck);
    h.stuck[n] = stuck ? 1 : 0;
    in.get(h.block[n]);
    in.get(h.bounds[n].min);
    in.get(h.bounds[n].max);
    in.get(h.texturedTriangles[n]);
    in.get(h.untexturedTriangles[n]);
    in.get(h.skirtTriangles[n]);
    in.get(h.vertices[n]);
    in.get(h.staticBenefit[n]);
    in.get(h.averageNormal[n]);
    in.get(h.normalCoherence[n]);
    in.get(h.areaSquareMetres[n]);
    in.get(h.geometricErrorMetres[n]);
    in.get(h.borderErrorMetres[n]);
    in.get(h.textureWidth[n]);
    in.get(h.textureHeight[n]);
    in.get(h.payload[n].pack);
    in.get(h.payload[n].offset);
    in.get(h.payload[n].sizeBytes);
    in.get(h.payload[n].checksum);
    return id == n && isLevel;
}

struct Header {
    std::uint32_t blocks = 0, nodes = 0;
    std::uint64_t blockTableHash = 0, nodeTableHash = 0;
};

Result<Header> readHeader(std::span<const std::uint8_t> bytes, const std::string& what) {
    ByteReader in(bytes);
    if (!in.isText(kMagic)) return failure(what, "header", "is not a scene", "build it again");
    const auto version = in.get<std::uint32_t>();
    if (in.whole() && version != kSceneFormatVersion) {
        return failure(what, "header",
                       "made by version " + std::to_string(version) + "; this program reads " +
                           std::to_string(kSceneFormatVersion),
                       "build it again");
    }
    Header header;
    in.get(header.blocks);
    in.get(header.nodes);
    const auto reserved = in.get<std::uint32_t>();
    in.get(header.blockTableHash);
    in.get(header.nodeTableHash);
    const auto hash = in.get<std::uint64_t>();
    if (!in.whole()) return failure(what, "header", "is cut short", "build it again");
    if (hash != hashBytes(bytes.data(), kHierarchyHeaderBytes - 8) || reserved != 0) {
        return failure(what, "header", "checksum does not match", "the file is damaged: build it again");
    }
    if (header.nodes == 0 || header.nodes > kMaxNodes || header.blocks == 0 || header.blocks > kMaxBlocks) {
        return failure(what, "header",
                       "cannot have " + std::to_string(header.blocks) + " blocks and " +
                           std::to_string(header.nodes) + " nodes");
    }
    const std::uint64_t expected = header.blocks * kBlockRecordBytes + header.nodes * kNodeRecordBytes;
    if (in.left() != expected) {
        return failure(what, "header",
                       "the tables take " + std::to_string(expected) + " bytes, but " +
                           std::to_string(in.left()) + " are there",
                       "the file is damaged: build it again");
    }
    return header;
}

Result<void> readBlocks(std::span<const std::uint8_t> table, HierarchyFile& file, const std::string& what) {
    ByteReader in(table);
    for (std::size_t b = 0; b < file.packs.size(); ++b) {
        StoredPack& pack = file.packs[b];
        in.get(pack.number);
        const auto kind = in.get<std::uint32_t>();
        in.get(file.hierarchy.grids[b].origin);
        in.get(file.hierarchy.grids[b].step);
        in.get(pack.sizeBytes);
        in.get(pack.seal);
        const bool ascending = b == 0 || pack.number > file.packs[b - 1].number;
        if (!ascending || pack.number >= kMaxBlocks) {
            return failure(what, "block " + std::to_string(b), "the number of its pack cannot be");
        }
        if (kind > static_cast<std::uint32_t>(BlockKind::terrain)) {
            return failure(what, "block " + std::to_string(b), "its kind is unknown");
        }
        file.hierarchy.kinds[b] = static_cast<BlockKind>(kind);
    }
    return {};
}

Result<void> readNodes(std::span<const std::uint8_t> table, Hierarchy& h, const std::string& what) {
    ByteReader in(table);
    for (NodeId n = 0; n < h.size(); ++n) {
        if (!getNode(in, h, n))
            return failure(what, "node " + std::to_string(n), "its id or level cannot be");
    }
    Result<void> sound = checkHierarchy(h);
    if (!sound) sound.error().file = what;
    return sound;
}

// Where the payload may lie: behind the pack's header and before the least trailer that there can be.
bool insidePack(const PayloadRef& payload, const StoredPack& pack) {
    if (payload.pack != pack.number || payload.sizeBytes == 0 || payload.offset % kPackAlignment != 0)
        return false;
    if (payload.offset < kPackHeaderBytes || pack.sizeBytes < kLeastTrailerBytes) return false;
    const std::uint64_t end = pack.sizeBytes - kLeastTrailerBytes;
    return payload.offset <= end && payload.sizeBytes <= end - payload.offset;
}

}  // namespace

std::vector<std::uint8_t> encodeHierarchyFile(const HierarchyFile& file) {
    const Hierarchy& h = file.hierarchy;
    FB_CHECK(file.packs.size() == h.grids.size());
    FB_CHECK(file.packs.size() == h.kinds.size());
    ByteWriter blocks;
    for (std::size_t b = 0; b < file.packs.size(); ++b)
        putBlock(blocks, h.grids[b], h.kinds[b], file.packs[b]);
    FB_CHECK(blocks.size() == file.packs.size() * kBlockRecordBytes);
    ByteWriter nodes;
    nodes.reserve(h.size() * kNodeRecordBytes);
    for (NodeId n = 0; n < h.size(); ++n) putNode(nodes, h, n);
    FB_CHECK(nodes.size() == h.size() * kNodeRecordBytes);

    ByteWriter out;
    out.reserve(kHierarchyHeaderBytes + blocks.size() + nodes.size());
    out.text(kMagic).put(kSceneFormatVersion);
    out.put(static_cast<std::uint32_t>(file.packs.size())).put(h.size()).put(std::uint32_t{0});
    out.put(hashBytes(blocks.bytes().data(), blocks.size()));
    out.put(hashBytes(nodes.bytes().data(), nodes.size()));
    out.put(hashBytes(out.bytes().data(), out.size()));
    FB_CHECK(out.size() == kHierarchyHeaderBytes);
    out.append(blocks.bytes()).append(nodes.bytes());
    return out.take();
}

Result<HierarchyFile> parseHierarchyFile(std::span<const std::uint8_t> bytes, const std::string& what) {
    const Result<Header> header = readHeader(bytes, what);
    if (!header) return tl::make_unexpected(header.error());
    const std::span<const std::uint8_t> blocks =
        bytes.subspan(kHierarchyHeaderBytes, header->blocks * kBlockRecordBytes);
    const std::span<const std::uint8_t> nodes = bytes.subspan(kHierarchyHeaderBytes + blocks.size());
    if (hashBytes(blocks.data(), blocks.size()) != header->blockTableHash) {
        return failure(what, "block table", "checksum does not match", "the file is damaged: build it again");
    }
    if (hashBytes(nodes.data(), nodes.size()) != header->nodeTableHash) {
        return failure(what, "node table", "checksum does not match", "the file is damaged: build it again");
    }
    HierarchyFile file;
    Hierarchy& h = file.hierarchy;
    file.packs.resize(header->blocks);
    h.grids.resize(header->blocks);
    h.kinds.resize(header->blocks);
    h.rootCount = header->blocks;
    h.resize(header->nodes);
    if (Result<void> read = readBlocks(blocks, file, what); !read) return passOn(read);
    if (Result<void> read = readNodes(nodes, h, what); !read) return passOn(read);
    for (NodeId n = 0; n < h.size(); ++n) {
        if (!insidePack(h.payload[n], file.packs[h.block[n]])) {
            return failure(what, "node " + std::to_string(n), "its payload lies outside the block's pack");
        }
        h.residentBytes[n] = static_cast<std::uint32_t>(
            residentBytes(h.vertices[n], h.triangles(n), h.textureWidth[n], h.textureHeight[n]));
    }
    return file;
}

}  // namespace fb
