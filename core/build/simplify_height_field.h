// Simplifies a piece of terrain so that it stays one: seen from above no triangle ever turns over, however
// steep the slopes. (The general simplifiers behind simplify_mesh.h fold cliffs.) Comes from terrain_tile.
// Edges are collapsed onto one of their ends, the cheapest first, so that vertices stay samples of the map;
// the cost is the sum of squared vertical distances to the planes of the triangles that were merged, weighted
// with their area (quadrics of Garland and Heckbert 1997, measured along the vertical), and of horizontal
// distances to the outlines of holes. Locked vertices stay where they are; vertices beside a hole move along
// its outline only.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fb {

struct HeightFieldPoint {
    std::int32_t across = 0, down = 0, height = 0;
    bool locked = false;
};

// Counter-clockwise triangles as seen from above in, with `down` growing towards the viewer; the same over
// fewer points out. More than `target` are left only where nothing can be collapsed any more.
[[nodiscard]] std::vector<glm::uvec3> simplifyHeightField(const std::vector<HeightFieldPoint>& points,
                                                          std::vector<glm::uvec3> triangles,
                                                          std::size_t target);

// Twice the area in plan; negative for a triangle that is seen from above.
[[nodiscard]] inline std::int64_t planArea(const HeightFieldPoint& a, const HeightFieldPoint& b,
                                           const HeightFieldPoint& c) {
    return std::int64_t{b.across - a.across} * (c.down - a.down) -
           std::int64_t{b.down - a.down} * (c.across - a.across);
}

}  // namespace fb
