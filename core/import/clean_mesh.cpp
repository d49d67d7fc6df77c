#include "import/clean_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "import/first_appearance.h"
#include "import/mesh_file.h"

namespace fb {
namespace {

constexpr std::uint32_t kUnused = ~std::uint32_t{0};

// Sets what is not finite to 0, normals to unit length, and -0 to 0, so that equal values have equal bytes.
void repairAttributes(SourceMesh& mesh, ImportReport& report) {
    for (glm::dvec3& p : mesh.positions) p += 0.0;
    for (glm::vec3& n : mesh.normals) {
        const double length = glm::length(glm::dvec3(n));
        if (!std::isfinite(length)) ++report.repairedAttributes;
        const bool usable = std::isfinite(length) && length > 0.0;
        n = usable ? glm::vec3(glm::dvec3(n) / length) + 0.0f : glm::vec3(0.0f);
    }
    for (glm::vec2& uv : mesh.uvs) {
        if (std::isfinite(uv.x) && std::isfinite(uv.y)) {
            uv += 0.0f;
        } else {
            uv = glm::vec2(0.0f);
            ++report.repairedAttributes;
        }
    }
}

template <std::size_t Words>
class KeyWriter {
  public:
    template <class T>
    void add(const T& value) {
        const auto words = std::bit_cast<std::array<std::uint32_t, sizeof(T) / 4>>(value);
        std::copy(words.begin(), words.end(), key_.begin() + static_cast<std::ptrdiff_t>(used_));
        used_ += words.size();
    }
    [[nodiscard]] const std::array<std::uint32_t, Words>& key() const { return key_; }

  private:
    std::array<std::uint32_t, Words> key_{};
    std::size_t used_ = 0;
};

// Position 6 words, normal 3, texture coordinate 2, colour 1.
std::array<std::uint32_t, 12> vertexKey(const SourceMesh& mesh, std::size_t v) {
    KeyWriter<12> writer;
    writer.add(mesh.positions[v]);
    writer.add(mesh.hasNormals() ? mesh.normals[v] : glm::vec3(0.0f));
    writer.add(mesh.hasUvs() ? mesh.uvs[v] : glm::vec2(0.0f));
    writer.add(mesh.hasColours() ? mesh.colours[v] : glm::u8vec4(0));
    return writer.key();
}

// Refers every triangle to the first of equal vertices. Vertices that no triangle uses take no part.
void weld(SourceMesh& mesh, ImportReport& report) {
    std::vector<bool> isUsed(mesh.positions.size(), false);
    for (const glm::uvec3& t : mesh.triangles) isUsed[t.x] = isUsed[t.y] = isUsed[t.z] = true;
    FirstAppearance<12> vertices(mesh.positions.size() / 2);
    std::vector<std::uint32_t> firstOf;  // by number of appearance
    std::vector<std::uint32_t> same(mesh.positions.size(), kUnused);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (!isUsed[v]) continue;
        const std::uint32_t number = vertices.numberOf(vertexKey(mesh, v));
        if (number == firstOf.size()) {
            firstOf.push_back(v);
        } else {
            ++report.weldedVertices;
        }
        same[v] = firstOf[number];
    }
    for (glm::uvec3& t : mesh.triangles) t = {same[t.x], same[t.y], same[t.z]};
}

// Corners at one position, or an area of exactly 0.
bool isDegenerate(const SourceMesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a = mesh.positions[t.x];
    return glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a) == glm::dvec3(0.0);
}

// Turned so that the smallest index comes first: the same for each rotation, another for the other side.
std::array<std::uint32_t, 4> triangleKey(const glm::uvec3& t, std::uint32_t material) {
    if (t.y < t.x && t.y < t.z) return {t.y, t.z, t.x, material};
    if (t.z < t.x && t.z < t.y) return {t.z, t.x, t.y, material};
    return {t.x, t.y, t.z, material};
}

// Compacts triangles and materials to the ones worth keeping.
void dropTriangles(SourceMesh& mesh, ImportReport& report, std::vector<std::uint32_t>& kept) {
    FirstAppearance<4> seen(mesh.triangles.size());
    kept.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (isDegenerate(mesh, mesh.triangles[t])) {
            ++report.degenerateTriangles;
            continue;
        }
        const std::size_t before = seen.size();
        if (seen.numberOf(triangleKey(mesh.triangles[t], mesh.materials[t])) < before) {
            ++report.duplicateTriangles;
            continue;
        }
        mesh.triangles[kept.size()] = mesh.triangles[t];
        mesh.materials[kept.size()] = mesh.materials[t];
        kept.push_back(t);
    }
    mesh.triangles.resize(kept.size());
    mesh.materials.resize(kept.size());
    report.keptTriangles += kept.size();
}

template <class T>
void compact(std::vector<T>& attribute, const std::vector<std::uint32_t>& numbers, std::size_t count) {
    if (attribute.empty()) return;
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        if (numbers[v] != kUnused) attribute[numbers[v]] = attribute[v];
    }
    attribute.resize(count);
}

// Keeps the used vertices in their order.
void dropVertices(SourceMesh& mesh) {
    std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);
    for (const glm::uvec3& t : mesh.triangles) numbers[t.x] = numbers[t.y] = numbers[t.z] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t& number : numbers) {
        if (number != kUnused) number = count++;
    }
    compact(mesh.positions, numbers, count);
    compact(mesh.normals, numbers, count);
    compact(mesh.uvs, numbers, count);
    compact(mesh.colours, numbers, count);
    for (glm::uvec3& t : mesh.triangles) t = {numbers[t.x], numbers[t.y], numbers[t.z]};
}

}  // namespace

Result<void> cleanMesh(SourceMesh& mesh, const std::string& what, ImportReport& report,
                       std::vector<std::uint32_t>& kept) {
    if (mesh.materials.empty()) mesh.materials.assign(mesh.triangles.size(), kNoMaterial);
    if (Result<void> checked = checkMesh(mesh, what); !checked) return checked;
    const std::size_t verticesBefore = mesh.positions.size();
    const std::uint64_t weldedBefore = report.weldedVertices;
    repairAttributes(mesh, report);
    weld(mesh, report);
    dropTriangles(mesh, report, kept);
    dropVertices(mesh);
    report.droppedVertices += verticesBefore - mesh.positions.size() - (report.weldedVertices - weldedBefore);
    addMissingNormals(mesh);
    return {};
}

Result<void> cleanMesh(SourceMesh& mesh, const std::string& what, ImportReport& report) {
    std::vector<std::uint32_t> kept;
    return cleanMesh(mesh, what, report, kept);
}

}  // namespace fb
