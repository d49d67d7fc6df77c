#include "draw/orient_triangles.h"

#include <array>
#include <cstring>

namespace fb {

void orientTriangles(const DecodedNode& content, std::uint8_t* into) {
    for (std::size_t i = 0; i + 2 < content.indices.size(); i += 3) {
        std::array<std::uint32_t, 3> corners = {content.indices[i], content.indices[i + 1], content.indices[i + 2]};
        std::array<glm::vec3, 3> positions;
        glm::vec3 normal(0.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            const GpuVertex& vertex = content.vertices[corners[c]];
            positions[c] = {vertex.position[0], vertex.position[1], vertex.position[2]};
            normal += decodeNormal(vertex.normal);
        }
        const glm::vec3 face = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
        if (glm::dot(face, normal) < 0.0f) std::swap(corners[1], corners[2]);
        std::memcpy(into + i * sizeof(std::uint32_t), corners.data(), sizeof(corners));
    }
}

}  // namespace fb
