// The distance from one surface to another at points spread evenly over its area: mean, largest and where
// that is. Samples only: the largest one lies below the Hausdorff distance. The same points on every run.
#pragma once

#include <span>

#include "base/triangle_tree.h"

namespace fb::bench {

struct SampledDistance {
    double mean = 0.0, largest = 0.0;
    glm::vec3 worst{0.0f};           // a point of `from`
    std::uint32_t from = 0, to = 0;  // the triangles there
};

// `from` has some area, `to` some triangle.
[[nodiscard]] SampledDistance sampleDistance(std::span<const TriangleCorners> from, const TriangleTree& to,
                                             std::size_t samples);

struct TwoSided {
    SampledDistance toLevel, toSource;  // source to level, level to source

    [[nodiscard]] double mean() const { return std::max(toLevel.mean, toSource.mean); }
    [[nodiscard]] double largest() const { return std::max(toLevel.largest, toSource.largest); }
};

[[nodiscard]] TwoSided compareSurfaces(const TriangleTree& source, const TriangleTree& level,
                                       std::size_t samples);

}  // namespace fb::bench
