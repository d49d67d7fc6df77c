// Many small parts keep their area, their places and their colours when few triangles are left for them.
#include "build/stand_ins.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/triangle_tree.h"

namespace fb {
namespace {

struct Parts {
    BlockMesh mesh;
    std::vector<glm::uvec3> triangles;

    std::uint32_t at(const glm::dvec3& p) { return mesh.findOrAddPosition(GridPoint(glm::round(p))); }

    void addBox(const glm::dvec3& low, const glm::dvec3& size) {
        std::array<std::uint32_t, 8> c;
        for (std::uint32_t i = 0; i < 8; ++i)
            c[i] = at(low + size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
        for (const glm::uvec4& q :
             {glm::uvec4(0, 2, 3, 1), {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
            triangles.emplace_back(c[q.x], c[q.y], c[q.z]);
            triangles.emplace_back(c[q.x], c[q.z], c[q.w]);
        }
    }
    // side x side boxes, 1000 apart.
    static Parts field(int side, double size = 400.0) {
        Parts parts;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) parts.addBox({x * 1000.0, y * 1000.0, 0}, glm::dvec3(size));
        return parts;
    }
    [[nodiscard]] TriangleCorners corners(const glm::uvec3& t) const {
        return {glm::vec3(mesh.positions[t.x]), glm::vec3(mesh.positions[t.y]),
                glm::vec3(mesh.positions[t.z])};
    }
    [[nodiscard]] double area(const std::vector<glm::uvec3>& of) const {
        double sum = 0.0;
        for (const glm::uvec3& t : of)
            sum += 0.5 * glm::length(crossOf(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]));
        return sum;
    }
    // The largest distance of a corner to the stand-ins.
    [[nodiscard]] double farthest(const std::vector<glm::uvec3>& from) const {
        std::vector<TriangleCorners> all;
        for (const glm::uvec3& t : from) all.push_back(corners(t));
        const TriangleTree tree(all);
        float worst = 0.0f;
        for (const glm::uvec3& t : triangles)
            for (const glm::vec3& p : corners(t)) worst = std::max(worst, tree.closest(p).squaredDistance);
        return std::sqrt(static_cast<double>(worst));
    }
};

StandIns standInsOf(Parts& parts, std::size_t aim) {
    Numbering numbering(parts.mesh.positions.size());
    return makeStandIns(parts.mesh, parts.triangles, aim, numbering);
}

TEST(StandIns, AreAsManyAsTheAimAllowsAndNearEveryPart) {
    Parts parts = Parts::field(20);  // 4,800 triangles
    for (const std::size_t aim : {1200u, 400u, 100u}) {
        const StandIns made = standInsOf(parts, aim);
        EXPECT_LE(made.triangles.size(), aim);
        EXPECT_GE(made.triangles.size(), aim * 9 / 10);
        const double spacing = 1000.0 * std::sqrt(400.0 * 4.0 / static_cast<double>(aim));
        EXPECT_LE(parts.farthest(made.triangles), 1.5 * spacing) << aim;
        EXPECT_EQ(std::ranges::count(made.replaced, 1), 4800);
    }
}

TEST(StandIns, KeepTheAreaAndStayWithinTheBounds) {
    Parts parts = Parts::field(20);
    const double area = parts.area(parts.triangles);
    const StandIns made = standInsOf(parts, 400);
    // A tetrahedron of a row of parts may fill their bounds before it has their area.
    EXPECT_LE(parts.area(made.triangles), 1.01 * area);
    EXPECT_GE(parts.area(made.triangles), 0.65 * area);
    for (const glm::uvec3& t : made.triangles) {
        for (const glm::vec3& p : parts.corners(t)) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, glm::vec3(0.0f))));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(p, glm::vec3(19400, 19400, 400))));
        }
    }
}

TEST(StandIns, FaceOutward) {
    Parts parts = Parts::field(8);
    const StandIns made = standInsOf(parts, 64);
    double volume = 0.0;
    for (const glm::uvec3& t : made.triangles) {
        const TriangleCorners c = parts.corners(t);
        volume += glm::dot(glm::dvec3(c[0]), glm::cross(glm::dvec3(c[1]), glm::dvec3(c[2]))) / 6.0;
    }
    EXPECT_GT(volume, 0.0);
}

TEST(StandIns, LeaveLargePartsAlone) {
    Parts parts = Parts::field(20);
    const std::size_t small = parts.triangles.size();
    for (int i = 0; i < 40; ++i) parts.addBox({30000, i * 1000.0, 0}, {400, 1000, 400});  // one long wall
    const StandIns made = standInsOf(parts, 1000);
    ASSERT_FALSE(made.empty());
    for (std::size_t t = 0; t < parts.triangles.size(); ++t)
        EXPECT_EQ(made.replaced[t], t < small ? 1 : 0) << t;
}

TEST(StandIns, AreNotMadeOfOneSurfaceFewPartsOrClutter) {
    Parts one;
    for (int i = 0; i < 100; ++i) one.addBox({i * 100.0, 0, 0}, glm::dvec3(100));  // they touch
    EXPECT_TRUE(standInsOf(one, 100).empty());
    Parts few = Parts::field(3);
    EXPECT_TRUE(standInsOf(few, 20).empty());
    Parts clutter = Parts::field(10, 20.0);
    clutter.addBox({0, 0, -90000}, glm::dvec3(10000));
    EXPECT_TRUE(standInsOf(clutter, 50).empty());
    Parts enough = Parts::field(10);
    EXPECT_TRUE(standInsOf(enough, enough.triangles.size()).empty());
}

// Two heaps of specks far from the ground and one just above it: one speck of each far heap is kept for all of it.
TEST(StandIns, KeepClutterOnlyWhereNothingElseIsNear) {
    Parts parts;
    for (int i = 0; i < 100; ++i) parts.addBox({i * 1000.0, 40000, 0}, glm::dvec3(1000));  // the ground: they touch
    const std::size_t ground = parts.triangles.size();
    const auto addHeap = [&](const glm::dvec3& at) {
        for (int i = 0; i < 10; ++i) parts.addBox(at + glm::dvec3(i * 50.0, 0, 0), glm::dvec3(20));
    };
    addHeap({50000, 60000, 0});
    addHeap({0, 25000, 0});
    addHeap({50000, 40500, 1600});
    const StandIns made = standInsOf(parts, 256);  // of which sixteen triangles at most
    EXPECT_EQ(made.triangles.size(), 8u);
    std::array<int, 4> replaced{};  // the ground and the heaps
    for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
        const std::size_t where = t < ground ? 0 : 1 + (t - ground) / 120;
        replaced[where] += made.replaced[t];
    }
    EXPECT_EQ(replaced, (std::array<int, 4>{0, 12, 12, 0}));
    const StandIns fewer = standInsOf(parts, 64);  // room for one: the farthest
    EXPECT_EQ(std::count(fewer.replaced.begin() + 1200, fewer.replaced.begin() + 1320, 1), 12);
    EXPECT_EQ(std::ranges::count(fewer.replaced, 1), 12);
}

RC_GTEST_PROP(StandIns, AreSoundForAnyParts, (std::uint64_t seed)) {
    Random random(seed);
    Parts parts;
    const auto count = static_cast<int>(1 + random.index(200));
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 low(random.uniform(0, 1e6), random.uniform(0, 1e6), random.uniform(0, 1e4));
        const double size = std::pow(10.0, random.uniform(0.3, 4.0));
        if (random.uniform() < 0.5) {
            parts.addBox(low, size * glm::dvec3(1, random.uniform(0.2, 1), random.uniform(0.2, 1)) + 1.0);
        } else {  // a leaf
            const auto corner = [&] {
                return low + size * glm::dvec3(random.uniform(), random.uniform(), random.uniform());
            };
            const glm::uvec3 t(parts.at(corner()), parts.at(corner()), parts.at(corner()));
            if (!isDegenerate(parts.mesh.positions[t.x], parts.mesh.positions[t.y],
                              parts.mesh.positions[t.z]))
                parts.triangles.push_back(t);
        }
    }
    Parts again = parts;
    const std::size_t aim = 1 + random.index(parts.triangles.size() + 1);
    const StandIns made = standInsOf(parts, aim);
    const StandIns same = standInsOf(again, aim);
    RC_ASSERT(made.triangles == same.triangles);
    RC_ASSERT(made.replaced == same.replaced);
    RC_ASSERT(made.empty() || made.replaced.size() == parts.triangles.size());
    RC_ASSERT(made.triangles.size() <= std::max<std::size_t>(aim, 4));
    for (const glm::uvec3& t : made.triangles)
        RC_ASSERT(
            !isDegenerate(parts.mesh.positions[t.x], parts.mesh.positions[t.y], parts.mesh.positions[t.z]));
}

}  // namespace
}  // namespace fb
