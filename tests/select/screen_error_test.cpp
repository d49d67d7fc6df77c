#include "select/screen_error.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <array>
#include <cmath>

namespace fb {
namespace {

// 100 x 100 pixels at 90 degrees: K = 50, tan phi = sqrt(2), 1/cos^2 phi = 3. Eye at the origin, along -z.
View squareView() {
    View view;
    view.width = view.height = 100;
    view.camera.fovyRadians = glm::radians(90.0);
    view.pixelsPerUnit = 50.0;
    return view;
}

// A box `distance` metres in front of the eye with the given error and area.
void addNode(Hierarchy& hierarchy, float distance, float errorMetres, float areaSquareMetres) {
    hierarchy.parent.push_back(kNoNode);
    hierarchy.firstChild.push_back(kNoNode);
    hierarchy.childCount.push_back(0);
    hierarchy.bounds.push_back({glm::vec3(-1, -1, -distance - 1), glm::vec3(1, 1, -distance)});
    hierarchy.geometricErrorMetres.push_back(errorMetres);
    hierarchy.areaSquareMetres.push_back(areaSquareMetres);
}

// 0.5 * 50 / (2.5 - 0.5) * 3 = 37.5
TEST(NodeErrorPixels, IsTheBoundAtTheCornerOfThePicture) {
    Hierarchy hierarchy;
    addNode(hierarchy, 2.5f, 0.5f, 1.0f);
    EXPECT_DOUBLE_EQ(nodeErrorPixels(hierarchy, 0, squareView()), 37.5);
}

TEST(NodeErrorPixels, IsZeroWithoutGeometricError) {
    Hierarchy hierarchy;
    addNode(hierarchy, 2.0f, 0.0f, 1.0f);
    addNode(hierarchy, -0.5f, 0.0f, 1.0f);  // the eye is inside
    EXPECT_EQ(nodeErrorPixels(hierarchy, 0, squareView()), 0.0);
    EXPECT_EQ(nodeErrorPixels(hierarchy, 1, squareView()), 0.0);
}

TEST(NodeErrorPixels, IsTheDiagonalWhereTheErrorReachesTheEye) {
    Hierarchy hierarchy;
    addNode(hierarchy, 2.0f, 2.0f, 1.0f);    // as far as it is large
    addNode(hierarchy, -0.5f, 0.1f, 1.0f);   // inside
    addNode(hierarchy, 2.0f, 1.999f, 1.0f);  // a bound of 3e5 pixels
    for (NodeId node : {0u, 1u, 2u}) {
        EXPECT_DOUBLE_EQ(nodeErrorPixels(hierarchy, node, squareView()), std::sqrt(20000.0)) << node;
    }
}

// Errors 0.25*50/(2.75-0.25)*3 = 15 and 1*50/(26-1)*3 = 6. Weights 8*2500/2.75^2 = 2644.63 and 676*2500/676 =
// 2500.
TEST(FrontError, WeighsTheMeanByAreaOnTheScreen) {
    Hierarchy hierarchy;
    addNode(hierarchy, 2.75f, 0.25f, 8.0f);
    addNode(hierarchy, 26.0f, 1.0f, 676.0f);
    const std::array<NodeId, 2> front = {0, 1};
    const FrontError error = frontError(hierarchy, front, squareView());
    EXPECT_DOUBLE_EQ(error.maxPixels, 15.0);
    const double weight = 20000.0 / 7.5625;
    EXPECT_DOUBLE_EQ(error.meanPixels, (15.0 * weight + 6.0 * 2500.0) / (weight + 2500.0));
}

// The eye inside node 0: it weighs 10000 pixels, not infinitely much. Node 1: 0, 4 * 2500 / 4 = 2500 pixels.
TEST(FrontError, LetsNoNodeWeighMoreThanThePicture) {
    Hierarchy hierarchy;
    addNode(hierarchy, -0.5f, 0.1f, 1.0f);
    addNode(hierarchy, 2.0f, 0.0f, 4.0f);
    const std::array<NodeId, 2> front = {0, 1};
    const FrontError error = frontError(hierarchy, front, squareView());
    EXPECT_DOUBLE_EQ(error.meanPixels, std::sqrt(20000.0) * 10000.0 / 12500.0);
}

TEST(FrontError, OfNothingIsZero) {
    Hierarchy hierarchy;
    addNode(hierarchy, -0.5f, 0.0f, 0.0f);
    EXPECT_EQ(frontError(hierarchy, {}, squareView()).maxPixels, 0.0);
    EXPECT_EQ(frontError(hierarchy, {}, squareView()).meanPixels, 0.0);
    const std::array<NodeId, 1> front = {0};  // no area, eye inside
    EXPECT_EQ(frontError(hierarchy, front, squareView()).meanPixels, 0.0);
}

// A point of the picture moved by eps never moves further on the screen than the bound for its distance.
RC_GTEST_PROP(NodeErrorPixels, BoundsWhatAMovedPointMovesOnTheScreen, ()) {
    const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    View view;
    view.width = *rc::gen::inRange(50, 2000);
    view.height = *rc::gen::inRange(50, 2000);
    const double tangent = std::tan(glm::radians(*rc::gen::inRange(10, 120) / 2.0));
    view.pixelsPerUnit = view.height / 2.0 / tangent;
    const auto pixelOf = [&](const glm::dvec3& p) {
        return glm::dvec2(p.x, p.y) * (view.pixelsPerUnit / -p.z);
    };
    const auto inPicture = [&](const glm::dvec3& p) {
        const glm::dvec2 pixel = glm::abs(pixelOf(p));
        return p.z < 0.0 && pixel.x <= view.width / 2.0 && pixel.y <= view.height / 2.0;
    };

    const double depth = 10.0;
    const glm::dvec3 seen(part() * depth * tangent * view.width / view.height, part() * depth * tangent,
                          -depth);
    const double distance = glm::length(seen), eps = distance * *rc::gen::inRange(1, 300) / 1000.0;
    glm::dvec3 direction(part(), part(), part());
    RC_PRE(glm::length(direction) > 0.01);
    const glm::dvec3 moved = seen + glm::normalize(direction) * eps;
    RC_PRE(inPicture(moved));

    Hierarchy hierarchy;  // a box that touches the point and lies behind it
    addNode(hierarchy, 0.0f, static_cast<float>(eps), 1.0f);
    hierarchy.bounds[0] = {glm::vec3(seen), glm::vec3(seen)};
    const double bound = nodeErrorPixels(hierarchy, 0, view);
    RC_ASSERT(glm::length(pixelOf(moved) - pixelOf(seen)) <= bound * (1.0 + 1e-5));
}

}  // namespace
}  // namespace fb
