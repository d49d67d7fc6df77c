// The simplifiers behind one signature: triangles over vertices in, fewer triangles over the same vertices
// out. Comes from simplify_level. Vertices of one place (position number) are a seam: its sides move together
// or not at all, so what is seamless stays so; locked places stay. Neither library is asked to keep
// attributes, only to keep seams. meshoptimizer: quadric edge collapse (Garland and Heckbert 1997), about 50
// times faster. OpenMesh: its decimater with the same quadrics, in double precision, to check the other
// against.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fb {

// Simplification stops rather than move the surface by more than this share of the mesh's longest side.
inline constexpr double kErrorLimit = 0.1;

struct SimplifyInput {
    std::vector<glm::vec3> points;      // by vertex, grid units: whole numbers below 2^24, exact as floats
    std::vector<std::uint32_t> places;  // by vertex; equal exactly where points are equal
    std::vector<std::uint8_t> locked;   // by vertex
    std::vector<glm::uvec3> triangles;
    std::size_t targetTriangles = 0;
};

struct SimplifyOutput {
    std::vector<glm::uvec3> triangles;
    double errorGridUnits = 0.0;  // the largest that a collapse was worth (quadrics); 0: OpenMesh does not tell
    std::uint64_t carriedTriangles =
        0;  // non-manifold ones that OpenMesh could not connect, kept with locked corners
};

[[nodiscard]] SimplifyOutput simplifyWithMeshoptimizer(const SimplifyInput& input);
[[nodiscard]] SimplifyOutput simplifyWithOpenMesh(const SimplifyInput& input);

// Clusters vertices in cells: reaches nearly every aim, keeps neither seams, locks nor topology.
[[nodiscard]] SimplifyOutput simplifySloppily(const SimplifyInput& input);

}  // namespace fb
