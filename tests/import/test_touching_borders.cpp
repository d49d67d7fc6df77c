#include <gtest/gtest.h>

#include <functional>

#include "import/touching_borders.h"

namespace fb {
namespace {

// A flat sheet of columns x rows squares with its low corner at `corner`.
SourceBlock sheet(const glm::dvec3& corner, double width, double height, int columns, int rows) {
    SourceBlock block;
    SourceMesh& mesh = block.mesh;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) mesh.positions.push_back(corner + glm::dvec3(width * x / columns, height * y / rows, 0));
    }
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (columns + 1) + x); };
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            mesh.triangles.emplace_back(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            mesh.triangles.emplace_back(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    }
    mesh.shared.assign(mesh.positions.size(), 0);
    return block;
}

void expectShared(const SourceBlock& block, const std::function<bool(const glm::dvec3&)>& isShared) {
    for (std::size_t v = 0; v < block.mesh.positions.size(); ++v) {
        const glm::dvec3& p = block.mesh.positions[v];
        EXPECT_EQ(block.mesh.shared[v] != 0, isShared(p)) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

// Two sheets that meet in a line where they have different vertices; also far from the origin.
TEST(TouchingBorders, AreFoundWhereNoVertexIsInCommon) {
    for (const glm::dvec3& origin : {glm::dvec3(0.0), glm::dvec3(5e5, 6.5e6, 100.0)}) {
        std::vector<SourceBlock> blocks = {sheet(origin, 10, 10, 7, 5),
                                           sheet(origin + glm::dvec3(10, 0.3, 0), 10, 9.1, 3, 8)};
        markTouchingBorders(blocks);
        expectShared(blocks[0], [&](const glm::dvec3& p) {  // not its ends, which are beside the other's
            return p.x == origin.x + 10 && p.y > origin.y && p.y < origin.y + 9;
        });
        expectShared(blocks[1], [&](const glm::dvec3& p) { return p.x == origin.x + 10; });
    }
}

// Each ends within the other.
TEST(TouchingBorders, AreFoundWhereSurfacesOverlap) {
    std::vector<SourceBlock> blocks = {sheet({0, 0, 0}, 10, 10, 7, 5), sheet({9.7, -1, 2e-4}, 10, 12, 3, 7)};
    markTouchingBorders(blocks);
    expectShared(blocks[0], [](const glm::dvec3& p) { return p.x == 10; });
    expectShared(blocks[1], [](const glm::dvec3& p) { return p.x == 9.7 && p.y > 0 && p.y < 10; });
}

TEST(TouchingBorders, AreNotWhatIsInsideApartOrInCommonAlready) {
    std::vector<SourceBlock> apart = {sheet({0, 0, 0}, 10, 10, 7, 5), sheet({5, 5, 0.01}, 10, 10, 3, 8)};
    markTouchingBorders(apart);
    for (const SourceBlock& block : apart) expectShared(block, [](const glm::dvec3&) { return false; });
    // The floor goes on under the wall: the wall ends on it, the floor does not end.
    std::vector<SourceBlock> wall = {sheet({0, 0, 0}, 10, 10, 5, 5), sheet({1.3, 4.1, 0}, 5, 3, 2, 2)};
    for (glm::dvec3& p : wall[1].mesh.positions) p = {p.x, 4.1, p.y - 4.1};
    markTouchingBorders(wall);
    expectShared(wall[0], [](const glm::dvec3&) { return false; });
    expectShared(wall[1], [](const glm::dvec3& p) { return p.z == 0; });
    std::vector<SourceBlock> one = {sheet({0, 0, 0}, 10, 10, 5, 5)};
    one[0].mesh.shared[3] = 1;
    markTouchingBorders(one);
    EXPECT_EQ(one[0].mesh.shared[3], 1);
    EXPECT_EQ(one[0].mesh.shared[0], 0);
}

}  // namespace
}  // namespace fb
