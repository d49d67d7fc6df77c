// Small blocks with known contents for the tests of the build stage.
#pragma once

#include <functional>

#include <memory>
#include <span>

#include "build/block_mesh.h"
#include "import/source_scene.h"

namespace fb::test {

// A sheet of columns x rows squares, two triangles each, spanning (0,0,0) to (width, height, 0); uv runs over
// [0,1]^2 with row 0 of the texture at y = 0. `lift` gives z from (x, y).
struct Sheet {
    int columns = 1, rows = 1;
    double width = 1.0, height = 1.0;
    std::function<double(double, double)> lift;
};
[[nodiscard]] SourceMesh makeSheet(const Sheet& sheet);

// A closed sphere of 2 * slices * (stacks - 1) triangles with radius 1 about the origin, without texture
// coordinates.
[[nodiscard]] SourceMesh makeSphere(int slices, int stacks);

// A block with one material; with `image` textured by it.
[[nodiscard]] SourceBlock blockOf(SourceMesh mesh, std::shared_ptr<const Image> image = nullptr);

// A picture whose texels are paint(x, y), RGB.
[[nodiscard]] std::shared_ptr<const Image> paintImage(int width, int height,
                                                      const std::function<glm::u8vec3(int, int)>& paint);

[[nodiscard]] double areaOf(const SourceMesh& mesh);
[[nodiscard]] double areaOf(const BlockMesh& mesh, std::span<const MeshTriangle> triangles);  // square metres

// Adds a square of two triangles that shows the texels [x, x + side) x [y, y + side) of a texture of `size`.
inline void addSquare(SourceBlock& block, std::uint32_t material, const glm::vec2& corner, float side, const glm::vec2& size) {
    const SourceMesh sheet = makeSheet({1, 1, 1.0, 1.0, {}});
    SourceMesh& mesh = block.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
        mesh.positions.push_back(sheet.positions[v] + glm::dvec3(2.0 * first, 0, 0));
        mesh.uvs.push_back((corner + sheet.uvs[v] * side) / size);
    }
    for (const glm::uvec3& t : sheet.triangles) {
        mesh.triangles.push_back(t + first);
        mesh.materials.push_back(material);
    }
}

inline SourceBlock emptyBlock(std::vector<SourceTexture> textures) {
    SourceBlock block;
    block.name = "test";
    for (std::size_t i = 0; i < textures.size(); ++i)
        block.materials.push_back({"m", glm::vec4(1.0f), static_cast<int>(i), false});
    block.textures = std::move(textures);
    return block;
}

}  // namespace fb::test
