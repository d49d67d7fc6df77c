#include "sample_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/random.h"

namespace fb::bench {
namespace {

double areaOf(const TriangleCorners& t) {
    return 0.5 *
           glm::length(glm::cross(glm::dvec3(t[1]) - glm::dvec3(t[0]), glm::dvec3(t[2]) - glm::dvec3(t[0])));
}

glm::vec3 pointOn(const TriangleCorners& t, Random& random) {
    const double root = std::sqrt(random.uniform());
    const double share = random.uniform();
    const glm::dvec3 weights(1.0 - root, root * (1.0 - share), root * share);
    return glm::vec3(weights.x * glm::dvec3(t[0]) + weights.y * glm::dvec3(t[1]) +
                     weights.z * glm::dvec3(t[2]));
}

}  // namespace

SampledDistance sampleDistance(std::span<const TriangleCorners> from, const TriangleTree& to,
                               std::size_t samples) {
    double area = 0.0;
    for (const TriangleCorners& t : from) area += areaOf(t);
    FB_CHECK(area > 0.0);
    SampledDistance result;
    Random random(1);
    // One point in each of `samples` equal parts of the area, in the order of the triangles.
    std::uint32_t at = 0, near = 0;
    double upToHere = areaOf(from[0]);
    for (std::size_t i = 0; i < samples; ++i) {
        const double wanted =
            area * (static_cast<double>(i) + random.uniform()) / static_cast<double>(samples);
        while (upToHere < wanted && at + 1 < from.size()) upToHere += areaOf(from[++at]);
        const glm::vec3 p = pointOn(from[at], random);
        // The last answer bounds the search: the next point is often close.
        const ClosestPoint closest =
            to.closest(p, to.closestOn(near, p), -1.0f, [](std::uint32_t) { return true; });
        near = closest.triangle;
        const double distance = std::sqrt(static_cast<double>(closest.squaredDistance));
        result.mean += distance / static_cast<double>(samples);
        if (distance <= result.largest) continue;
        result.largest = distance;
        result.worst = p;
        result.from = at;
        result.to = near;
    }
    return result;
}

TwoSided compareSurfaces(const TriangleTree& source, const TriangleTree& level, std::size_t samples) {
    return {sampleDistance(source.triangles(), level, samples),
            sampleDistance(level.triangles(), source, samples)};
}

}  // namespace fb::bench
