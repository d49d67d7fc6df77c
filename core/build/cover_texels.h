// Marks the texels that a triangle touches: every texel whose square it overlaps by more than
// kTexelTolerance.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fb {

// Texture coordinates are floats: an edge meant to lie between two texels may lie beside it by this much (in
// texels).
inline constexpr double kTexelTolerance = 1.0 / 64.0;

// Corners in texels; they may reach beyond the picture, which then repeats. `shown` has width * height
// entries.
void coverTexels(const std::array<glm::dvec2, 3>& corners, int width, int height,
                 std::vector<std::uint8_t>& shown);

}  // namespace fb
