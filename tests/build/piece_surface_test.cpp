#include "build/piece_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "block_worlds.h"
#include "build/quantise_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::makeSheet;

// Of all points within reach, the closest triangle that faces the right way is among the candidates.
RC_GTEST_PROP(PieceSurface, FindsTheClosestPointAmongItsCandidates, (std::uint64_t seed)) {
    Random random(seed);
    SourceMesh sheet = makeSheet({12, 12, 12.0, 12.0, [&](double, double) { return random.uniform(-0.8, 0.8); }});
    const SourceBlock block = blockOf(std::move(sheet));
    BlockTextures textures = decodeTextures(block);
    const QuantisedBlock quantised = quantiseBlock(block, textures);
    const PieceSurface surface(quantised.mesh, quantised.triangles, textures);
    const auto grid = static_cast<float>(1.0 / quantised.mesh.grid.step);
    const auto uniform = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)) * grid; };
    const glm::vec3 centre(uniform(0, 12), uniform(0, 12), uniform(-2, 2));
    const float reach = uniform(0.01, 1.0);
    const glm::vec3 normal = glm::normalize(glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + 1e-3f);
    std::vector<std::uint32_t> candidates;
    surface.findCandidates(centre, reach, normal, kNone, candidates);
    for (int i = 0; i < 30; ++i) {
        const glm::vec3 off(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const glm::vec3 point = centre + off * (static_cast<float>(random.uniform()) * reach / glm::length(off));
        const auto distance = [&](std::uint32_t triangle) {
            return std::sqrt(closestOnTriangle(point, surface.corners(triangle)).squaredDistance);
        };
        const float wanted = distance(surface.closest(point, normal, kNone).triangle);
        RC_ASSERT(std::ranges::any_of(
            candidates, [&](std::uint32_t candidate) { return distance(candidate) <= wanted + 1e-4f * grid; }));
    }
}

}  // namespace
}  // namespace fb
