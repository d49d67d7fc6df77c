#include "build/measure_error.h"

#include <algorithm>
#include <cmath>

namespace fb {

double measureError(const BlockMesh& mesh, std::span<const MeshTriangle> piece,
                    std::span<const NodeTriangle> node, double simplifierError) {
    std::vector<TriangleCorners> corners;
    corners.reserve(node.size());
    for (const NodeTriangle& t : node) {
        corners.push_back({glm::vec3(mesh.positions[t.positions.x]), glm::vec3(mesh.positions[t.positions.y]),
                           glm::vec3(mesh.positions[t.positions.z])});
    }
    const TriangleTree tree(std::move(corners));

    std::vector<std::uint32_t> positions;
    positions.reserve(piece.size() * 3);
    for (const MeshTriangle& t : piece) {
        for (int k = 0; k < 3; ++k) positions.push_back(mesh.wedges[t.wedges[k]].position);
    }
    std::sort(positions.begin(), positions.end());
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    const std::size_t stride = (positions.size() + kErrorSamples - 1) / kErrorSamples;

    auto worst = static_cast<float>(simplifierError * simplifierError);
    ClosestPoint near;
    for (std::size_t i = 0; i < positions.size(); i += stride) {
        const glm::vec3 point(mesh.positions[positions[i]]);
        // Only distances beyond the worst so far matter: the search ends at the first triangle that is close
        // enough.
        ClosestPoint start;
        if (near.triangle != ~std::uint32_t{0}) start = tree.closestOn(near.triangle, point);
        near = start.squaredDistance <= worst
                   ? start
                   : tree.closest(point, start, worst, [](std::uint32_t) { return true; });
        worst = std::max(worst, near.squaredDistance);
    }
    return std::sqrt(static_cast<double>(worst)) + 1.0;
}

}  // namespace fb
