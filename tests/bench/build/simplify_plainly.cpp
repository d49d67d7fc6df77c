#include "simplify_plainly.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace fb::bench {
namespace {

constexpr float kNoErrorLimit = 1e3f;  // in units of the mesh's longest side

}  // namespace

std::vector<TriangleCorners> WeldedMesh::cornersOf(std::span<const std::uint32_t> chosen) const {
    std::vector<TriangleCorners> result;
    for (std::size_t i = 0; i < chosen.size(); i += 3)
        result.push_back({points[chosen[i]], points[chosen[i + 1]], points[chosen[i + 2]]});
    return result;
}

WeldedMesh weldBlocks(std::span<const SourceBlock> blocks, const glm::dvec3& centre) {
    WeldedMesh mesh;
    std::map<std::tuple<double, double, double>, std::uint32_t> known;
    for (const SourceBlock& block : blocks) {
        std::vector<std::uint32_t> numbers;
        for (const glm::dvec3& p : block.mesh.positions) {
            const auto next = static_cast<std::uint32_t>(mesh.points.size());
            const auto [found, isNew] = known.try_emplace({p.x, p.y, p.z}, next);
            if (isNew) mesh.points.emplace_back(p - centre);
            numbers.push_back(found->second);
        }
        for (const glm::uvec3& t : block.mesh.triangles) {
            const glm::uvec3 welded(numbers[t.x], numbers[t.y], numbers[t.z]);
            if (welded.x == welded.y || welded.y == welded.z || welded.z == welded.x) continue;
            mesh.indices.insert(mesh.indices.end(), {welded.x, welded.y, welded.z});
        }
    }
    return mesh;
}

std::vector<std::uint32_t> simplifyPlainly(const WeldedMesh& mesh, std::size_t triangles) {
    std::vector<std::uint32_t> result(mesh.indices.size());
    const std::size_t target = std::min(triangles * 3, mesh.indices.size());
    result.resize(meshopt_simplify(result.data(), mesh.indices.data(), mesh.indices.size(), &mesh.points[0].x,
                                   mesh.points.size(), sizeof(glm::vec3), target, kNoErrorLimit, 0, nullptr));
    return result;
}

}  // namespace fb::bench
