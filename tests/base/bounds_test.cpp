#include "base/bounds.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/random.h"

namespace fb {
namespace {

using V = glm::dvec3;

TEST(Box3, IsEmptyUntilItIsGrownByAPointAndIsThatPointThen) {
    Box3d box;
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(box.size(), V(0.0));
    EXPECT_EQ(box.diagonal(), 0.0);
    box.grow(V(1, -2, 3));
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.min, V(1, -2, 3));
    EXPECT_EQ(box.max, V(1, -2, 3));
}

TEST(Box3, GrownByAnEmptyBoxStaysAsItWas) {
    Box3d box{V(0), V(1)};
    box.grow(Box3d{});
    EXPECT_EQ(box.min, V(0.0));
    EXPECT_EQ(box.max, V(1.0));
}

TEST(Box3, ContainsItsSurfaceAndEveryEmptyBox) {
    const Box3d box{V(0), V(1, 2, 3)};
    EXPECT_TRUE(box.contains(V(0, 2, 3)));
    EXPECT_FALSE(box.contains(V(0, 2, 3.0000001)));
    EXPECT_TRUE(box.contains(box));
    EXPECT_TRUE(box.contains(Box3d{}));
    EXPECT_FALSE(box.contains(Box3d{V(0), V(1, 2, 4)}));
    EXPECT_FALSE(Box3d{}.contains(V(0.0)));
}

TEST(Box3, DistanceIsToTheNearestPointAndZeroInside) {
    const Box3d box{V(-1), V(1)};
    EXPECT_EQ(box.distance(V(0.5, 0.5, 0.5)), 0.0);
    EXPECT_EQ(box.distance(V(1, 1, 1)), 0.0);
    EXPECT_EQ(box.distance(V(3, 0, 0)), 2.0);   // a face
    EXPECT_EQ(box.distance(V(4, -5, 0)), 5.0);  // an edge: 3, 4
    EXPECT_EQ(box.distance(V(-2, 3, 3)), 3.0);  // a corner: 1, 2, 2
}

TEST(Box3, SizeCentreAndDiagonalOfAKnownBox) {
    const Box3d box{V(1, 2, 3), V(3, 5, 9)};
    EXPECT_EQ(box.size(), V(2, 3, 6));
    EXPECT_EQ(box.centre(), V(2, 3.5, 6));
    EXPECT_EQ(box.diagonal(), 7.0);
}

TEST(Box3, LongestAxisIsTheFirstOfEquals) {
    EXPECT_EQ((Box3d{V(0), V(1, 1, 1)}).longestAxis(), 0);
    EXPECT_EQ((Box3d{V(0), V(1, 2, 2)}).longestAxis(), 1);
    EXPECT_EQ((Box3d{V(0), V(2, 1, 2)}).longestAxis(), 0);
    EXPECT_EQ((Box3d{V(0), V(1, 2, 3)}).longestAxis(), 2);
}

RC_GTEST_PROP(Box3, GrowingMakesTheSmallestBoxOfThePoints, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Box3d box;
    V low(1e9), high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const V p(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
        box.grow(p);
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] < low[axis]) low[axis] = p[axis];
            if (p[axis] > high[axis]) high[axis] = p[axis];
        }
    }
    RC_ASSERT(box.min == low);
    RC_ASSERT(box.max == high);
    // No sampled point of the box is nearer than the distance says, and the clamped point is just that far.
    const V eye(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
    for (int i = 0; i < 50; ++i) {
        const V p(random.uniform(low.x, high.x), random.uniform(low.y, high.y),
                  random.uniform(low.z, high.z));
        RC_ASSERT(glm::length(p - eye) >= box.distance(eye) - 1e-12);
    }
    RC_ASSERT(std::abs(glm::length(glm::clamp(eye, low, high) - eye) - box.distance(eye)) < 1e-12);
}

}  // namespace
}  // namespace fb
