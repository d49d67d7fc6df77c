// What the builder promises of each node: an error that no point exceeds in either direction, and no gap where
// nodes of different levels meet.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/triangle_tree.h"
#include "built_block.h"

namespace fb {
namespace {

using test::blockOf;
using test::build;
using test::makeSheet;
using test::makeSphere;
using test::NodeView;
using test::settingsOf;

// A node's triangles on the block's grid.
TriangleTree treeOf(const BlockBuild& built, std::span<const std::size_t> nodes, bool withSkirts) {
    std::vector<TriangleCorners> triangles;
    for (const std::size_t node : nodes) {
        const NodeMesh& mesh = built.nodes[node].mesh;
        for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
            if (!withSkirts && mesh.isSkirt(t)) continue;
            TriangleCorners corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const NodeVertex& v = mesh.vertices[mesh.indices[t * 3 + k]];
                corners[k] = glm::vec3(v.x, v.y, v.z);
            }
            triangles.push_back(corners);
        }
    }
    return TriangleTree(std::move(triangles));
}

std::vector<std::size_t> leavesBelow(const BlockBuild& built, std::size_t node) {
    std::vector<std::size_t> leaves;
    for (std::size_t i = node; i < built.nodes.size(); ++i) {
        if (built.block.nodes[i].childCount > 0) continue;
        std::size_t up = i;
        while (up > node) up = built.block.nodes[up].parentInBlock;
        if (up == node) leaves.push_back(i);
    }
    return leaves;
}

// Random points of `from`, as many as `points`, more on larger triangles; the largest distance to `to`, grid units.
double farthestSample(const TriangleTree& from, const TriangleTree& to, Random& random, std::size_t points) {
    double worst = 0.0;
    const std::size_t each = std::max<std::size_t>(8, points / from.triangles().size());
    for (const TriangleCorners& t : from.triangles()) {
        for (std::size_t i = 0; i < each; ++i) {
            auto u = static_cast<float>(random.uniform()), v = static_cast<float>(random.uniform());
            if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
            const ClosestPoint at = to.closest(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
            worst = std::max(worst, static_cast<double>(at.squaredDistance));
        }
    }
    return std::sqrt(worst);
}

// Float positions of sampled points are off by up to a few grid steps.
constexpr double kRoundingUnits = 4.0;

void checkErrors(const BlockBuild& built, Random& random) {
    for (std::size_t n = 0; n < built.nodes.size(); ++n) {
        const BuiltNode& node = built.block.nodes[n];
        if (node.childCount == 0) {
            RC_ASSERT(node.geometricErrorMetres == 0.0f);
            continue;
        }
        const std::vector<std::size_t> leaves = leavesBelow(built, n);
        const std::array self = {n};
        const TriangleTree drawn = treeOf(built, self, false), source = treeOf(built, leaves, false);
        const double bound = static_cast<double>(node.geometricErrorMetres) / built.block.grid.step;
        RC_ASSERT(bound + kRoundingUnits >= farthestSample(source, drawn, random, 200));
        RC_ASSERT(bound + kRoundingUnits >= farthestSample(drawn, source, random, 200));
        const BuiltNode& parent = built.block.nodes[node.parentInBlock];
        RC_ASSERT(parent.geometricErrorMetres >= node.geometricErrorMetres);
    }
}

SourceMesh hills(Random& random, double width) {
    const double a = random.uniform(0.2, 3.0), b = random.uniform(0.2, 3.0), rough = random.uniform(0.0, 0.6);
    return makeSheet({20 + static_cast<int>(random.index(30)), 20 + static_cast<int>(random.index(30)), width, width,
                      [=](double x, double y) {
                          return width * 0.03 * (std::sin(20 * a * x / width) * std::cos(20 * b * y / width) +
                                                 rough * std::sin(913.7 * x / width + 517.3 * y / width));
                      }});
}

RC_GTEST_PROP(GeometricError, IsNotExceededOnHills, (std::uint64_t seed)) {
    Random random(seed);
    const double width = random.index(3) == 0 ? 1e-6 : (random.index(2) == 0 ? 1e7 : 40.0);
    checkErrors(build(blockOf(hills(random, width)), settingsOf(32 + static_cast<std::int64_t>(random.index(60)), 4)),
                random);
}

// Several closed bodies, some of which vanish in coarse levels.
RC_GTEST_PROP(GeometricError, IsNotExceededOnManyBodies, (std::uint64_t seed)) {
    Random random(seed);
    SourceMesh all;
    for (std::uint64_t i = 0; i < 2 + random.index(12); ++i) {
        const SourceMesh one = makeSphere(4 + static_cast<int>(random.index(8)), 3 + static_cast<int>(random.index(6)));
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        const double size = random.uniform(0.01, 1.0);
        const glm::dvec3 at(random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9));
        for (const glm::dvec3& p : one.positions) all.positions.push_back(at + p * size);
        for (const glm::uvec3& t : one.triangles) all.triangles.push_back(t + first);
    }
    checkErrors(build(blockOf(all), settingsOf(24, 2 + static_cast<std::int64_t>(random.index(4)))), random);
}

RC_GTEST_PROP(GeometricError, IsNotExceededOnSoups, (std::uint64_t seed)) {
    Random random(seed);
    SourceMesh soup;
    const std::uint64_t points = 5 + random.index(80), shape = random.index(3);
    for (std::uint64_t i = 0; i < points; ++i) {
        glm::dvec3 p(random.uniform(), random.uniform(), random.uniform());
        if (shape == 1) p.z = 0.25;
        if (shape == 2) p *= glm::dvec3(1.0, 1e-4, 1.0);
        soup.positions.push_back(p * 30.0);
    }
    for (std::uint64_t i = 0; i < 1 + random.index(150); ++i)
        soup.triangles.emplace_back(random.index(points), random.index(points), random.index(points));
    checkErrors(build(blockOf(soup), settingsOf(16, 4)), random);
}

// A front: each node is drawn or all its children are, by chance.
std::vector<std::size_t> mixedFront(const BlockBuild& built, Random& random) {
    std::vector<std::size_t> front;
    std::vector<bool> reached(built.nodes.size(), false);
    reached[0] = true;
    for (std::size_t n = 0; n < built.nodes.size(); ++n) {
        const BuiltNode& node = built.block.nodes[n];
        if (n > 0 && !reached[n]) continue;
        if (node.childCount == 0 || (n > 0 && random.index(2) == 0)) {
            front.push_back(n);
            continue;
        }
        for (std::size_t c = n + 1; c < built.nodes.size(); ++c) {
            if (built.block.nodes[c].parentInBlock == n) reached[c] = true;
        }
    }
    return front;
}

bool hits(const TriangleTree& tree, const glm::dvec3& origin, const glm::dvec3& direction) {
    for (const TriangleCorners& t : tree.triangles()) {
        const glm::dvec3 a(t[0]), e1 = glm::dvec3(t[1]) - a, e2 = glm::dvec3(t[2]) - a;
        const glm::dvec3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) continue;
        const glm::dvec3 s = origin - a;
        const double u = glm::dot(s, p) / det;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) / det;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(e2, q) / det > 0.0) return true;
    }
    return false;
}

// Looked at from above, at up to 60 degrees, a hilly ground whose nodes are of all levels shows no hole; without the
// skirts it does.
TEST(Skirts, CloseTheGapsBetweenLevels) {
    Random random(7);
    int gapsWithout = 0, fronts = 0;
    for (int round = 0; round < 12; ++round) {
        const BlockBuild built = build(blockOf(hills(random, 40.0)), settingsOf(64, 4));
        const std::vector<std::size_t> front = mixedFront(built, random);
        const TriangleTree with = treeOf(built, front, true), without = treeOf(built, front, false);
        fronts += front.size() > 4 ? 1 : 0;
        const double unit = 1.0 / built.block.grid.step;
        for (int i = 0; i < 1500; ++i) {
            const double around = random.uniform(0.0, 6.283), tilt = random.uniform(0.0, 1.05);
            const glm::dvec3 direction(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), -std::cos(tilt));
            // Aimed at a point near the ground, far enough from the sheet's own edges.
            const glm::dvec3 aim(random.uniform(8.0, 32.0), random.uniform(8.0, 32.0), 0.0);
            const glm::dvec3 origin = (aim - built.block.grid.origin - 10.0 * direction) * unit;
            const bool closed = hits(with, origin, direction);
            gapsWithout += hits(without, origin, direction) ? 0 : 1;
            EXPECT_TRUE(closed) << "round " << round << " ray " << i;
        }
    }
    EXPECT_GT(fronts, 6);
    EXPECT_GT(gapsWithout, 0);

}

// Straight cuts through flat ground agree at all levels but for how they are divided: the coarser levels' edges have
// narrow skirts against pinholes, a 64th of their length deep; leaves have none.
TEST(Skirts, AreNarrowWhereLevelsAgree) {
    const BlockBuild flat = build(blockOf(makeSheet({40, 40, 40.0, 40.0, {}})), settingsOf(64, 4));
    EXPECT_GT(flat.nodes.size(), 4u);
    std::uint64_t skirts = 0;
    for (std::size_t n = 0; n < flat.nodes.size(); ++n) {
        const BuiltNode& node = flat.block.nodes[n];
        skirts += node.skirtTriangles;
        EXPECT_EQ(node.borderErrorMetres, 0.0f);
        EXPECT_TRUE(node.childCount > 0 || node.skirtTriangles == 0u);
        EXPECT_GT(node.bounds.min.z, -0.8f);  // edges of at most 40 m, and a quarter to spare
        EXPECT_EQ(node.bounds.max.z, 0.0f);
    }
    EXPECT_GT(skirts, 0u);
}

// A scrap that hovers over the border that the ground has in common with another block is gone in coarse levels: what
// is left of the border there is far below it, but there is no gap between the two.
TEST(Skirts, DoNotReachForWhatIsGone) {
    Random random(11);
    SourceMesh mesh = hills(random, 40.0);
    mesh.shared.resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) mesh.shared[v] = mesh.positions[v].x == 40.0 ? 1 : 0;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), {0.2, 0, 0}, {0, 0.2, 0}, {0.2, 0.2, 0}}) {
        mesh.positions.push_back(p + glm::dvec3(38, 20, 15));
        mesh.uvs.emplace_back(0.0f);
        mesh.shared.push_back(1);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first + 2, first + 1, first + 3);
    const BlockBuild built = build(blockOf(mesh), settingsOf(24, 4));
    const double error = static_cast<double>(built.block.nodes[0].geometricErrorMetres);
    EXPECT_GT(error, 10.0);  // the scrap is gone
    float deepest = 0.0f;
    for (const BuiltNode& node : built.block.nodes) deepest = std::max(deepest, node.borderErrorMetres);
    EXPECT_GT(deepest, 0.0f);
    EXPECT_LT(deepest, 4.0f);
}

TEST(Skirts, CountNeitherInAreaNorInTheBenefit) {
    Random random(3);
    const BlockBuild built = build(blockOf(hills(random, 40.0)), settingsOf(64, 4));
    std::uint64_t skirts = 0;
    for (std::size_t n = 0; n < built.nodes.size(); ++n) {
        const BuiltNode& node = built.block.nodes[n];
        skirts += node.skirtTriangles;
        EXPECT_EQ(node.skirtTriangles, built.nodes[n].mesh.texturedSkirts + built.nodes[n].mesh.untexturedSkirts);
        const auto surface = static_cast<float>(test::trianglesOf(node) - node.skirtTriangles);
        EXPECT_NEAR(node.staticBenefit, std::sqrt(surface * node.areaSquareMetres), 1e-3f * node.staticBenefit);
        EXPECT_TRUE(node.borderErrorMetres == 0.0f || node.skirtTriangles > 0u);
    }
    EXPECT_GT(skirts, 0u);
}

}  // namespace
}  // namespace fb
