#include "select/surface_distance.h"

#include <gtest/gtest.h>

#include "worlds/random_worlds.h"

namespace fb {
namespace {

// 0 over all; 1 holds houses 3 (10 m away along x) and 4 (6 m); 2 is a house 20 m away. Everything but the houses'
// boxes contains the eye at the origin.
Hierarchy street() {
    Hierarchy h;
    h.resize(5);
    h.rootCount = 1;
    h.parent = {kNoNode, 0, 0, 1, 1};
    h.firstChild = {1, 3, kNoNode, kNoNode, kNoNode};
    h.childCount = {2, 2, 0, 0, 0};
    const auto house = [](float x) { return Box3f{glm::vec3(x, -1, -1), glm::vec3(x + 2, 1, 1)}; };
    h.bounds[2] = house(20);
    h.bounds[3] = house(10);
    h.bounds[4] = house(-8);
    h.bounds[1] = {glm::vec3(-8, -1, -1), glm::vec3(12, 1, 1)};
    h.bounds[0] = {glm::vec3(-8, -1, -1), glm::vec3(22, 1, 1)};
    return h;
}

TEST(SurfaceDistance, IsThatToTheNearestHouseInAStreet) {
    const Hierarchy h = street();
    EXPECT_EQ(surfaceDistance(h, 0, glm::dvec3(0)), 6.0);
    EXPECT_EQ(surfaceDistance(h, 1, glm::dvec3(0)), 6.0);
    EXPECT_EQ(surfaceDistance(h, 3, glm::dvec3(0)), 10.0);
    EXPECT_EQ(surfaceDistance(h, 0, glm::dvec3(16, 0, 0)), 4.0);  // beside 1, whose box counts, and before 2
    EXPECT_EQ(surfaceDistance(h, 0, glm::dvec3(-20, 0, 0)), 12.0) << "outside its own box";
}

TEST(SurfaceDistance, IsZeroInsideALeaf) {
    const Hierarchy h = street();
    EXPECT_EQ(surfaceDistance(h, 0, glm::dvec3(11, 0.5, 0)), 0.0);
    EXPECT_EQ(surfaceDistance(h, 3, glm::dvec3(11, 0.5, 0)), 0.0);
    EXPECT_EQ(surfaceDistance(h, 2, glm::dvec3(22, 1, 1)), 0.0) << "on its border";
}

// Never more than the distance to any leaf below, never less than that to the box.
TEST(SurfaceDistance, LiesBetweenTheBoxAndTheLeaves) {
    int larger = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const Hierarchy h = randomWorld(random);
        for (int i = 0; i < 20; ++i) {
            const NodeId node = static_cast<NodeId>(random.index(h.size()));
            const Box3f& box = h.bounds[node];
            glm::dvec3 eye;
            for (int axis = 0; axis < 3; ++axis) {
                eye[axis] = random.uniform(double{box.min[axis]} - 1.0, double{box.max[axis]} + 1.0);
            }
            const auto to = [&](NodeId n) {
                return Box3d{glm::dvec3(h.bounds[n].min), glm::dvec3(h.bounds[n].max)}.distance(eye);
            };
            const double distance = surfaceDistance(h, node, eye);
            ASSERT_GE(distance, to(node));
            if (distance > to(node)) ++larger;
            for (NodeId leaf = node; leaf < h.size(); ++leaf) {
                NodeId up = leaf;
                while (up != kNoNode && up != node) up = h.parent[up];
                if (up != node || !h.isLeaf(leaf)) continue;
                ASSERT_LE(distance, to(leaf));
            }
        }
    }
    EXPECT_GT(larger, 50);
}

}  // namespace
}  // namespace fb
