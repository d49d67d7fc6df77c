// One node's content as built, stored and decoded: a mesh on the block's grid and at most one texture atlas.
// Comes from build/ or from a pack; goes to the renderer.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "import/source_scene.h"

namespace fb {

// 24 bytes, the layout on disk and, with the position turned to floats, on the GPU.
struct NodeVertex {
    std::uint32_t x, y, z;       // on the block's grid, < 2^24
    std::int16_t normal[2];      // octahedral, snorm16; see encodeNormal
    std::uint16_t u, v;          // unorm16 over the atlas, (0,0) is the top left corner of row 0
    std::uint8_t colour[4];      // sRGB, alpha linear; multiplied with the texture
};
static_assert(sizeof(NodeVertex) == 24);

enum class PayloadCodec : std::uint8_t { none, jpeg, png };

struct NodeFlags {
    bool alphaMask = false;  // texels with alpha < 0.5 are holes: the shader must discard
};

struct NodeMesh {
    std::vector<NodeVertex> vertices;
    // Textured triangles first. The last ones of either part are skirts: they hang from borders that other nodes
    // share, hide the gaps between levels, and count in neither area, benefit nor average normal.
    std::vector<std::uint32_t> indices;
    std::uint32_t texturedTriangles = 0, untexturedTriangles = 0;  // with skirts
    std::uint32_t texturedSkirts = 0, untexturedSkirts = 0;
    NodeFlags flags;

    [[nodiscard]] bool isSkirt(std::uint32_t triangle) const {
        return triangle < texturedTriangles
                   ? triangle >= texturedTriangles - texturedSkirts
                   : triangle >= texturedTriangles + untexturedTriangles - untexturedSkirts;
    }
};

struct NodeTexture {
    PayloadCodec codec = PayloadCodec::none;
    std::uint16_t width = 0, height = 0;  // each 2^k or 3 * 2^(k-1): few size classes, little waste
    std::uint8_t channels = 3;
    std::vector<std::uint8_t> encoded;
};

struct NodeData {
    NodeMesh mesh;
    NodeTexture texture;
};

// A decoded node, ready to upload: float positions relative to the block grid's origin, RGBA8 mip levels one after
// the other, level 0 first, each max(1, side >> level).
struct GpuVertex {
    float position[3];  // metres relative to the block grid's origin
    std::int16_t normal[2];
    std::uint16_t u, v;
    std::uint8_t colour[4];
};
static_assert(sizeof(GpuVertex) == 24);

struct DecodedNode {
    std::vector<GpuVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::uint32_t texturedTriangles = 0, untexturedTriangles = 0;
    NodeFlags flags;
    std::uint16_t textureWidth = 0, textureHeight = 0;
    std::uint32_t mipLevels = 0;
    std::vector<std::uint8_t> texels;

    [[nodiscard]] std::uint64_t sizeBytes() const {
        return vertices.size() * sizeof(GpuVertex) + indices.size() * sizeof(std::uint32_t) + texels.size();
    }
};

[[nodiscard]] glm::vec3 decodeNormal(const std::int16_t normal[2]);
void encodeNormal(const glm::vec3& normal, std::int16_t into[2]);

// Number of mip levels of a texture down to 1x1, and the bytes of all of them as RGBA8.
[[nodiscard]] std::uint32_t mipLevelCount(std::uint32_t width, std::uint32_t height);
[[nodiscard]] std::uint64_t mippedBytes(std::uint32_t width, std::uint32_t height);
// Bytes that a node takes when resident; DecodedNode::sizeBytes() of the same node gives the same number.
[[nodiscard]] std::uint64_t residentBytes(std::uint32_t vertices, std::uint32_t triangles, std::uint32_t textureWidth,
                                          std::uint32_t textureHeight);

// Smallest atlas side of the classes 2^k, 3 * 2^(k-1) (at least 4) that is not below `side`.
[[nodiscard]] std::uint32_t atlasSide(std::uint32_t side);

}  // namespace fb
