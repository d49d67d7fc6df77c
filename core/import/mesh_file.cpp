#include "import/mesh_file.h"

#include <cmath>

#include "import/import_limits.h"
#include "import/triangulate_polygon.h"

namespace fb {
namespace {

template <class T>
bool fits(const std::vector<T>& attribute, std::size_t vertices) {
    return attribute.empty() || attribute.size() == vertices;
}

}  // namespace

bool isUsablePosition(const glm::dvec3& p) {
    return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
           std::abs(p.z) <= kMaxCoordinate;
}

Result<void> checkMesh(const SourceMesh& mesh, const std::string& what) {
    const std::size_t vertices = mesh.positions.size();
    if (vertices > kMaxVertices || mesh.triangles.size() > kMaxTriangles) {
        return failure(what, {}, "has more than " + std::to_string(kMaxVertices) + " vertices or triangles",
                       "cut it into several files");
    }
    if (!fits(mesh.normals, vertices) || !fits(mesh.uvs, vertices) || !fits(mesh.colours, vertices) ||
        !fits(mesh.materials, mesh.triangles.size())) {
        return failure(what, {}, "has attributes that are not as many as its vertices or triangles");
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.triangles[t][corner];
            if (vertex >= vertices) {
                return failure(
                    what, "triangle " + std::to_string(t),
                    "refers to vertex " + std::to_string(vertex) + " of " + std::to_string(vertices));
            }
            if (!isUsablePosition(mesh.positions[vertex])) {
                return failure(what, "vertex " + std::to_string(vertex),
                               "has a coordinate that is not a finite number, or above 1e15");
            }
        }
    }
    return {};
}

void addPolygon(MeshFile& into, std::span<const std::uint32_t> corners, std::uint32_t material,
                std::uint32_t group, ImportReport& report) {
    SourceMesh& mesh = into.block.mesh;
    if (corners.size() < 3) {
        ++report.ignoredElements;
        return;
    }
    const std::size_t triangles = corners.size() - 2;
    if (triangles == 1) {
        mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
    } else {
        std::vector<glm::dvec3> positions;
        positions.reserve(corners.size());
        for (const std::uint32_t corner : corners) positions.push_back(mesh.positions[corner]);
        const std::size_t first = mesh.triangles.size();
        triangulatePolygon(positions, mesh.triangles);
        for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
            const glm::uvec3 local = mesh.triangles[t];
            mesh.triangles[t] = {corners[local.x], corners[local.y], corners[local.z]};
        }
    }
    mesh.materials.insert(mesh.materials.end(), triangles, material);
    into.groups.insert(into.groups.end(), triangles, group);
    report.sourceTriangles += triangles;
}

std::uint32_t UntexturedTwins::of(std::uint32_t material) {
    if (material >= block_.materials.size() || block_.materials[material].texture < 0) return material;
    const auto [at, isNew] =
        twins_.try_emplace(material, static_cast<std::uint32_t>(block_.materials.size()));
    if (isNew) {
        SourceMaterial twin = block_.materials[material];
        twin.name += " without texture coordinates";
        twin.texture = -1;
        twin.alphaMask = false;
        block_.materials.push_back(twin);
    }
    return at->second;
}

std::uint8_t toByte(double zeroToOne) {
    if (!(zeroToOne > 0.0)) return 0;
    return zeroToOne >= 1.0 ? 255 : static_cast<std::uint8_t>(zeroToOne * 255.0 + 0.5);
}

}  // namespace fb
