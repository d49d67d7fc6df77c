// Finds the texels that a triangle touches: every texel whose square it overlaps by more than
// kTexelTolerance.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

namespace fb {

// Texture coordinates are floats: an edge meant to lie between two texels may lie beside it by this much (in
// texels).
inline constexpr double kTexelTolerance = 1.0 / 64.0;

// Texels [begin, end) of a row, inside the picture.
using TexelSpanVisitor = std::function<void(int row, int begin, int end)>;

// Corners in texels; they may reach beyond the picture, which then repeats. Spans may overlap.
void coverTexels(const std::array<glm::dvec2, 3>& corners, int width, int height,
                 const TexelSpanVisitor& visit);

}  // namespace fb
