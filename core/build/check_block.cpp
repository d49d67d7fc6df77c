#include "build/check_block.h"

#include <cmath>

#include "scenefile/limits.h"

namespace fb {
namespace {

// Half of what scene files hold, so that a grid's origin, rounded down, still is in range.
constexpr double kLargestCoordinate = 0.5 * kMaxCoordinateMetres;

}  // namespace

Result<void> checkBlock(const SourceBlock& block) {
    const SourceMesh& mesh = block.mesh;
    const std::size_t vertices = mesh.positions.size();
    if ((mesh.hasNormals() && mesh.normals.size() != vertices) ||
        (mesh.hasUvs() && mesh.uvs.size() != vertices) ||
        (mesh.hasColours() && mesh.colours.size() != vertices) ||
        (!mesh.shared.empty() && mesh.shared.size() != vertices) ||
        (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size())) {
        return failure("", block.name, "the mesh's attributes do not have one entry per vertex or triangle");
    }
    if (mesh.triangles.size() >= std::size_t{1} << 29 || vertices >= std::size_t{1} << 30) {
        return failure("", block.name, "more than 2^29 triangles in one block",
                       "split it into smaller blocks");
    }
    for (std::size_t i = 0; i < vertices; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(mesh.positions[i][axis]) <= kLargestCoordinate)) {
                return failure("", block.name,
                               "vertex " + std::to_string(i) + " is not finite or beyond 5e11 m");
            }
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& corners = mesh.triangles[i];
        if (corners.x >= vertices || corners.y >= vertices || corners.z >= vertices) {
            return failure("", block.name,
                           "triangle " + std::to_string(i) + " names a vertex that is not there");
        }
        if (mesh.materials.empty() || mesh.materials[i] == kNoMaterial) continue;
        if (mesh.materials[i] >= block.materials.size() ||
            block.materials[mesh.materials[i]].texture >= static_cast<int>(block.textures.size())) {
            return failure("", block.name,
                           "triangle " + std::to_string(i) + " names a material that is not there");
        }
    }
    return {};
}

}  // namespace fb
