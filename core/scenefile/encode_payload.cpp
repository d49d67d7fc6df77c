// NodeData -> the bytes of a payload (payload_format.h).
#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>

#include "base/check.h"
#include "scenefile/byte_stream.h"
#include "scenefile/limits.h"
#include "scenefile/payload_format.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

// The library keeps the versions in globals: they are set once, before the first use by any thread.
void chooseCodecVersions() {
    [[maybe_unused]] static const bool chosen = [] {
        meshopt_encodeVertexVersion(0);
        meshopt_encodeIndexVersion(1);
        return true;
    }();
}

void checkOwnMesh(const NodeMesh& mesh) {
    FB_CHECK(mesh.indices.size() == (std::size_t{mesh.texturedTriangles} + mesh.untexturedTriangles) * 3);
    FB_CHECK(mesh.texturedSkirts <= mesh.texturedTriangles);
    FB_CHECK(mesh.untexturedSkirts <= mesh.untexturedTriangles);
    for (std::uint32_t index : mesh.indices) FB_CHECK(index < mesh.vertices.size());
    for (const NodeVertex& v : mesh.vertices) FB_CHECK(std::max({v.x, v.y, v.z}) < kGridCells);
}

void checkOwnTexture(const NodeData& node) {
    const NodeTexture& texture = node.texture;
    FB_CHECK((texture.codec == PayloadCodec::none) == texture.encoded.empty());
    if (texture.codec == PayloadCodec::none) {
        FB_CHECK((texture.width + texture.height) == 0);
        FB_CHECK(node.mesh.texturedTriangles == 0u);
        return;
    }
    FB_CHECK(atlasSide(texture.width) == texture.width);
    FB_CHECK(atlasSide(texture.height) == texture.height);
    FB_CHECK(texture.channels >= 1);
    FB_CHECK(texture.channels <= 4);
}

// Triangles in the order of the GPU's vertex cache, within each of: textured, its skirts, untextured, its skirts.
std::vector<std::uint32_t> orderTriangles(const NodeMesh& mesh) {
    std::vector<std::uint32_t> ordered(mesh.indices.size());
    std::size_t first = 0;
    for (const std::uint32_t triangles :
         {mesh.texturedTriangles - mesh.texturedSkirts, mesh.texturedSkirts,
          mesh.untexturedTriangles - mesh.untexturedSkirts, mesh.untexturedSkirts}) {
        const std::size_t count = std::size_t{triangles} * 3;
        if (count == 0) continue;
        meshopt_optimizeVertexCache(ordered.data() + first, mesh.indices.data() + first, count,
                                    mesh.vertices.size());
        first += count;
    }
    return ordered;
}

// Vertices in the order in which the triangles ask for them; those that none asks for come last, so that the
// number of vertices stays what the node's record says.
std::vector<NodeVertex> orderVertices(const std::vector<NodeVertex>& vertices,
                                      std::vector<std::uint32_t>& indices) {
    constexpr std::uint32_t kUnplaced = ~std::uint32_t{0};
    std::vector<std::uint32_t> place(vertices.size(), kUnplaced);
    std::uint32_t next = 0;
    for (std::uint32_t& index : indices) {
        if (place[index] == kUnplaced) place[index] = next++;
        index = place[index];
    }
    std::vector<NodeVertex> ordered(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (place[i] == kUnplaced) place[i] = next++;
        ordered[place[i]] = vertices[i];
    }
    return ordered;
}

std::vector<std::uint8_t> codeVertices(const std::vector<NodeVertex>& vertices) {
    std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(NodeVertex)));
    const std::size_t used = meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(),
                                                        vertices.size(), sizeof(NodeVertex));
    FB_CHECK(used != std::size_t{0});
    bytes.resize(used);
    return bytes;
}

std::vector<std::uint8_t> codeIndices(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    std::vector<std::uint8_t> bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    const std::size_t used =
        meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size());
    FB_CHECK(used != std::size_t{0});
    bytes.resize(used);
    return bytes;
}

Result<void> checkCaps(const NodeData& node) {
    const std::string hint = "lower build.desired_triangles or cut the block into smaller ones";
    if (node.mesh.vertices.size() > kMaxNodeVertices) {
        return failure({}, {}, "a node has more than " + std::to_string(kMaxNodeVertices) + " vertices",
                       hint);
    }
    if (node.mesh.indices.size() / 3 > kMaxNodeTriangles) {
        return failure({}, {}, "a node has more than " + std::to_string(kMaxNodeTriangles) + " triangles",
                       hint);
    }
    if (std::max(node.texture.width, node.texture.height) > kMaxTextureSide) {
        return failure({}, {},
                       "a node's texture is wider than " + std::to_string(kMaxTextureSide) + " texels",
                       "lower build.max_texture_side");
    }
    // Mesh codecs need less than 1.1 GB at the caps above: what remains keeps the payload's size within 32
    // bits.
    if (node.texture.encoded.size() > (std::size_t{1} << 31)) {
        return failure({}, {}, "a node's texture takes more than 2 GiB", "lower build.max_texture_side");
    }
    return {};
}

}  // namespace

Result<std::vector<std::uint8_t>> encodePayload(const NodeData& node) {
    if (Result<void> fits = checkCaps(node); !fits) return passOn(fits);
    checkOwnMesh(node.mesh);
    checkOwnTexture(node);
    chooseCodecVersions();

    std::vector<std::uint32_t> indices = orderTriangles(node.mesh);
    const std::vector<NodeVertex> vertices = orderVertices(node.mesh.vertices, indices);
    const std::vector<std::uint8_t> vertexBytes = codeVertices(vertices);
    const std::vector<std::uint8_t> indexBytes = codeIndices(indices, vertices.size());
    const NodeTexture& texture = node.texture;
    const bool textured = texture.codec != PayloadCodec::none;

    ByteWriter out;
    out.reserve(kPayloadHeaderBytes + vertexBytes.size() + indexBytes.size() + texture.encoded.size());
    out.text(kPayloadMagic).put(kPayloadVersion);
    out.put(static_cast<std::uint32_t>(vertices.size()));
    out.put(node.mesh.texturedTriangles).put(node.mesh.untexturedTriangles);
    out.put(node.mesh.texturedSkirts).put(node.mesh.untexturedSkirts);
    out.put(node.mesh.flags.alphaMask ? kFlagAlphaMask : 0u);
    out.put(static_cast<std::uint8_t>(texture.codec)).put(textured ? texture.channels : std::uint8_t{0});
    out.put(texture.width).put(texture.height).put(std::uint16_t{0});
    out.put(static_cast<std::uint32_t>(vertexBytes.size()))
        .put(static_cast<std::uint32_t>(indexBytes.size()));
    out.put(static_cast<std::uint32_t>(texture.encoded.size()));
    FB_CHECK(out.size() == kPayloadHeaderBytes);
    out.append(vertexBytes).append(indexBytes).append(texture.encoded);
    return out.take();
}

}  // namespace fb
