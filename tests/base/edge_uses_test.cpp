#include "base/edge_uses.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

namespace fb {
namespace {

std::vector<EdgeUse> usesOf(std::span<const glm::uvec3> triangles) {
    std::vector<EdgeUse> uses;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) uses.push_back(edgeUse(triangles[t], t, k));
    }
    return uses;
}

TEST(EdgeUses, BringsTheTwoSidesOfAnEdgeTogether) {
    const std::vector<glm::uvec3> triangles = {{7, 3, 9}, {3, 7, 1}};
    std::vector<EdgeUse> uses = usesOf(triangles), shared;
    int edges = 0;
    visitEdges(uses, [&](std::span<const EdgeUse> of) {
        ++edges;
        if (of.size() > 1) shared.assign(of.begin(), of.end());
    });
    EXPECT_EQ(edges, 5);
    EXPECT_EQ(shared, (std::vector<EdgeUse>{{3, 7, 0, 0}, {3, 7, 1, 0}}));
}

TEST(EdgeUses, VisitsNothingWithoutTriangles) {
    std::vector<EdgeUse> none;
    visitEdges(none, [](std::span<const EdgeUse>) { FAIL(); });
}

RC_GTEST_PROP(EdgeUses, EachSideOfEachTriangleIsVisitedOnceWithItsEdge, ()) {
    const auto corners = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, 8));
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> expected;
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) ++expected[std::minmax(t[k], t[(k + 1) % 3])];
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> seen;
    std::pair<std::uint32_t, std::uint32_t> before(0, 0);
    std::vector<EdgeUse> uses = usesOf(triangles);
    visitEdges(uses, [&](std::span<const EdgeUse> of) {
        const std::pair<std::uint32_t, std::uint32_t> edge(of.front().low, of.front().high);
        RC_ASSERT(seen.empty() || before < edge);
        seen[edge] = of.size();
        before = edge;
        for (const EdgeUse& use : of) RC_ASSERT(edgeUse(triangles[use.triangle], use.triangle, use.corner) == use);
        RC_ASSERT(std::is_sorted(of.begin(), of.end()));
    });
    RC_ASSERT(seen == expected);
}

}  // namespace
}  // namespace fb
