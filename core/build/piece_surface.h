// The original of a piece as a surface with colours: the closest point of it, and what it looks like there. Made of
// the cut original; used by dress_triangles and bake_charts for what is drawn in its place.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/triangle_tree.h"
#include "build/block_mesh.h"
#include "build/block_textures.h"

namespace fb {

// What the original of a piece looks like from near a simplified triangle.
class PieceSurface {
  public:
    PieceSurface(const BlockMesh& mesh, std::span<const MeshTriangle> piece, BlockTextures& textures);

    struct Hit {
        std::uint32_t triangle = kNone;  // of the piece
        glm::vec3 weights{0.0f};
    };
    // The closest point of the original that faces the same way as `normal`; of all where none does. `near`:
    // the triangle of an earlier hit close by, or kNone.
    [[nodiscard]] Hit closest(const glm::vec3& point, const glm::vec3& normal, std::uint32_t near) const;
    // The same for many points close together: the triangles that can be closest to a point not farther than `reach`
    // from `centre`. At least one.
    void findCandidates(const glm::vec3& centre, float reach, const glm::vec3& normal, std::uint32_t near,
                        std::vector<std::uint32_t>& candidates) const;
    [[nodiscard]] std::uint32_t surfaceOf(const Hit& hit) const;
    [[nodiscard]] glm::vec2 uvAt(const Hit& hit) const;
    [[nodiscard]] glm::u8vec4 vertexColourAt(const Hit& hit) const;
    // Texture times vertex colour, averaged over a square with this side in grid units.
    [[nodiscard]] glm::u8vec4 colourAt(const Hit& hit, double sideGridUnits) const;
    // Texels of the original's textures per grid unit of length, on average; 0 without textures.
    [[nodiscard]] double texelsPerGridUnit() const { return texelsPerGridUnit_; }
    [[nodiscard]] double texturedGridArea() const { return texturedGridArea_; }
    [[nodiscard]] const MeshTriangle& triangle(std::uint32_t index) const { return piece_[index]; }
    [[nodiscard]] const TriangleCorners& corners(std::uint32_t triangle) const { return tree_.triangles()[triangle]; }

  private:
    friend class TriangleColours;
    [[nodiscard]] double density(std::uint32_t triangle) const;

    const BlockMesh& mesh_;
    std::span<const MeshTriangle> piece_;
    BlockTextures& textures_;
    TriangleTree tree_;
    std::vector<glm::vec3> normals_;
    double texelsPerGridUnit_ = 0.0, texturedGridArea_ = 0.0;
};

// The colours of one triangle of the original, averaged over squares with one side in grid units: what many points of
// it have in common is found once.
class TriangleColours {
  public:
    TriangleColours(const PieceSurface& surface, std::uint32_t triangle, double sideGridUnits);
    // Texture times vertex colour.
    [[nodiscard]] glm::u8vec4 at(const glm::vec3& weights) const;

  private:
    std::array<glm::vec4, 3> colours_;
    std::array<glm::vec2, 3> uvs_;
    bool oneColour_ = false, hasHoles_ = false;
    std::optional<TextureSampler> texture_;  // none without a texture
};

}  // namespace fb
