#include "draw/check_node.h"

namespace fb {

Result<void> checkNode(NodeId node, const DecodedNode& content) {
    const auto refuse = [&](std::string reason) {
        return failure("", "node " + std::to_string(node), std::move(reason));
    };
    const std::uint64_t triangles = std::uint64_t{content.texturedTriangles} + content.untexturedTriangles;
    if (content.indices.size() != triangles * 3) {
        return refuse(std::to_string(content.indices.size()) + " indices for " + std::to_string(triangles) +
                      " triangles");
    }
    for (const std::uint32_t index : content.indices) {
        if (index >= content.vertices.size()) {
            return refuse("index " + std::to_string(index) + " of " +
                          std::to_string(content.vertices.size()) + " vertices");
        }
    }
    const std::uint32_t width = content.textureWidth, height = content.textureHeight;
    if ((width == 0) != (height == 0)) return refuse("a texture with one side of 0 texels");
    if (width == 0) {
        if (content.texturedTriangles > 0) return refuse("textured triangles without a texture");
        if (!content.texels.empty()) return refuse("texels of a texture without a size");
        return {};
    }
    const std::uint32_t levels = mipLevelCount(width, height);
    const std::uint64_t bytes = mippedBytes(width, height);
    if (content.mipLevels != levels) {
        return refuse(std::to_string(content.mipLevels) + " mip levels instead of " + std::to_string(levels));
    }
    if (content.texels.size() != bytes) {
        return refuse(std::to_string(content.texels.size()) + " bytes of texels instead of " +
                      std::to_string(bytes));
    }
    return {};
}

}  // namespace fb
