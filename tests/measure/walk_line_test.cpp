#include "measure/walk_line.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

constexpr GroundAxes kYUp{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

double difference(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b);
}

TEST(WalkLine, IsTheLineItselfAwayFromCorners) {
    const WalkLine line({{0, 0, 0}, {20, 0, 0}, {20, 0, 30}}, kYUp, 100.0, 4.0, 6.0);
    EXPECT_DOUBLE_EQ(line.lengthMetres(), 50.0);
    EXPECT_LT(difference(line.placeAt(0.0), {0, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(10.0), {10, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(35.0), {20, 0, 15}), 1e-12);
    EXPECT_NEAR(line.headingAt(10.0), 0.0, 1e-15);
    EXPECT_NEAR(line.headingAt(35.0), -0.25, 1e-15);  // +z is a quarter turn to the right of +x
}

// Over 2 m before and 2 m behind the corner the mean stays back by 4/4/2 = 0.5 m on each leg.
TEST(WalkLine, RoundsCornersByTheMeanOfTheWay) {
    const WalkLine line({{0, 0, 0}, {20, 0, 0}, {20, 0, 30}}, kYUp, 100.0, 4.0, 6.0);
    EXPECT_LT(difference(line.placeAt(20.0), {19.5, 0, 0.5}), 1e-12);
    EXPECT_NEAR(line.headingAt(20.0), -0.125, 1e-15);
}

TEST(WalkLine, WalksAnOpenLineBackAndForth) {
    const WalkLine line({{0, 0, 0}, {20, 0, 0}}, kYUp, 100.0, 4.0, 6.0);
    EXPECT_LT(difference(line.placeAt(30.0), {10, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(50.0), {10, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(20.0), {19, 0, 0}), 1e-12);  // the mean of 18 to 20 and back
    EXPECT_NEAR(std::abs(line.headingAt(30.0)), 0.5, 1e-15);
    EXPECT_NEAR(std::abs(line.headingAt(20.0)), 0.25, 1e-15);
    EXPECT_LT(difference(line.placeAt(100.0), {19, 0, 0}), 1e-12);  // the end of its reach
}

TEST(WalkLine, WalksAClosedLineRoundAndRound) {
    const WalkLine line({{0, 0, 0}, {20, 0, 0}, {20, 0, 20}, {0, 0, 20}, {0, 0, 0}}, kYUp, 300.0, 4.0, 6.0);
    EXPECT_LT(difference(line.placeAt(90.0), {10, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(250.0), {10, 0, 0}), 1e-12);
    // Always to the right, without a jump back.
    EXPECT_NEAR(line.headingAt(90.0), -1.0, 1e-15);
    EXPECT_NEAR(line.headingAt(250.0), -3.0, 1e-15);
}

TEST(WalkLine, KeepsItsHeadingOnAClimb) {
    const WalkLine line({{0, 0, 0}, {0, 0, -20}, {0, 9, -20}, {0, 9, -40}}, kYUp, 49.0, 1.0, 1.0);
    EXPECT_NEAR(line.headingAt(10.0), 0.25, 1e-15);
    EXPECT_NEAR(line.headingAt(25.0), 0.25, 1e-15);
    EXPECT_LT(difference(line.placeAt(25.0), {0, 5, -20}), 1e-12);
}

TEST(WalkLine, TakesPointsThatAreGivenTwice) {
    const WalkLine line({{0, 0, 0}, {0, 0, 0}, {10, 0, 0}, {10, 0, 0}}, kYUp, 50.0, 2.0, 2.0);
    EXPECT_LT(difference(line.placeAt(0.0), {0, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(5.0), {5, 0, 0}), 1e-12);
    EXPECT_LT(difference(line.placeAt(10.0), {9.5, 0, 0}), 1e-12);
}

TEST(IsWalkable, AsksForALineOfSomeLength) {
    EXPECT_TRUE(isWalkable({{0, 0, 0}, {1, 0, 0}}, 1.0));
    EXPECT_FALSE(isWalkable({{0, 0, 0}, {0.9, 0, 0}}, 1.0));
    EXPECT_FALSE(isWalkable({{0, 0, 0}}, 1.0));
    EXPECT_FALSE(isWalkable({}, 1.0));
    EXPECT_FALSE(isWalkable({{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}}, 1.0));
}

}  // namespace
}  // namespace fb
