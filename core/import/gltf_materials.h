// Materials of a glTF model: base colour, base colour texture, holes, and how the texture is laid on.
// Comes from read_gltf.cpp and goes back there.
#pragma once

#include <tiny_gltf.h>

#include "import/mesh_file.h"

namespace fb {

// Which texture coordinates a material uses, and KHR_texture_transform: uv' = axes * uv + offset.
struct GltfTextureUse {
    int uvSet = 0;
    bool isTransformed = false;
    glm::dmat2 axes{1.0};
    glm::dvec2 offset{0.0};
};

class TexturesOfFile;

// Fills the block's materials and textures, one material for each of the model; returns how each uses its
// texture.
[[nodiscard]] std::vector<GltfTextureUse> addGltfMaterials(const tinygltf::Model& model, MeshFile& into,
                                                           TexturesOfFile& textures, ImportReport& report);

}  // namespace fb
