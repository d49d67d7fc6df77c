#include "build/finish_node.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/hash.h"

namespace fb {
namespace {

std::uint16_t toUnorm16(float texel, int side) {
    const float share = glm::clamp(texel / static_cast<float>(side), 0.0f, 1.0f);
    return static_cast<std::uint16_t>(std::lround(share * 65535.0f));
}

class VertexMaker {
  public:
    std::uint32_t findOrAdd(const NodeVertex& vertex) {
        const std::uint64_t hash = hashBytes(&vertex, sizeof(vertex));
        const std::uint32_t found = index_.find(
            hash, [&](std::uint32_t i) { return std::memcmp(&vertices[i], &vertex, sizeof(vertex)) == 0; });
        if (found != kNone) return found;
        index_.insert(hash, static_cast<std::uint32_t>(vertices.size()));
        vertices.push_back(vertex);
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }

    std::vector<NodeVertex> vertices;

  private:
    HashIndex index_;
};

float roundDown(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) > value
               ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
               : rounded;
}

float roundUp(double value) {
    return -roundDown(-value);
}

}  // namespace

NodeMesh makeNodeMesh(const BlockMesh& mesh, std::span<const NodeTriangle> triangles, int atlasWidth,
                      int atlasHeight) {
    NodeMesh result;
    VertexMaker maker;
    std::array<std::vector<std::uint32_t>, 4> parts;  // textured, its skirts, untextured, its skirts
    for (const NodeTriangle& triangle : triangles) {
        const bool textured = triangle.chart != kNone;
        result.flags.alphaMask = result.flags.alphaMask || mesh.surfaces[triangle.surface].alphaMask;
        for (std::size_t k = 0; k < 3; ++k) {
            const GridPoint& at = mesh.positions[triangle.positions[static_cast<int>(k)]];
            NodeVertex vertex{static_cast<std::uint32_t>(at.x),
                              static_cast<std::uint32_t>(at.y),
                              static_cast<std::uint32_t>(at.z),
                              {},
                              0,
                              0,
                              {}};
            encodeNormal(triangle.normals[k], vertex.normal);
            if (textured) {
                vertex.u = toUnorm16(triangle.texels[k].x, atlasWidth);
                vertex.v = toUnorm16(triangle.texels[k].y, atlasHeight);
            }
            for (int c = 0; c < 4; ++c) vertex.colour[c] = triangle.colours[k][c];
            result.flags.alphaMask = result.flags.alphaMask || vertex.colour[3] != 255;
            parts[(textured ? 0 : 2) + (triangle.skirt ? 1 : 0)].push_back(maker.findOrAdd(vertex));
        }
    }
    for (const std::vector<std::uint32_t>& part : parts)
        result.indices.insert(result.indices.end(), part.begin(), part.end());
    const auto triangleCount = [](const auto& part) { return static_cast<std::uint32_t>(part.size() / 3); };
    result.texturedSkirts = triangleCount(parts[1]);
    result.untexturedSkirts = triangleCount(parts[3]);
    result.texturedTriangles = triangleCount(parts[0]) + result.texturedSkirts;
    result.untexturedTriangles = triangleCount(parts[2]) + result.untexturedSkirts;
    result.vertices = std::move(maker.vertices);
    return result;
}

void measureNode(const BlockMesh& mesh, std::span<const NodeTriangle> triangles, const NodeMesh& made,
                 BuiltNode& node) {
    const double step = mesh.grid.step;
    glm::dvec3 normals(0.0);
    double area = 0.0;
    GridPoint low(kGridSize), high(-1);
    for (const NodeTriangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, mesh.positions[t.positions[k]]);
            high = glm::max(high, mesh.positions[t.positions[k]]);
        }
        if (t.skirt) continue;
        const glm::dvec3 cross = crossOf(mesh.positions[t.positions.x], mesh.positions[t.positions.y],
                                         mesh.positions[t.positions.z]);
        normals += 0.5 * cross;
        area += 0.5 * glm::length(cross);
    }
    node.texturedTriangles = made.texturedTriangles;
    node.untexturedTriangles = made.untexturedTriangles;
    node.skirtTriangles = made.texturedSkirts + made.untexturedSkirts;
    node.vertices = static_cast<std::uint32_t>(made.vertices.size());
    const double squareMetres = area * step * step;
    const auto surfaceTriangles = static_cast<double>(triangles.size() - node.skirtTriangles);
    node.areaSquareMetres = static_cast<float>(squareMetres);
    node.staticBenefit = static_cast<float>(std::sqrt(surfaceTriangles * squareMetres));
    const double length = glm::length(normals);
    // Directions that cancel out have no average: (0,0,0), and foreshortening then does nothing.
    node.averageNormal = length < 1e-3 * area ? glm::vec3(0.0f) : glm::vec3(normals / length);
    node.normalCoherence = area > 0.0 ? static_cast<float>(std::min(1.0, length / area)) : 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        node.bounds.min[axis] = roundDown(mesh.grid.origin[axis] + step * low[axis]);
        node.bounds.max[axis] = roundUp(mesh.grid.origin[axis] + step * high[axis]);
    }
}

}  // namespace fb
