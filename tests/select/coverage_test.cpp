#include "select/coverage.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "worlds/random_worlds.h"

namespace fb {
namespace {

// A megapixel: 1000 x 1000, 90 degrees both ways. What is 1 m ahead and 2 m wide covers all of it.
View megapixel() { return makeView(tinyCamera(), glm::dvec3(0.0), 1000, 1000); }

double covered(const std::vector<Box3f>& boxes, const View& view = megapixel()) {
    std::vector<TinyNode> nodes;
    for (const Box3f& box : boxes) nodes.push_back({.box = box});
    const Hierarchy h = makeWorld(nodes);
    std::vector<NodeId> all(h.size());
    for (NodeId n = 0; n < h.size(); ++n) all[n] = n;
    return coveredMegapixels(h, all, view);
}

TEST(CoveredMegapixels, OfNothingAndOfWhatIsOutOfViewIsNone) {
    EXPECT_EQ(covered({}), 0.0);
    EXPECT_EQ(covered({aside(), behind()}), 0.0);
}

TEST(CoveredMegapixels, IsThePartOfThePictureInFrontOfTheBox) {
    EXPECT_DOUBLE_EQ(covered({boxOf({-1, -1, -1.001f}, {1, 1, -1})}), 1.0);
    EXPECT_DOUBLE_EQ(covered({boxOf({-9, -9, -1.001f}, {9, 9, -1})}), 1.0);
    EXPECT_DOUBLE_EQ(covered({boxOf({-1, -1, -1.001f}, {0, 1, -1})}), 0.5);
    EXPECT_DOUBLE_EQ(covered({boxOf({-1, 0, -1.001f}, {0, 1, -1})}), 0.25);
}

TEST(CoveredMegapixels, CountsACellThatIsTouched) {
    EXPECT_DOUBLE_EQ(covered({boxOf({-1, -1, -1.001f}, {-0.99f, 1, -1})}), 1.0 / 64);
    EXPECT_DOUBLE_EQ(covered({boxOf({-0.1f, 0.51f, -1.001f}, {0.01f, 0.52f, -1})}), 5.0 / 64 / 36);
}

TEST(CoveredMegapixels, CountsAPlaceOnceHoweverManyBoxesAreThere) {
    const Box3f left = boxOf({-1, -1, -1.001f}, {0, 1, -1}), farther = boxOf({-2, -2, -2.001f}, {0, 2, -2});
    EXPECT_DOUBLE_EQ(covered({left, farther}), 0.5);
    EXPECT_DOUBLE_EQ(covered({left, boxOf({0, -1, -1.001f}, {1, 1, -1})}), 1.0);
}

TEST(CoveredMegapixels, OfABoxAroundTheEyeIsThePicture) {
    EXPECT_DOUBLE_EQ(covered({boxOf({-1, -1, -1}, {1, 1, 1})}), 1.0);
}

// Every point of a box that is in the picture lies in what it covers: adding a tiny box there adds nothing.
RC_GTEST_PROP(CoveredMegapixels, HoldsEveryPointOfEveryBox, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    const glm::dvec3 eye = randomPoint(r, 6.0), target = randomPoint(r, 6.0);
    const View view = makeView(lookAt(eye, target, {0, 1, 0}), glm::dvec3(0.0), 640, 360);
    const glm::dvec3 centre = randomPoint(r, 8.0), half = glm::abs(randomPoint(r, 2.0));
    const Box3f box = boxOf(glm::vec3(centre - half), glm::vec3(centre + half));
    const double alone = covered({box}, view);
    RC_ASSERT(alone <= 0.64 * 0.36 * (1.0 + 1e-12));
    for (int i = 0; i < 20; ++i) {
        const double x = r.uniform(), y = r.uniform(), z = r.uniform();
        const glm::vec3 point = glm::mix(box.min, box.max, glm::vec3(x, y, z));
        RC_ASSERT(covered({box, boxOf(point, point)}, view) <= alone * (1.0 + 1e-12));
    }
}

}  // namespace
}  // namespace fb
