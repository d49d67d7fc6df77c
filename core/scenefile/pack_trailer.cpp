// The header and trailer of a pack as bytes (pack_format.h).
#include <cstdio>

#include "base/check.h"
#include "base/hash.h"
#include "scenefile/byte_stream.h"
#include "scenefile/level_field.h"
#include "scenefile/limits.h"
#include "scenefile/pack_format.h"

namespace fb {
namespace {

void putNode(ByteWriter& out, const BuiltNode& n) {
    out.put(n.parentInBlock)
        .put(n.childCount)
        .put(packLevel(n.level, n.stuck))
        .put(n.bounds.min)
        .put(n.bounds.max);
    out.put(n.texturedTriangles).put(n.untexturedTriangles).put(n.skirtTriangles).put(n.vertices);
    out.put(n.staticBenefit).put(n.normalCoherence).put(n.areaSquareMetres).put(n.geometricErrorMetres);
    out.put(n.borderErrorMetres);
    out.put(n.averageNormal).put(n.textureWidth).put(n.textureHeight);
    out.put(n.payload.pack).put(n.payload.offset).put(n.payload.sizeBytes).put(n.payload.checksum);
}

// False when the level is none.
bool getNode(ByteReader& in, BuiltNode& n) {
    in.get(n.parentInBlock);
    in.get(n.childCount);
    const bool isLevel = unpackLevel(in.get<std::uint32_t>(), n.level, n.stuck);
    in.get(n.bounds.min);
    in.get(n.bounds.max);
    in.get(n.texturedTriangles);
    in.get(n.untexturedTriangles);
    in.get(n.skirtTriangles);
    in.get(n.vertices);
    in.get(n.staticBenefit);
    in.get(n.normalCoherence);
    in.get(n.areaSquareMetres);
    in.get(n.geometricErrorMetres);
    in.get(n.borderErrorMetres);
    in.get(n.averageNormal);
    in.get(n.textureWidth);
    in.get(n.textureHeight);
    in.get(n.payload.pack);
    in.get(n.payload.offset);
    in.get(n.payload.sizeBytes);
    in.get(n.payload.checksum);
    return isLevel;
}

// What joinBlocks() takes for granted.
bool breadthFirst(const std::vector<BuiltNode>& nodes) {
    if (nodes.empty() || nodes[0].parentInBlock != 0 || nodes[0].level != 0) return false;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (nodes[i].parentInBlock >= i || nodes[i].level < nodes[i - 1].level) return false;
        if (nodes[i].level != nodes[nodes[i].parentInBlock].level + 1) return false;
    }
    return true;
}

}  // namespace

std::filesystem::path packName(std::uint32_t block) {
    char name[24];
    std::snprintf(name, sizeof name, "%05u.pack", block);
    return std::filesystem::path("blocks") / name;
}

std::vector<std::uint8_t> encodePackHeader(std::uint32_t block) {
    ByteWriter out;
    out.text(kPackMagic).put(kSceneFormatVersion).put(block);
    return out.take();
}

std::vector<std::uint8_t> encodeTrailer(const PackTrailer& trailer) {
    ByteWriter out;
    out.text(kTrailerMagic).put(trailer.settingsHash).put(trailer.blockHash);
    out.put(trailer.block.grid.origin).put(trailer.block.grid.step);
    out.put(std::uint64_t{static_cast<std::uint8_t>(trailer.block.kind)});
    out.put(trailer.block.sourceTriangles).put(trailer.block.sourceAreaSquareMetres);
    out.put(static_cast<std::uint64_t>(trailer.block.nodes.size()));
    const std::size_t head = out.size();
    for (const BuiltNode& node : trailer.block.nodes) putNode(out, node);
    FB_CHECK((out.size() - head) == trailer.block.nodes.size() * kBuiltNodeBytes);
    out.put(std::uint64_t{out.size() + 16});
    out.put(hashBytes(out.bytes().data(), out.size()));
    return out.take();
}

Result<PackTrailer> parseTrailer(std::span<const std::uint8_t> bytes, const std::string& what) {
    const auto fault = [&](const char* reason) { return failure(what, "trailer", reason); };
    ByteReader in(bytes);
    if (!in.isText(kTrailerMagic)) return fault("is not the end of a pack");
    PackTrailer trailer;
    in.get(trailer.settingsHash);
    in.get(trailer.blockHash);
    in.get(trailer.block.grid.origin);
    in.get(trailer.block.grid.step);
    const auto kind = in.get<std::uint64_t>();
    in.get(trailer.block.sourceTriangles);
    in.get(trailer.block.sourceAreaSquareMetres);
    const auto count = in.get<std::uint64_t>();
    if (!in.whole() || in.left() < 16) return fault("is cut short");
    if (count > kMaxNodes || count * kBuiltNodeBytes != in.left() - 16)
        return fault("claims a wrong number of nodes");
    if (!(trailer.block.sourceAreaSquareMetres >= 0.0)) return fault("its source has no area that could be");
    if (kind > static_cast<std::uint64_t>(BlockKind::terrain)) return fault("its kind of block is unknown");
    trailer.block.kind = static_cast<BlockKind>(kind);
    trailer.block.nodes.resize(count);
    for (BuiltNode& node : trailer.block.nodes) {
        if (!getNode(in, node)) return fault("has a node whose level is out of range");
    }
    const std::size_t hashed = bytes.size() - 8;
    if (in.get<std::uint64_t>() != bytes.size()) return fault("its length is not what it says");
    if (in.get<std::uint64_t>() != hashBytes(bytes.data(), hashed)) return fault("checksum does not match");
    if (!breadthFirst(trailer.block.nodes)) return fault("the nodes are not in breadth-first order");
    return trailer;
}

}  // namespace fb
