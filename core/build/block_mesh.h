// A block on its integer grid, the form in which it is cut and simplified (thesis 3.2).
// Comes from quantise_block; split_mesh cuts it into pieces, simplify_level simplifies those, finish_node
// makes nodes. Positions are unique: two triangles that touch share position numbers, so a cut through a
// shared edge is computed once. A wedge is what a triangle sees of a position: texture coordinate, colour and
// surface; normals are kept apart, by corner, so that creases do not hinder the simplifiers.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/bounds.h"
#include "build/hash_index.h"
#include "scenefile/hierarchy.h"

namespace fb {

inline constexpr std::uint32_t kNone = HashIndex::kNone;

// Coordinates are below 2^24, so that they and the vertex format's unsigned numbers and floats agree exactly.
using GridPoint = glm::ivec3;
inline constexpr std::int32_t kGridSize = 1 << 24;

// What a triangle is covered with. Surface 0 is untextured.
struct Surface {
    int texture = -1;
    bool alphaMask = false;
};

struct Wedge {
    std::uint32_t position = 0;
    std::uint32_t surface = 0;
    glm::vec2 uv{0.0f};  // (0,0) on untextured surfaces
    glm::u8vec4 colour{255};
};

struct MeshTriangle {
    glm::uvec3 wedges;
    glm::uvec3 normals;  // kNone where the source has none
};

struct BlockMesh {
    BlockGrid grid;
    std::vector<GridPoint> positions;  // no two are equal
    HashIndex positionIndex;
    std::vector<std::uint8_t> onCut;          // by position: lies on a cutting plane
    std::vector<std::uint8_t> onBlockBorder;  // by position: the surface goes on in another block there; may be shorter than positions
    std::vector<Wedge> wedges;        // of the source no two are equal
    std::vector<glm::vec3> normals;   // unit
    std::vector<Surface> surfaces;

    [[nodiscard]] const GridPoint& at(std::uint32_t wedge) const { return positions[wedges[wedge].position]; }
    [[nodiscard]] bool isOnBlockBorder(std::uint32_t position) const {
        return position < onBlockBorder.size() && onBlockBorder[position] != 0;
    }
    [[nodiscard]] std::uint32_t findOrAddPosition(const GridPoint& point);
};

// All points with this coordinate on this axis.
struct CutPlane {
    int axis = 0;
    std::int32_t at = 0;

    auto operator<=>(const CutPlane&) const = default;
};

// One node's part of the original: triangles [begin, end) of its level.
struct Piece {
    std::uint32_t parent = 0;  // index of the piece of the level above
    std::uint32_t begin = 0, end = 0;
    std::vector<CutPlane> cuts{};  // where it was cut from its neighbours, at any level

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

struct Level {
    std::vector<MeshTriangle> triangles;
    std::vector<Piece> pieces;
};

// Twice the area times the normal, in grid units; exact, since every product is below 2^49.
[[nodiscard]] inline glm::dvec3 crossOf(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
}
// Of a triangle of positions that is not degenerate; unit.
[[nodiscard]] inline glm::dvec3 normalOf(const BlockMesh& mesh, const glm::uvec3& positions) {
    return glm::normalize(
        crossOf(mesh.positions[positions.x], mesh.positions[positions.y], mesh.positions[positions.z]));
}
[[nodiscard]] inline bool isDegenerate(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return crossOf(a, b, c) == glm::dvec3(0.0);
}
[[nodiscard]] inline bool isDegenerate(const BlockMesh& mesh, const glm::uvec3& wedges) {
    return isDegenerate(mesh.at(wedges.x), mesh.at(wedges.y), mesh.at(wedges.z));
}

}  // namespace fb
