#include "build/simplify_level.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "block_worlds.h"
#include "build/farthest_from.h"
#include "build/quantise_block.h"
#include "build/simplify_mesh.h"
#include "build/split_mesh.h"

namespace fb {
namespace {

using test::blockOf;
using test::makeSheet;
using test::makeSphere;

struct World {
    mutable BlockMesh mesh;  // stand-ins add positions
    Level level;

    explicit World(const SourceMesh& source) {
        const SourceBlock block = blockOf(source);
        QuantisedBlock quantised = quantiseBlock(block, decodeTextures(block));
        mesh = std::move(quantised.mesh);
        level.triangles = std::move(quantised.triangles);
        level.pieces = {{0, 0, static_cast<std::uint32_t>(level.triangles.size())}};
    }
    void split(int levelFactor) {
        SplitCounters counters;
        level = splitLevel(mesh, level, levelFactor, counters);
    }
    [[nodiscard]] std::vector<SimplifiedPiece> simplify(double factor, Simplifier simplifier) const {
        std::vector<std::size_t> aims;
        for (const Piece& piece : level.pieces) aims.push_back(simplificationAim(piece.size(), factor));
        return simplifyLevel(mesh, level, aims, simplifier);
    }
    [[nodiscard]] std::uint32_t positionOf(const SimplifiedPiece& piece, std::uint32_t id) const {
        return piece.welded ? id : mesh.wedges[id].position;
    }
    [[nodiscard]] double areaOf(const SimplifiedPiece& piece) const {
        double area = 0.0;
        for (const glm::uvec3& t : piece.triangles) {
            area += 0.5 * glm::length(crossOf(mesh.positions[positionOf(piece, t.x)],
                                              mesh.positions[positionOf(piece, t.y)],
                                              mesh.positions[positionOf(piece, t.z)]));
        }
        return area * mesh.grid.step * mesh.grid.step;
    }
    // The piece's border: positions of directed edges without their opposite.
    [[nodiscard]] std::set<std::pair<std::uint32_t, std::uint32_t>> openEdges(
        const SimplifiedPiece& piece) const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges, open;
        for (const glm::uvec3& t : piece.triangles) {
            for (int k = 0; k < 3; ++k)
                edges.emplace(positionOf(piece, t[k]), positionOf(piece, t[(k + 1) % 3]));
        }
        for (const auto& [a, b] : edges) {
            if (!edges.contains({b, a})) open.emplace(a, b);
        }
        return open;
    }
};

double bumps(double x, double y) {
    return 0.05 * std::sin(7 * x) * std::cos(9 * y) + 0.02 * std::sin(31 * x + 17 * y);
}

class BothSimplifiers : public testing::TestWithParam<Simplifier> {};
INSTANTIATE_TEST_SUITE_P(SimplifyLevel, BothSimplifiers,
                         testing::Values(Simplifier::meshoptimizer, Simplifier::openMesh),
                         [](const auto& test) {
                             return test.param == Simplifier::openMesh ? "OpenMesh" : "Meshoptimizer";
                         });

TEST_P(BothSimplifiers, ReachTheAimOnASphereAndStayOnIt) {
    const World world(makeSphere(60, 40));  // 4680 triangles
    const std::vector<SimplifiedPiece> pieces = world.simplify(10.0, GetParam());
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_LE(pieces[0].triangles.size(), 468u);
    EXPECT_GE(pieces[0].triangles.size(), 460u);
    EXPECT_FALSE(pieces[0].stuck);
    EXPECT_FALSE(pieces[0].welded);
    EXPECT_TRUE(world.openEdges(pieces[0]).empty());
    // 468 triangles inscribed in a sphere lose little of its 12.57 square metres.
    EXPECT_NEAR(world.areaOf(pieces[0]), 4 * 3.14159265, 0.3);
}

TEST_P(BothSimplifiers, ReachTheAimOnAFlatSheetAndKeepItsOutline) {
    const World world(makeSheet({40, 30, 4.0, 3.0, {}}));  // 2400 triangles
    const std::vector<SimplifiedPiece> pieces = world.simplify(24.0, GetParam());
    EXPECT_LE(pieces[0].triangles.size(), 100u);
    EXPECT_FALSE(pieces[0].stuck);
    EXPECT_NEAR(world.areaOf(pieces[0]), 12.0, 1e-3);
}

TEST_P(BothSimplifiers, KeepATextureSeamClosed) {
    // Left and right half of the sheet have their own texture coordinates.
    SourceMesh sheet = makeSheet({40, 20, 4.0, 2.0, bumps});
    const std::size_t vertices = sheet.positions.size();
    for (std::size_t v = 0; v < vertices; ++v) {
        sheet.positions.push_back(sheet.positions[v]);
        sheet.uvs.push_back(sheet.uvs[v] + glm::vec2(5.0f));
    }
    for (glm::uvec3& t : sheet.triangles) {
        const double x = (sheet.positions[t.x].x + sheet.positions[t.y].x + sheet.positions[t.z].x) / 3;
        if (x > 2.0) t += glm::uvec3(static_cast<std::uint32_t>(vertices));
    }
    SourceBlock block = blockOf(sheet, test::paintImage(4, 4, [](int, int) { return glm::u8vec3(1); }));
    const BlockTextures textures = decodeTextures(block);
    World world(sheet);
    QuantisedBlock quantised = quantiseBlock(block, textures);
    world.mesh = std::move(quantised.mesh);
    world.level.triangles = std::move(quantised.triangles);
    const std::vector<SimplifiedPiece> pieces = world.simplify(8.0, GetParam());
    EXPECT_LE(pieces[0].triangles.size(), 200u);
    EXPECT_FALSE(pieces[0].welded);
    // Every triangle keeps to one half, and the seam at x = 2 has the same vertices seen from both.
    std::set<std::uint32_t> left, right;
    for (const glm::uvec3& t : pieces[0].triangles) {
        int onRight = 0;
        for (int k = 0; k < 3; ++k) onRight += world.mesh.wedges[t[k]].uv.x > 3.0f ? 1 : 0;
        ASSERT_TRUE(onRight == 0 || onRight == 3);
        for (int k = 0; k < 3; ++k) {
            const GridPoint& p = world.mesh.at(t[k]);
            if (std::abs(world.mesh.grid.origin.x + p.x * world.mesh.grid.step - 2.0) < 1e-6) {
                (onRight == 3 ? right : left).insert(world.mesh.wedges[t[k]].position);
            }
        }
    }
    EXPECT_GE(left.size(), 2u);
    EXPECT_LT(left.size(), 21u);  // simplified too
    EXPECT_EQ(left, right);
}

// Each inner cut border of a level is drawn by two pieces; their edges there must be the same, in opposite
// directions.
TEST_P(BothSimplifiers, LetThePiecesOfALevelMeetExactly) {
    World world(makeSphere(80, 40));  // closed: every open edge of a piece is a cut
    for (int depth = 0; depth < 2; ++depth) {
        world.split(4);
        const std::vector<SimplifiedPiece> pieces = world.simplify(8.0, GetParam());
        std::set<std::pair<std::uint32_t, std::uint32_t>> open;
        for (const SimplifiedPiece& piece : pieces) {
            EXPECT_FALSE(piece.stuck);
            for (const auto& edge : world.openEdges(piece)) EXPECT_TRUE(open.insert(edge).second);
        }
        EXPECT_GT(open.size(), 40u);
        for (const auto& [a, b] : open) EXPECT_TRUE(open.contains({b, a})) << "gap at depth " << depth;
    }
}

TEST_P(BothSimplifiers, CoarsenCutsTogetherWithWhatSurroundsThem) {
    World world(makeSheet({160, 160, 1.0, 1.0, bumps}));  // 51200 triangles
    world.split(2);
    const std::vector<SimplifiedPiece> pieces = world.simplify(256.0, GetParam());
    std::size_t total = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        total += pieces[i].triangles.size();
        // 161 vertices lie on the cut; locked one by one they alone would take more triangles than the aim.
        EXPECT_FALSE(pieces[i].stuck);
        EXPECT_FALSE(pieces[i].welded);
    }
    // The pieces share the level's triangles by the detail that they hold. 51200 / 256 = 200, and 2 % more.
    EXPECT_LE(total, 204u);
    EXPECT_GE(total, 150u);
}

TEST_P(BothSimplifiers, NeverLeaveAPieceWithoutTriangles) {
    World world(makeSheet({3, 1, 300.0, 1.0, {}}));
    world.split(16);
    for (const SimplifiedPiece& piece : world.simplify(1000.0, GetParam()))
        EXPECT_GE(piece.triangles.size(), 1u);
}

TEST(SimplifyWithMeshoptimizer, KeepsEveryLockedVertex) {
    const World world(makeSheet({30, 30, 3.0, 3.0, bumps}));
    SimplifyInput input;
    const std::int32_t left = std::ranges::min(world.mesh.positions, {}, &GridPoint::x).x;
    for (const GridPoint& p : world.mesh.positions) {
        input.places.push_back(static_cast<std::uint32_t>(input.points.size()));
        input.points.emplace_back(p);
        input.locked.push_back(p.x == left ? 1 : 0);
    }
    for (const MeshTriangle& t : world.level.triangles) {
        input.triangles.emplace_back(world.mesh.wedges[t.wedges.x].position,
                                     world.mesh.wedges[t.wedges.y].position,
                                     world.mesh.wedges[t.wedges.z].position);
    }
    input.targetTriangles = 150;
    for (const bool openMesh : {false, true}) {
        const SimplifyOutput output =
            openMesh ? simplifyWithOpenMesh(input) : simplifyWithMeshoptimizer(input);
        EXPECT_LE(output.triangles.size(), 150u);
        std::set<std::uint32_t> kept;
        for (const glm::uvec3& t : output.triangles) {
            for (int k = 0; k < 3; ++k) {
                if (input.locked[t[k]] != 0) kept.insert(t[k]);
            }
        }
        EXPECT_EQ(kept.size(), 31u) << (openMesh ? "OpenMesh" : "meshoptimizer");
    }
}

TEST(SimplifyWithOpenMesh, CarriesNonManifoldTrianglesAndCountsThem) {
    // Three triangles on one edge: OpenMesh connects two of them.
    SimplifyInput input;
    input.points = {{0, 0, 0}, {100, 0, 0}, {50, 80, 0}, {50, -80, 0}, {50, 0, 90}};
    input.places = {0, 1, 2, 3, 4};
    input.locked.assign(5, 0);
    input.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    input.targetTriangles = 3;
    const SimplifyOutput output = simplifyWithOpenMesh(input);
    EXPECT_EQ(output.triangles.size(), 3u);
    EXPECT_EQ(output.carriedTriangles, 1u);
    EXPECT_EQ(output.triangles[2], glm::uvec3(0, 1, 4));
}

TEST(SimplifyLevel, WeldsSeamsWhenTheyHinder) {
    // Every square is a texture chart of its own: all vertices are seams of four.
    SourceMesh sheet = makeSheet({30, 30, 3.0, 3.0, bumps}), torn;
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            torn.positions.push_back(sheet.positions[sheet.triangles[t][k]]);
            torn.uvs.push_back(sheet.uvs[sheet.triangles[t][k]] + glm::vec2(static_cast<float>(t / 2)));
        }
        const auto first = static_cast<std::uint32_t>(3 * t);
        torn.triangles.emplace_back(first, first + 1, first + 2);
    }
    SourceBlock block = blockOf(torn, test::paintImage(4, 4, [](int, int) { return glm::u8vec3(1); }));
    World world(torn);
    QuantisedBlock quantised = quantiseBlock(block, decodeTextures(block));
    world.mesh = std::move(quantised.mesh);
    world.level.triangles = std::move(quantised.triangles);
    for (const Simplifier simplifier : {Simplifier::meshoptimizer, Simplifier::openMesh}) {
        const std::vector<SimplifiedPiece> pieces = world.simplify(9.0, simplifier);
        EXPECT_TRUE(pieces[0].welded);
        EXPECT_FALSE(pieces[0].stuck);
        EXPECT_LE(pieces[0].triangles.size(), 300u);
        EXPECT_NEAR(world.areaOf(pieces[0]), test::areaOf(sheet), 0.05 * test::areaOf(sheet));
    }
}

// A bumpy sheet; with `seams` each triangle of its first quarter is a texture island of its own, as scans
// have places full of scraps. Triangles that cannot be had there must be saved elsewhere.
World scraps(int cells, bool seams) {
    World world(makeSheet({cells, cells, 8.0, 8.0, bumps}));
    for (std::size_t i = 0; i < world.level.triangles.size() && seams; ++i) {
        MeshTriangle& t = world.level.triangles[i];
        std::int32_t right = 0;
        for (int k = 0; k < 3; ++k) right = std::max(right, world.mesh.at(t.wedges[k]).x);
        if (right > world.mesh.at(world.level.triangles.back().wedges.x).x / 4) continue;
        for (int k = 0; k < 3; ++k) {
            Wedge wedge = world.mesh.wedges[t.wedges[k]];
            wedge.uv = glm::vec2(i, 1.0f);
            t.wedges[k] = static_cast<std::uint32_t>(world.mesh.wedges.size());
            world.mesh.wedges.push_back(wedge);
        }
    }
    return world;
}

double farthestOff(const World& world, const SimplifiedPiece& piece) {
    const auto surface = [&](const std::vector<glm::uvec3>& positions) {
        std::vector<glm::vec3> points;
        std::vector<glm::uvec3> triangles;
        for (const glm::uvec3& t : positions) {
            const auto first = static_cast<std::uint32_t>(points.size());
            for (int k = 0; k < 3; ++k) points.emplace_back(world.mesh.positions[t[k]]);
            triangles.emplace_back(first, first + 1, first + 2);
        }
        return MeasuredSurface(points, triangles);
    };
    std::vector<glm::uvec3> original, drawn;
    for (const MeshTriangle& t : world.level.triangles) {
        original.emplace_back(world.mesh.wedges[t.wedges.x].position, world.mesh.wedges[t.wedges.y].position,
                              world.mesh.wedges[t.wedges.z].position);
    }
    for (const glm::uvec3& t : piece.triangles)
        drawn.emplace_back(world.positionOf(piece, t.x), world.positionOf(piece, t.y),
                           world.positionOf(piece, t.z));
    return farthestFrom(surface(original), surface(drawn), 0.0);
}

TEST(SimplifyLevel, WeldsSeamsWhereKeepingThemCostsAccuracy) {
    const World plain = scraps(32, false), seamed = scraps(32, true);
    const auto expected = plain.simplify(3.0, Simplifier::meshoptimizer);
    const auto pieces = seamed.simplify(3.0, Simplifier::meshoptimizer);  // reached with seams, too
    EXPECT_FALSE(expected[0].welded);
    EXPECT_TRUE(pieces[0].welded);
    EXPECT_LE(farthestOff(seamed, pieces[0]), 1.1 * farthestOff(plain, expected[0]));
}

TEST(SimplificationAim, RoundsUpAndLeavesSmallPiecesAlone) {
    EXPECT_EQ(simplificationAim(40000, 44.4), 901u);
    EXPECT_EQ(simplificationAim(100, 10.0), 10u);
    EXPECT_EQ(simplificationAim(12, 100.0), 4u);
    EXPECT_EQ(simplificationAim(3, 100.0), 3u);
}

// Soups with slivers, repeated and non-manifold triangles: an answer always comes, out of vertices that were
// there.
RC_GTEST_PROP(SimplifyLevel, AnswersForEveryTriangleSoup, (std::uint64_t seed, bool openMesh)) {
    Random random(seed);
    SourceMesh soup;
    const int points = 4 + static_cast<int>(random.index(40));
    for (int i = 0; i < points; ++i) {
        soup.positions.emplace_back(random.uniform(), random.uniform(),
                                    random.index(2) == 0 ? 0.0 : random.uniform());
        soup.uvs.emplace_back(0.0f);
    }
    for (std::uint64_t i = 0; i < 1 + random.index(120); ++i) {
        soup.triangles.emplace_back(random.index(points), random.index(points), random.index(points));
    }
    World world(soup);
    RC_PRE(!world.level.triangles.empty());
    const Simplifier simplifier = openMesh ? Simplifier::openMesh : Simplifier::meshoptimizer;
    for (int depth = 0; depth < 2; ++depth) {
        const std::vector<SimplifiedPiece> pieces = world.simplify(4.0, simplifier);
        RC_ASSERT(pieces.size() == world.level.pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            RC_ASSERT(!pieces[i].triangles.empty());
            RC_ASSERT(pieces[i].triangles.size() <= world.level.pieces[i].size());
            std::set<std::uint32_t> own;
            for (std::uint32_t t = world.level.pieces[i].begin; t < world.level.pieces[i].end; ++t) {
                for (int k = 0; k < 3; ++k)
                    own.insert(world.mesh.wedges[world.level.triangles[t].wedges[k]].position);
            }
            for (const glm::uvec3& t : pieces[i].triangles) {
                for (int k = 0; k < 3; ++k) RC_ASSERT(own.contains(world.positionOf(pieces[i], t[k])));
            }
        }
        world.split(2);
    }
}

}  // namespace
}  // namespace fb
