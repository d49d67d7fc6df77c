#include "scenefile/decode_texture.h"
#include "scenefile/mip_levels.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

MipAlpha alphaOf(const NodeData& node) {
    if (node.texture.channels % 2 != 0) return MipAlpha::opaque;
    return node.mesh.flags.alphaMask ? MipAlpha::mask : MipAlpha::weighted;
}

// Exact: a coordinate has at most 24 bits and the step is a power of two.
GpuVertex gpuVertex(const NodeVertex& v, float step) {
    return {{static_cast<float>(v.x) * step, static_cast<float>(v.y) * step, static_cast<float>(v.z) * step},
            {v.normal[0], v.normal[1]},
            v.u,
            v.v,
            {v.colour[0], v.colour[1], v.colour[2], v.colour[3]}};
}

}  // namespace

Result<DecodedNode> decodeNode(const NodeData& node, const BlockGrid& grid, const std::string& what) {
    DecodedNode decoded;
    const auto step = static_cast<float>(grid.step);
    decoded.vertices.reserve(node.mesh.vertices.size());
    for (const NodeVertex& v : node.mesh.vertices) decoded.vertices.push_back(gpuVertex(v, step));
    decoded.indices = node.mesh.indices;
    decoded.texturedTriangles = node.mesh.texturedTriangles;
    decoded.untexturedTriangles = node.mesh.untexturedTriangles;
    decoded.flags = node.mesh.flags;
    const NodeTexture& texture = node.texture;
    if (texture.codec == PayloadCodec::none) return decoded;

    decoded.textureWidth = texture.width;
    decoded.textureHeight = texture.height;
    decoded.mipLevels = mipLevelCount(texture.width, texture.height);
    decoded.texels.resize(mippedBytes(texture.width, texture.height));
    const std::span<std::uint8_t> finest =
        std::span(decoded.texels).first(std::size_t{texture.width} * texture.height * 4);
    if (Result<void> read = decodeTexture(texture, finest, what); !read) return passOn(read);
    buildMipLevels(decoded.texels, texture.width, texture.height, alphaOf(node));
    return decoded;
}

}  // namespace fb
