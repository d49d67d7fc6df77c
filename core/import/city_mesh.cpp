#include "import/city_mesh.h"

#include <cmath>
#include <utility>

namespace fb::city {

void MeshBuilder::addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                          std::uint32_t material) {
    const auto& p = mesh_.positions;
    const glm::dvec3 ac = p[c] - p[a], bd = p[d] - p[b];
    if (glm::dot(ac, ac) <= glm::dot(bd, bd)) {
        addTriangle(a, b, c, material);
        addTriangle(a, c, d, material);
    } else {
        addTriangle(a, b, d, material);
        addTriangle(b, c, d, material);
    }
}

void MeshBuilder::reserve(std::uint64_t triangles) {
    mesh_.triangles.reserve(triangles);
    mesh_.materials.reserve(triangles);
    mesh_.positions.reserve(triangles * 6 / 10);
    mesh_.uvs.reserve(triangles * 6 / 10);
}

SourceMesh MeshBuilder::finish() {
    std::vector<glm::dvec3> sums(mesh_.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh_.triangles) {
        const glm::dvec3 a = mesh_.positions[t.x], b = mesh_.positions[t.y], c = mesh_.positions[t.z];
        const glm::dvec3 area = glm::cross(b - a, c - a);
        sums[t.x] += area;
        sums[t.y] += area;
        sums[t.z] += area;
    }
    mesh_.normals.reserve(sums.size());
    for (const glm::dvec3& sum : sums) {
        const double length = std::sqrt(glm::dot(sum, sum));
        mesh_.normals.emplace_back(length > 0.0 ? sum / length : glm::dvec3(0.0));
    }
    return std::move(mesh_);
}

}  // namespace fb::city
