// The bytes of a payload -> NodeData. Nothing is believed: the checksum has been compared before, but it only
// says that the bytes are those that were written.
#include <meshoptimizer.h>

#include <algorithm>

#include "scenefile/byte_stream.h"
#include "scenefile/limits.h"
#include "scenefile/payload_format.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

// The fewest bytes that meshoptimizer's codecs take: an allocation for `vertices` or `triangles` is made only
// when the payload is long enough to hold them. Vertex codec: 256 vertices a block (24-byte vertices), per
// byte of the vertex 16 groups of 2 bits in the header. Index codec: a header byte, one code a triangle, a
// table of 16.
std::uint64_t fewestVertexBytes(std::uint32_t vertices) {
    return std::uint64_t{vertices / 256} * 4 * sizeof(NodeVertex);
}
std::uint64_t fewestIndexBytes(std::uint64_t triangles) {
    return 1 + triangles + 16;
}

Result<void> checkSizes(const PayloadHeader& header, std::uint64_t left, const std::string& what) {
    const std::uint64_t sum = std::uint64_t{header.vertexBytes} + std::uint64_t{header.indexBytes} +
                              std::uint64_t{header.textureBytes};
    if (sum != left) {
        return failure(what, {},
                       "the node's parts take " + std::to_string(sum) + " bytes, but " +
                           std::to_string(left) + " are there");
    }
    if (header.vertices > kMaxNodeVertices || fewestVertexBytes(header.vertices) > header.vertexBytes) {
        return failure(what, {}, "the node claims too many vertices: " + std::to_string(header.vertices));
    }
    const std::uint64_t triangles = std::uint64_t{header.texturedTriangles} + header.untexturedTriangles;
    if (triangles > kMaxNodeTriangles || fewestIndexBytes(triangles) > header.indexBytes) {
        return failure(what, {}, "the node claims too many triangles: " + std::to_string(triangles));
    }
    if (header.texturedSkirts > header.texturedTriangles ||
        header.untexturedSkirts > header.untexturedTriangles) {
        return failure(what, {}, "the node claims more skirts than triangles");
    }
    return {};
}

Result<void> checkTexture(const PayloadHeader& header, const std::string& what) {
    const std::uint32_t width = header.textureWidth;
    const std::uint32_t height = header.textureHeight;
    if (header.codec > static_cast<std::uint8_t>(PayloadCodec::png)) {
        return failure(what, {}, "the texture's codec is unknown");
    }
    if (header.codec == static_cast<std::uint8_t>(PayloadCodec::none)) {
        if (width != 0 || height != 0 || header.channels != 0 || header.textureBytes != 0) {
            return failure(what, {}, "the node has a texture without a codec");
        }
        if (header.texturedTriangles != 0)
            return failure(what, {}, "the node has textured triangles but no texture");
        return {};
    }
    const bool sides = std::max(width, height) <= kMaxTextureSide && atlasSide(width) == width &&
                       atlasSide(height) == height;
    if (!sides || header.channels < 1 || header.channels > 4 || header.textureBytes == 0) {
        return failure(what, {},
                       "the node's texture cannot be " + std::to_string(width) + " x " +
                           std::to_string(height) + " with " + std::to_string(header.channels) + " channels");
    }
    return {};
}

Result<PayloadHeader> readHeader(ByteReader& in, const std::string& what) {
    if (!in.isText(kPayloadMagic)) return failure(what, {}, "is not a node");
    const auto version = in.get<std::uint32_t>();
    if (in.whole() && version != kPayloadVersion) {
        return failure(what, {},
                       "made by version " + std::to_string(version) + "; this program reads " +
                           std::to_string(kPayloadVersion),
                       "build it again");
    }
    PayloadHeader header;
    in.get(header.vertices);
    in.get(header.texturedTriangles);
    in.get(header.untexturedTriangles);
    in.get(header.texturedSkirts);
    in.get(header.untexturedSkirts);
    in.get(header.flags);
    in.get(header.codec);
    in.get(header.channels);
    in.get(header.textureWidth);
    in.get(header.textureHeight);
    const auto reserved = in.get<std::uint16_t>();
    in.get(header.vertexBytes);
    in.get(header.indexBytes);
    in.get(header.textureBytes);
    if (!in.whole()) return failure(what, {}, "the node ends in its header");
    if (reserved != 0 || (header.flags & ~kFlagAlphaMask) != 0) {
        return failure(what, {}, "the node has flags of no known meaning");
    }
    return header;
}

Result<void> readVertices(std::span<const std::uint8_t> coded, NodeMesh& mesh, const std::string& what) {
    if (meshopt_decodeVertexBuffer(mesh.vertices.data(), mesh.vertices.size(), sizeof(NodeVertex),
                                   coded.data(), coded.size()) != 0) {
        return failure(what, {}, "the node's vertices cannot be decoded");
    }
    for (const NodeVertex& v : mesh.vertices) {
        if (std::max({v.x, v.y, v.z}) >= kGridCells)
            return failure(what, {}, "a vertex lies outside the block's grid");
    }
    return {};
}

Result<void> readIndices(std::span<const std::uint8_t> coded, NodeMesh& mesh, const std::string& what) {
    if (meshopt_decodeIndexBuffer(mesh.indices.data(), mesh.indices.size(), sizeof(std::uint32_t),
                                  coded.data(), coded.size()) != 0) {
        return failure(what, {}, "the node's triangles cannot be decoded");
    }
    for (std::uint32_t index : mesh.indices) {
        if (index >= mesh.vertices.size())
            return failure(what, {}, "a triangle asks for a vertex that is not there");
    }
    return {};
}

}  // namespace

Result<void> checkPayloadHeader(const PayloadHeader& header, std::uint64_t left, const std::string& what) {
    if (Result<void> fits = checkSizes(header, left, what); !fits) return fits;
    return checkTexture(header, what);
}

Result<NodeData> parsePayload(std::span<const std::uint8_t> bytes, const std::string& what) {
    ByteReader in(bytes);
    const Result<PayloadHeader> header = readHeader(in, what);
    if (!header) return tl::make_unexpected(header.error());
    if (Result<void> fits = checkPayloadHeader(*header, in.left(), what); !fits) return passOn(fits);

    NodeData node;
    NodeMesh& mesh = node.mesh;
    mesh.flags.alphaMask = (header->flags & kFlagAlphaMask) != 0;
    mesh.texturedTriangles = header->texturedTriangles;
    mesh.untexturedTriangles = header->untexturedTriangles;
    mesh.texturedSkirts = header->texturedSkirts;
    mesh.untexturedSkirts = header->untexturedSkirts;
    mesh.vertices.resize(header->vertices);
    mesh.indices.resize((std::size_t{header->texturedTriangles} + header->untexturedTriangles) * 3);
    if (Result<void> read = readVertices(in.take(header->vertexBytes), mesh, what); !read)
        return passOn(read);
    if (Result<void> read = readIndices(in.take(header->indexBytes), mesh, what); !read) return passOn(read);
    if (header->codec == static_cast<std::uint8_t>(PayloadCodec::none)) return node;

    const std::span<const std::uint8_t> encoded = in.take(header->textureBytes);
    node.texture.codec = static_cast<PayloadCodec>(header->codec);
    node.texture.width = header->textureWidth;
    node.texture.height = header->textureHeight;
    node.texture.channels = header->channels;
    node.texture.encoded.assign(encoded.begin(), encoded.end());
    return node;
}

}  // namespace fb
