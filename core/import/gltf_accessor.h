// Numbers of a glTF accessor, checked against its view and buffer once and then read in place: of any
// component type, normalised or not, interleaved or not, with sparse replacements.
#pragma once

#include <tiny_gltf.h>

#include <map>

#include "import/mesh_file.h"

namespace fb {

class GltfAccessor {
  public:
    // `components`: how many an element must have at least.
    [[nodiscard]] static Result<GltfAccessor> open(const MeshBytes& input, const tinygltf::Model& model,
                                                   int accessor, int components);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] int components() const { return components_; }
    [[nodiscard]] double number(std::size_t element, int component) const;
    [[nodiscard]] std::uint32_t index(std::size_t element) const;  // of a scalar of an unsigned type

  private:
    const std::uint8_t* base_ = nullptr;
    std::size_t stride_ = 0, count_ = 0, componentBytes_ = 0;
    int components_ = 0, componentType_ = 0;
    bool normalized_ = false;
    std::map<std::uint32_t, const std::uint8_t*> replaced_;  // sparse
};

}  // namespace fb
