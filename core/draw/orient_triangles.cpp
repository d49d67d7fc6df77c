#include "draw/orient_triangles.h"

#include <array>
#include <cstring>
#include <utility>

namespace fb {

void orientTriangles(const DecodedNode& content, std::vector<glm::vec3>& normals, std::uint8_t* into) {
    normals.clear();
    for (const GpuVertex& vertex : content.vertices) normals.push_back(decodeNormal(vertex.normal));
    for (std::size_t i = 0; i + 2 < content.indices.size(); i += 3) {
        std::array<std::uint32_t, 3> corners = {content.indices[i], content.indices[i + 1],
                                                content.indices[i + 2]};
        std::array<glm::vec3, 3> positions;
        glm::vec3 normal(0.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            const float* position = content.vertices[corners[c]].position;
            positions[c] = {position[0], position[1], position[2]};
            normal += normals[corners[c]];
        }
        const glm::vec3 face = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
        if (glm::dot(face, normal) < 0.0f) std::swap(corners[1], corners[2]);
        std::memcpy(into + i * sizeof(std::uint32_t), corners.data(), sizeof(corners));
    }
}

}  // namespace fb
