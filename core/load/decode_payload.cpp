#include "load/decode_payload.h"

#include <exception>
#include <string>
#include <vector>

#include "base/hash.h"

namespace fb {
namespace {

std::string packName(const Scene& scene, NodeId node) {
    const std::uint32_t pack = scene.hierarchy.payload[node].pack;
    return pack < scene.packs.size() ? scene.packs[pack].path().string() : "pack " + std::to_string(pack);
}

Result<std::unique_ptr<DecodedNode>> decodeVerified(const Scene& scene, NodeId node,
                                                    std::span<const std::uint8_t> bytes) {
    const std::string file = packName(scene, node);
    if (hashBytes(bytes.data(), bytes.size()) != scene.hierarchy.payload[node].checksum) {
        return failure(file, nodePlace(node), "the checksum is wrong: the data is damaged",
                       "frontbench check finds all damage; build the scene again");
    }
    const std::string what = file + ", " + nodePlace(node);
    Result<NodeData> data = parsePayload(bytes, what);
    if (!data) return passOn(data);
    Result<DecodedNode> decoded = decodeNode(*data, scene.hierarchy.grids[scene.hierarchy.block[node]], what);
    if (!decoded) return passOn(decoded);
    if (decoded->sizeBytes() != scene.hierarchy.residentBytes[node]) {
        return failure(file, nodePlace(node),
                       "takes " + std::to_string(decoded->sizeBytes()) +
                           " bytes in memory, the hierarchy says " +
                           std::to_string(scene.hierarchy.residentBytes[node]));
    }
    return std::make_unique<DecodedNode>(std::move(*decoded));
}

}  // namespace

std::string nodePlace(NodeId node) {
    return "node " + std::to_string(node);
}

Result<void> ScenePacks::readAt(std::uint32_t pack, std::uint64_t offset, std::span<std::uint8_t> into) {
    if (pack >= scene_.packs.size()) {
        return failure(scene_.folder.string(), "pack " + std::to_string(pack), "there is no such pack");
    }
    return scene_.packs[pack].readAt(offset, into);
}

Result<std::unique_ptr<DecodedNode>> decodePayload(const Scene& scene, NodeId node,
                                                   std::span<const std::uint8_t> bytes) {
    // Memory and the image library may throw; a loader thread must outlive it.
    try {
        return decodeVerified(scene, node, bytes);
    } catch (const std::exception& problem) {
        return failure(packName(scene, node), nodePlace(node),
                       std::string("cannot be decoded: ") + problem.what());
    }
}

Result<std::vector<std::uint8_t>> readPayloadFrom(const Scene& scene, PayloadSource& source, NodeId node) {
    const PayloadRef& payload = scene.hierarchy.payload[node];
    std::vector<std::uint8_t> bytes;
    try {
        bytes.resize(payload.sizeBytes);
    } catch (const std::exception& problem) {
        return failure(packName(scene, node), nodePlace(node),
                       std::string("cannot be read: ") + problem.what());
    }
    if (Result<void> read = source.readAt(payload.pack, payload.offset, bytes); !read) {
        if (read.error().place.empty()) read.error().place = nodePlace(node);
        return passOn(read);
    }
    return bytes;
}

Result<std::unique_ptr<DecodedNode>> readAndDecode(const Scene& scene, PayloadSource& source, NodeId node) {
    Result<std::vector<std::uint8_t>> bytes = readPayloadFrom(scene, source, node);
    if (!bytes) return passOn(bytes);
    return decodePayload(scene, node, *bytes);
}

}  // namespace fb
