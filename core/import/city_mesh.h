// Collects the triangles of one block of the procedural city.
#pragma once

#include <cstdint>
#include <vector>

#include "import/source_scene.h"

namespace fb::city {

class MeshBuilder {
  public:
    [[nodiscard]] std::uint32_t addVertex(const glm::dvec3& position, const glm::vec2& uv = {0.0f, 0.0f}) {
        mesh_.positions.push_back(position);
        mesh_.uvs.push_back(uv);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
        mesh_.triangles.emplace_back(a, b, c);
        mesh_.materials.push_back(material);
    }
    // A cell of a grid, counter-clockwise as seen from outside, cut along its shorter diagonal.
    void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t material);
    void reserve(std::uint64_t triangles);

    [[nodiscard]] std::size_t triangleCount() const { return mesh_.triangles.size(); }
    [[nodiscard]] std::size_t vertexCount() const { return mesh_.positions.size(); }
    // Raises the vertices from `first` on by what `metres(x, z)` gives.
    template <class Metres>
    void raise(std::size_t first, const Metres& metres) {
        for (std::size_t i = first; i < mesh_.positions.size(); ++i) {
            mesh_.positions[i].y += metres(mesh_.positions[i].x, mesh_.positions[i].z);
        }
    }

    // The mesh with area-weighted normals.
    [[nodiscard]] SourceMesh finish();

  private:
    SourceMesh mesh_;
};

}  // namespace fb::city
