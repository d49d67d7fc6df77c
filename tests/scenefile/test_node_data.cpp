#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/random.h"
#include "scenefile/node_data.h"

namespace fb {
namespace {

TEST(EncodeNormal, KeepsTheSixAxesExactly) {
    for (int axis = 0; axis < 3; ++axis) {
        for (float sign : {1.0f, -1.0f}) {
            glm::vec3 direction(0.0f);
            direction[axis] = sign;
            std::int16_t coded[2];
            encodeNormal(direction, coded);
            EXPECT_EQ(decodeNormal(coded), direction) << axis << " " << sign;
        }
    }
}

TEST(EncodeNormal, TurnsUnknownDirectionsIntoUp) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const glm::vec3& unknown : {glm::vec3(0.0f), glm::vec3(nan, 0, 1), glm::vec3(0, inf, 0)}) {
        std::int16_t coded[2] = {7, 7};
        encodeNormal(unknown, coded);
        EXPECT_EQ(decodeNormal(coded), glm::vec3(0, 0, 1));
    }
}

// One step of the code moves a point of the octahedron by 1/32767 along two of its axes at once; seen from
// the centre, at least 1/sqrt(3) away, half a step each way is below sqrt(3) * sqrt(6)/2 / 32767 = 6.5e-5
// rad.
TEST(EncodeNormal, IsOffByLessThanSevenHundredThousandthsOfARadian) {
    Random random(1);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        glm::dvec3 direction(random.normal(), random.normal(), random.normal());
        direction /= glm::length(direction);
        std::int16_t coded[2];
        encodeNormal(glm::vec3(direction), coded);
        const glm::dvec3 back(decodeNormal(coded));
        EXPECT_NEAR(glm::length(back), 1.0, 1e-6);
        worst = std::max(worst, glm::length(glm::cross(direction, back)));
        ASSERT_GT(glm::dot(direction, back), 0.0);
    }
    EXPECT_LT(worst, 7e-5);
}

RC_GTEST_PROP(DecodeNormal, GivesAUnitVectorForAnyCode, (std::int16_t x, std::int16_t y)) {
    const std::int16_t coded[2] = {x, y};
    const glm::vec3 normal = decodeNormal(coded);
    RC_ASSERT(std::abs(glm::length(normal) - 1.0f) < 1e-5f);
}

TEST(AtlasSide, IsTheNextOfTheClasses) {
    const std::pair<std::uint32_t, std::uint32_t> table[] = {
        {0, 4},         {1, 4},         {3, 4},       {4, 4},       {5, 6},        {6, 6},
        {7, 8},         {8, 8},         {9, 12},      {12, 12},     {13, 16},      {16, 16},
        {17, 24},       {24, 24},       {25, 32},     {33, 48},     {48, 48},      {49, 64},
        {65, 96},       {97, 128},      {129, 192},   {193, 256},   {1000, 1024},  {1025, 1536},
        {1537, 2048},   {4096, 4096},   {4097, 6144}, {8192, 8192}, {8193, 12288}, {12288, 12288},
        {12289, 16384}, {16384, 16384},
    };
    for (const auto& [side, expected] : table) EXPECT_EQ(atlasSide(side), expected) << side;
}

RC_GTEST_PROP(AtlasSide, WastesLessThanHalfAndIsItsOwnClass, ()) {
    const auto side = *rc::gen::inRange<std::uint32_t>(4, 20000);
    const std::uint32_t chosen = atlasSide(side);
    RC_ASSERT(chosen >= side);
    RC_ASSERT(chosen * 2 < side * 3 || side == chosen);
    RC_ASSERT(atlasSide(chosen) == chosen);
}

TEST(MipLevelCount, GoesDownToOneTexel) {
    EXPECT_EQ(mipLevelCount(1, 1), 1u);
    EXPECT_EQ(mipLevelCount(4, 4), 3u);   // 4 2 1
    EXPECT_EQ(mipLevelCount(6, 4), 3u);   // 6x4 3x2 1x1
    EXPECT_EQ(mipLevelCount(4, 64), 7u);  // 64 32 16 8 4 2 1
    EXPECT_EQ(mipLevelCount(16384, 4), 15u);
    EXPECT_EQ(mipLevelCount(0, 0), 0u);
}

TEST(MippedBytes, AddsUpTheLevels) {
    EXPECT_EQ(mippedBytes(1, 1), 4u);
    EXPECT_EQ(mippedBytes(4, 4), (16u + 4u + 1u) * 4u);
    EXPECT_EQ(mippedBytes(6, 4), (24u + 6u + 1u) * 4u);              // 6x4 3x2 1x1
    EXPECT_EQ(mippedBytes(4, 16), (64u + 16u + 4u + 2u + 1u) * 4u);  // 4x16 2x8 1x4 1x2 1x1
    EXPECT_EQ(mippedBytes(0, 0), 0u);
    // 4^15 - 1 over 3 texels: more than 32 bits would wrap at, were there one more level.
    EXPECT_EQ(mippedBytes(16384, 16384), ((std::uint64_t{1} << 30) - 1) / 3 * 4);
}

TEST(ResidentBytes, CountsVerticesIndicesAndTexels) {
    EXPECT_EQ(residentBytes(0, 0, 0, 0), 0u);
    EXPECT_EQ(residentBytes(3, 1, 0, 0), 3u * 24u + 12u);
    EXPECT_EQ(residentBytes(10, 7, 4, 4), 10u * 24u + 7u * 12u + 84u);
}

// What makes borders of neighbouring nodes meet: the float product is the exact one.
RC_GTEST_PROP(BlockGrid, GivesExactFloatsForEveryCoordinate, ()) {
    const auto coordinate = *rc::gen::inRange<std::uint32_t>(0, 1u << 24);
    const int exponent = *rc::gen::inRange(-60, 41);
    const double step = std::ldexp(1.0, exponent);
    const float product = static_cast<float>(coordinate) * static_cast<float>(step);
    RC_ASSERT(static_cast<double>(product) == coordinate * step);
}

}  // namespace
}  // namespace fb
