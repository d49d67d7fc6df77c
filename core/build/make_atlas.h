// One node's texture: charts found, sized, packed and filled; and its coding as JPEG or PNG.
// Comes from node_triangles, goes to finish_node. Textures shrink by the same factor as triangles do
// (thesis 3.2): along each axis by its square root.
#pragma once

#include <optional>
#include <vector>

#include "build/node_triangles.h"
#include "scenefile/node_data.h"

namespace fb {

struct AtlasTask {
    const BlockMesh& mesh;
    BlockTextures& textures;
    const PieceSurface* surface = nullptr;  // needed where triangles are baked
    double scale = 1.0;  // atlas texels per source texel along each axis; 1 copies texels exactly
    int maxSide = 4096;
};

struct Atlas {
    std::optional<Image> image;        // nothing: no triangle is textured
    bool reduced = false;              // made smaller than asked for, to fit maxSide
    bool replaced = false;             // even so it did not fit: textures became vertex colours
    std::uint64_t blurredRepeats = 0;  // charts with so many repeats that they were stored smaller
};

// Sets chart and texels (atlas texels) of the textured triangles.
[[nodiscard]] Atlas makeAtlas(std::vector<NodeTriangle>& triangles, const AtlasTask& task);

// `codec` is jpeg or png; a picture with alpha must be png.
[[nodiscard]] Result<NodeTexture> encodeTexture(const Image& image, PayloadCodec codec, int jpegQuality);

}  // namespace fb
