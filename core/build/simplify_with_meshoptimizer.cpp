#include <meshoptimizer.h>

#include <algorithm>

#include "build/simplify_mesh.h"

namespace fb {
namespace {

// In units of the mesh's longest side: clustering stops at the number of triangles alone.
constexpr float kNoErrorLimit = 1e3f;

void takeTriangles(const std::vector<std::uint32_t>& indices, std::size_t count, const SimplifyInput& input,
                   SimplifyOutput& output) {
    for (std::size_t i = 0; i < count; i += 3) {
        const glm::uvec3 t(indices[i], indices[i + 1], indices[i + 2]);
        const glm::uvec3 places(input.places[t.x], input.places[t.y], input.places[t.z]);
        if (places.x != places.y && places.y != places.z && places.z != places.x)
            output.triangles.push_back(t);
    }
}

}  // namespace

SimplifyOutput simplifyWithMeshoptimizer(const SimplifyInput& input) {
    SimplifyOutput output;
    if (input.triangles.empty()) return output;
    // Version 0.18 cannot be told which vertices to keep, but it keeps every position at which more than two
    // vertices lie: two that no triangle uses are put on each locked one.
    std::vector<glm::vec3> points = input.points;
    for (std::size_t i = 0; i < input.points.size(); ++i) {
        if (input.locked[i] != 0) points.insert(points.end(), 2, input.points[i]);
    }
    const std::size_t indices = input.triangles.size() * 3;
    std::vector<std::uint32_t> result(indices);
    float error = 0.0f;
    const std::size_t kept = meshopt_simplify(result.data(), &input.triangles[0].x, indices, &points[0].x,
                                              points.size(), sizeof(glm::vec3), input.targetTriangles * 3,
                                              static_cast<float>(kErrorLimit), 0, &error);
    output.errorGridUnits = static_cast<double>(error) * static_cast<double>(meshopt_simplifyScale(
                                                             &points[0].x, points.size(), sizeof(glm::vec3)));
    takeTriangles(result, kept, input, output);
    return output;
}

SimplifyOutput simplifySloppily(const SimplifyInput& input) {
    SimplifyOutput output;
    if (input.triangles.empty()) return output;
    const std::size_t indices = input.triangles.size() * 3;
    std::vector<std::uint32_t> result(indices);
    const std::size_t kept = meshopt_simplifySloppy(
        result.data(), &input.triangles[0].x, indices, &input.points[0].x, input.points.size(),
        sizeof(glm::vec3), input.targetTriangles * 3, kNoErrorLimit, nullptr);
    takeTriangles(result, kept, input, output);
    return output;
}

}  // namespace fb
