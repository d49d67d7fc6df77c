#include "build/fit_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/triangle_tree.h"
#include "build/least_squares.h"

namespace fb {
namespace {

constexpr double kCell = 1000.0;  // grid units
constexpr double kMiddle = 1 << 23;

// A surface of side * side cells and every `stride`-th vertex of it as what a simplifier kept.
struct Hill {
    BlockMesh mesh;
    std::vector<MeshTriangle> original;
    std::vector<glm::uvec3> drawn;
    int side;

    template <class Height>
    Hill(int cells, int stride, Height&& height) : side(cells) {
        for (int y = 0; y <= side; ++y) {
            for (int x = 0; x <= side; ++x) {
                const std::uint32_t position = mesh.findOrAddPosition(
                    GridPoint(glm::round(glm::dvec3(x * kCell, y * kCell, kMiddle + height(x * kCell, y * kCell)))));
                mesh.wedges.push_back({position, 0, {}, glm::u8vec4(255)});
            }
        }
        mesh.onBlockBorder.assign(mesh.positions.size(), 0);
        for (const glm::uvec3& t : grid(1)) original.push_back({t, glm::uvec3(kNone)});
        drawn = grid(stride);
    }
    [[nodiscard]] std::uint32_t at(int x, int y) const { return static_cast<std::uint32_t>(y * (side + 1) + x); }
    [[nodiscard]] std::vector<glm::uvec3> grid(int step) const {
        std::vector<glm::uvec3> triangles;
        for (int y = 0; y + step <= side; y += step) {
            for (int x = 0; x + step <= side; x += step) {
                triangles.emplace_back(at(x, y), at(x + step, y), at(x + step, y + step));
                triangles.emplace_back(at(x, y), at(x + step, y + step), at(x, y + step));
            }
        }
        return triangles;
    }
    std::vector<MovedVertex> fit() {
        Numbering numbering(mesh.positions.size());
        return fitSurface(mesh, original, drawn, numbering);
    }
    [[nodiscard]] std::vector<glm::uvec3> moved(const std::vector<MovedVertex>& moves) const {
        std::vector<glm::uvec3> triangles = drawn;
        for (glm::uvec3& t : triangles) {
            for (int k = 0; k < 3; ++k) {
                for (const MovedVertex& m : moves) t[k] = t[k] == m.from ? m.to : t[k];
            }
        }
        return triangles;
    }
    // Of the original's vertices to the triangles: the root of the mean square.
    [[nodiscard]] double deviation(const std::vector<glm::uvec3>& triangles) const {
        std::vector<TriangleCorners> corners;
        for (const glm::uvec3& t : triangles) {
            corners.push_back({glm::vec3(mesh.positions[t.x]), glm::vec3(mesh.positions[t.y]),
                               glm::vec3(mesh.positions[t.z])});
        }
        const TriangleTree tree(corners);
        double sum = 0.0;
        for (const Wedge& wedge : mesh.wedges) {
            sum += double{tree.closest(glm::vec3(mesh.positions[wedge.position])).squaredDistance};
        }
        return std::sqrt(sum / static_cast<double>(mesh.wedges.size()));
    }
};

double dome(double x, double y) {
    const double r = 16.0 * kCell, dx = x - r, dy = y - r;
    return -(dx * dx + dy * dy) / (8.0 * r);
}

// Chords of a dome lie below it by two thirds of their height on average; moved amid it, their root mean square is less
// than half. The vertices at its border stay.
TEST(FitSurface, RunsAmidACurvedSurface) {
    Hill hill(32, 8, dome);
    const double before = hill.deviation(hill.drawn);
    const std::vector<MovedVertex> moves = hill.fit();
    EXPECT_EQ(moves.size(), 9u);  // 3 x 3 inner ones of 5 x 5
    EXPECT_TRUE(std::ranges::is_sorted(moves));
    for (const MovedVertex& m : moves) EXPECT_GT(hill.mesh.positions[m.to].z, hill.mesh.positions[m.from].z);
    EXPECT_LT(hill.deviation(hill.moved(moves)), 0.75 * before);
}

TEST(FitSurface, LeavesFlatSurfacesAndCreasesAlone) {
    EXPECT_TRUE(Hill(16, 4, [](double, double) { return 0.0; }).fit().empty());
    EXPECT_TRUE(Hill(16, 4, [](double x, double) { return std::abs(x - 8.0 * kCell); }).fit().empty());
}

TEST(FitSurface, LeavesVerticesOnCutsAndBlockBordersWhereTheyAre) {
    Hill hill(32, 8, dome);
    hill.mesh.onCut[hill.at(8, 16)] = 1;
    hill.mesh.onBlockBorder[hill.at(24, 16)] = 1;
    const std::vector<MovedVertex> moves = hill.fit();
    EXPECT_EQ(moves.size(), 7u);
    for (const MovedVertex& m : moves) {
        EXPECT_NE(m.from, hill.at(8, 16));
        EXPECT_NE(m.from, hill.at(24, 16));
    }
}

// What the simplified surface left out, far above it, moves it by little.
TEST(FitSurface, IsNotPulledByWhatIsMissing) {
    Hill hill(32, 8, dome);
    const std::vector<MovedVertex> alone = hill.fit();
    Hill other(32, 8, dome);
    std::vector<std::uint32_t> roof;
    for (const glm::dvec2& at : {glm::dvec2(15, 15), {17, 15}, {16, 17}}) {
        other.mesh.wedges.push_back(
            {other.mesh.findOrAddPosition(GridPoint(glm::dvec3(at * kCell, kMiddle + 9.0 * kCell))), 0, {}, {}});
        roof.push_back(static_cast<std::uint32_t>(other.mesh.wedges.size() - 1));
    }
    other.original.push_back({{roof[0], roof[1], roof[2]}, glm::uvec3(kNone)});
    const std::vector<MovedVertex> moves = other.fit();
    ASSERT_EQ(moves.size(), alone.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const double z = other.mesh.positions[moves[i].to].z, wanted = hill.mesh.positions[alone[i].to].z;
        EXPECT_NEAR(z, wanted, 0.25 * kCell);
    }
}

// On any surface no triangle is turned far or collapsed, and it is the same again; on hills it is no farther from the
// original (where ground is as rough as cells are wide, the closest triangle is another one afterwards).
RC_GTEST_PROP(FitSurface, KeepsTrianglesSoundOnRoughGround, (std::uint64_t seed)) {
    Random random(seed);
    const double rough = std::pow(10.0, random.uniform(0.0, 4.5)), wave = random.uniform(1e-5, 1e-3);
    const auto height = [&](double x, double y) {
        return rough * (std::sin(x * wave) * std::cos(1.3 * y * wave) + 0.2 * std::sin(x * 0.7) * std::sin(y * 0.9));
    };
    constexpr int kStrides[] = {1, 2, 3, 4, 6, 8};
    const int stride = kStrides[random.index(6)];
    Hill hill(24, stride, height), again = hill;
    const double before = hill.deviation(hill.drawn);
    const std::vector<MovedVertex> moves = hill.fit();
    RC_ASSERT(moves == again.fit());
    const std::vector<glm::uvec3> moved = hill.moved(moves);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const auto cross = [&](const glm::uvec3& t) {
            return crossOf(hill.mesh.positions[t.x], hill.mesh.positions[t.y], hill.mesh.positions[t.z]);
        };
        const glm::dvec3 was = cross(hill.drawn[i]), is = cross(moved[i]);
        RC_ASSERT(glm::dot(was, is) > 0.5 * glm::length(was) * glm::length(is));
    }
    if (rough < kCell) RC_ASSERT(hill.deviation(moved) <= 1.02 * before + 1.0);
}

TEST(LeastSquares, FindsTheUnknownsThatRowsAgreeOn) {
    LeastSquares problem;
    const std::vector<double> wanted = {3.0, -2.0, 0.5, 7.0};
    Random random(5);
    for (std::uint32_t i = 0; i < 400; ++i) {
        LeastSquares::Row row{{i % 4, (i / 4) % 4, (i / 16) % 4}, {}, 0.0, random.uniform(0.5, 2.0)};
        for (int k = 0; k < 3; ++k) {
            row.factors[k] = random.uniform(-1.0, 1.0);
            row.value += row.factors[k] * wanted[row.unknowns[k]];
        }
        problem.rows.push_back(row);
    }
    const std::vector<double> found = problem.solve(5);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], wanted[i], 0.05 * std::abs(wanted[i]) + 0.1);
    EXPECT_EQ(found[4], 0.0);  // in no row
}

}  // namespace
}  // namespace fb
