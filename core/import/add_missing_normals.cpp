#include <array>
#include <bit>

#include "import/clean_mesh.h"
#include "import/first_appearance.h"

namespace fb {
namespace {

// Sums shorter than this part of the areas that went into them are rounding, not direction.
constexpr double kCancelled = 1e-9;

struct Sum {
    glm::dvec3 vectorArea{0.0};
    glm::dvec3 first{0.0};
    double area = 0.0;
};

}  // namespace

void addMissingNormals(SourceMesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    mesh.normals.resize(vertices, glm::vec3(0.0f));
    bool anyMissing = false;
    for (const glm::vec3& normal : mesh.normals) anyMissing = anyMissing || normal == glm::vec3(0.0f);
    if (!anyMissing) return;

    FirstAppearance<6> positions(vertices / 2);
    std::vector<std::uint32_t> positionOf(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        positionOf[v] = positions.numberOf(std::bit_cast<std::array<std::uint32_t, 6>>(mesh.positions[v]));
    }
    std::vector<Sum> sums(positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x];
        const glm::dvec3 twice = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        for (int corner = 0; corner < 3; ++corner) {
            Sum& sum = sums[positionOf[t[corner]]];
            if (sum.area == 0.0) sum.first = twice;
            sum.vectorArea += twice;
            sum.area += glm::length(twice);
        }
    }
    for (std::size_t v = 0; v < vertices; ++v) {
        if (mesh.normals[v] != glm::vec3(0.0f)) continue;
        const Sum& sum = sums[positionOf[v]];
        const bool cancelled = glm::length(sum.vectorArea) <= kCancelled * sum.area;
        const glm::dvec3 direction = cancelled ? sum.first : sum.vectorArea;
        const double length = glm::length(direction);
        if (length > 0.0) mesh.normals[v] = glm::vec3(direction / length);
    }
}

}  // namespace fb
