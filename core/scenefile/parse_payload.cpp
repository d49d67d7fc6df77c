// The bytes of a payload -> NodeData. Nothing is believed: the checksum has been compared before, but it only says that
// the bytes are those that were written.
#include <meshoptimizer.h>

#include <algorithm>

#include "scenefile/byte_stream.h"
#include "scenefile/limits.h"
#include "scenefile/payload_format.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

// The fewest bytes that meshoptimizer's codecs take: an allocation for `vertices` or `triangles` is made only when the
// payload is long enough to hold them. Vertex codec: 256 vertices a block (24-byte vertices), per byte of the vertex 16
// groups of 2 bits in the header. Index codec: a header byte, one code a triangle, a table of 16.
std::uint64_t fewestVertexBytes(std::uint32_t vertices) { return std::uint64_t{vertices / 256} * 4 * sizeof(NodeVertex); }
std::uint64_t fewestIndexBytes(std::uint64_t triangles) { return 1 + triangles + 16; }

struct PayloadReader {
    ByteReader in;
    const std::string& what;
    PayloadHeader header;

    [[nodiscard]] tl::unexpected<Error> fault(std::string reason) const { return failure(what, {}, std::move(reason)); }

    Result<void> readHeader() {
        if (!in.isText(kPayloadMagic)) return fault("is not a node");
        const auto version = in.get<std::uint32_t>();
        if (in.whole() && version != kPayloadVersion) {
            return failure(what, {},
                           "made by version " + std::to_string(version) + "; this program reads " +
                               std::to_string(kPayloadVersion),
                           "build it again");
        }
        in.get(header.vertices);
        in.get(header.texturedTriangles);
        in.get(header.untexturedTriangles);
        in.get(header.flags);
        in.get(header.codec);
        in.get(header.channels);
        in.get(header.textureWidth);
        in.get(header.textureHeight);
        const auto reserved = in.get<std::uint16_t>();
        in.get(header.vertexBytes);
        in.get(header.indexBytes);
        in.get(header.textureBytes);
        if (!in.whole()) return fault("the node ends in its header");
        if (reserved != 0 || (header.flags & ~kFlagAlphaMask) != 0) return fault("the node has flags of no known meaning");
        return {};
    }

    Result<void> checkSizes() const {
        const std::uint64_t sum =
            std::uint64_t{header.vertexBytes} + std::uint64_t{header.indexBytes} + std::uint64_t{header.textureBytes};
        if (sum != in.left()) {
            return fault("the node's parts take " + std::to_string(sum) + " bytes, but " + std::to_string(in.left()) +
                         " are there");
        }
        if (header.vertices > kMaxNodeVertices || fewestVertexBytes(header.vertices) > header.vertexBytes) {
            return fault("the node claims too many vertices: " + std::to_string(header.vertices));
        }
        const std::uint64_t triangles = std::uint64_t{header.texturedTriangles} + header.untexturedTriangles;
        if (triangles > kMaxNodeTriangles || fewestIndexBytes(triangles) > header.indexBytes) {
            return fault("the node claims too many triangles: " + std::to_string(triangles));
        }
        return {};
    }

    Result<void> checkTexture() const {
        const std::uint32_t width = header.textureWidth;
        const std::uint32_t height = header.textureHeight;
        if (header.codec > static_cast<std::uint8_t>(PayloadCodec::png)) return fault("the texture's codec is unknown");
        if (header.codec == static_cast<std::uint8_t>(PayloadCodec::none)) {
            if (width != 0 || height != 0 || header.channels != 0 || header.textureBytes != 0) {
                return fault("the node has a texture without a codec");
            }
            if (header.texturedTriangles != 0) return fault("the node has textured triangles but no texture");
            return {};
        }
        const bool sides = std::max(width, height) <= kMaxTextureSide && atlasSide(width) == width &&
                           atlasSide(height) == height;
        if (!sides || header.channels < 1 || header.channels > 4 || header.textureBytes == 0) {
            return fault("the node's texture cannot be " + std::to_string(width) + " x " + std::to_string(height) +
                         " with " + std::to_string(header.channels) + " channels");
        }
        return {};
    }

    Result<void> readVertices(NodeMesh& mesh) {
        const std::span<const std::uint8_t> coded = in.take(header.vertexBytes);
        mesh.vertices.resize(header.vertices);
        if (meshopt_decodeVertexBuffer(mesh.vertices.data(), header.vertices, sizeof(NodeVertex), coded.data(),
                                       coded.size()) != 0) {
            return fault("the node's vertices cannot be decoded");
        }
        for (const NodeVertex& v : mesh.vertices) {
            if (std::max({v.x, v.y, v.z}) >= kGridCells) return fault("a vertex lies outside the block's grid");
        }
        return {};
    }

    Result<void> readIndices(NodeMesh& mesh) {
        const std::span<const std::uint8_t> coded = in.take(header.indexBytes);
        mesh.texturedTriangles = header.texturedTriangles;
        mesh.untexturedTriangles = header.untexturedTriangles;
        mesh.indices.resize((std::size_t{header.texturedTriangles} + header.untexturedTriangles) * 3);
        if (meshopt_decodeIndexBuffer(mesh.indices.data(), mesh.indices.size(), sizeof(std::uint32_t), coded.data(),
                                      coded.size()) != 0) {
            return fault("the node's triangles cannot be decoded");
        }
        for (std::uint32_t index : mesh.indices) {
            if (index >= header.vertices) return fault("a triangle asks for a vertex that is not there");
        }
        return {};
    }

    void readTexture(NodeTexture& texture) {
        if (header.codec == static_cast<std::uint8_t>(PayloadCodec::none)) return;
        texture.codec = static_cast<PayloadCodec>(header.codec);
        texture.width = header.textureWidth;
        texture.height = header.textureHeight;
        texture.channels = header.channels;
        const std::span<const std::uint8_t> encoded = in.take(header.textureBytes);
        texture.encoded.assign(encoded.begin(), encoded.end());
    }
};

}  // namespace

Result<NodeData> parsePayload(std::span<const std::uint8_t> bytes, const std::string& what) {
    PayloadReader reader{ByteReader(bytes), what, {}};
    if (Result<void> read = reader.readHeader(); !read) return passOn(read);
    if (Result<void> fits = reader.checkSizes(); !fits) return passOn(fits);
    if (Result<void> fits = reader.checkTexture(); !fits) return passOn(fits);
    NodeData node;
    node.mesh.flags.alphaMask = (reader.header.flags & kFlagAlphaMask) != 0;
    if (Result<void> read = reader.readVertices(node.mesh); !read) return passOn(read);
    if (Result<void> read = reader.readIndices(node.mesh); !read) return passOn(read);
    reader.readTexture(node.texture);
    return node;
}

}  // namespace fb
