// Which axis points up where the file does not say.
#include <gtest/gtest.h>

#include "import/guess_up.h"

namespace fb::test {
namespace {

// A box with the walls named by their outward axis: +x, -x, +y, -y, +z, -z.
SourceMesh boxOf(glm::dvec3 size, std::array<bool, 6> walls) {
    SourceMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back(glm::dvec3(i & 1, i >> 1 & 1, i >> 2) * size);
    const glm::uvec4 faces[] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
    for (std::size_t f = 0; f < 6; ++f) {
        if (!walls[f]) continue;
        mesh.triangles.emplace_back(faces[f].x, faces[f].y, faces[f].z);
        mesh.triangles.emplace_back(faces[f].x, faces[f].z, faces[f].w);
    }
    return mesh;
}

TEST(GuessUp, ABoxWithoutItsFloorIsOpenBelow) {
    const auto y = guessUp(boxOf({4, 3, 5}, {true, true, true, false, true, true}));
    ASSERT_TRUE(y);
    EXPECT_EQ(y->up, UpAxis::y);
    EXPECT_EQ(y->reason, "the surface is open below");
    const auto z = guessUp(boxOf({4, 3, 5}, {true, true, true, true, true, false}));
    ASSERT_TRUE(z);
    EXPECT_EQ(z->up, UpAxis::z);
}

TEST(GuessUp, AClosedBoxGivesNoSign) {
    // As much flat base along y (4 x 5) as clearly along z (4 x 3): less than three times.
    EXPECT_FALSE(guessUp(boxOf({4, 3, 5}, {true, true, true, true, true, true})));
}

TEST(GuessUp, ABoxOpenToTheSideOrAboveGivesNoSign) {
    EXPECT_FALSE(guessUp(boxOf({4, 3, 5}, {false, true, true, true, true, true})));
    EXPECT_FALSE(guessUp(boxOf({4, 3, 5}, {true, true, false, true, true, true})));
}

// A tent with its floor: the two roofs and the gables slope, the floor is flat. Along z nothing is flat at the bottom.
TEST(GuessUp, AClosedTentStandsOnItsFloor) {
    SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {4, 0, 6}, {0, 0, 6}, {2, 3, 1}, {2, 3, 5}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {2, 5, 3}, {1, 4, 5}, {1, 5, 2}, {0, 3, 5}, {0, 5, 4}};
    const auto up = guessUp(mesh);
    ASSERT_TRUE(up);
    EXPECT_EQ(up->up, UpAxis::y);
    EXPECT_EQ(up->reason, "the surface stands on a flat base");
    for (glm::dvec3& p : mesh.positions) p = {p.x, -p.z, p.y};  // the same with z up
    EXPECT_EQ(guessUp(mesh)->up, UpAxis::z);
}

TEST(GuessUp, NothingGivesNoSign) {
    EXPECT_FALSE(guessUp({}));
    SourceMesh line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.triangles = {{0, 1, 2}};
    EXPECT_FALSE(guessUp(line));
}

}  // namespace
}  // namespace fb::test
