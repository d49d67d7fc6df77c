#include "build/split_mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/random.h"
#include "block_worlds.h"
#include "build/quantise_block.h"

namespace fb {
namespace {

using test::areaOf;

// Points of a hand-made mesh are grid points: the grid has step 1 and origin 0.
struct World {
    BlockMesh mesh;
    Level level;

    World() { mesh.surfaces.push_back({}); }
    std::uint32_t wedge(const GridPoint& point, const glm::vec2& uv = {}) {
        const std::uint32_t position = mesh.findOrAddPosition(point);
        mesh.wedges.push_back({position, 0, uv, glm::u8vec4(255)});
        return static_cast<std::uint32_t>(mesh.wedges.size() - 1);
    }
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        level.triangles.push_back({{a, b, c}, {kNone, kNone, kNone}});
    }
    Level split(int levelFactor) {
        level.pieces = {{0, 0, static_cast<std::uint32_t>(level.triangles.size())}};
        return splitLevel(mesh, level, levelFactor, counters);
    }
    std::span<const MeshTriangle> piece(const Level& of, std::size_t i) const {
        return {of.triangles.data() + of.pieces[i].begin, of.pieces[i].size()};
    }
    // Corner points of a piece's triangles, each triangle turned to start at its smallest corner.
    std::set<std::vector<std::array<int, 3>>> shapes(const Level& of, std::size_t i) const {
        std::set<std::vector<std::array<int, 3>>> result;
        for (const MeshTriangle& t : piece(of, i)) {
            std::vector<std::array<int, 3>> corners;
            for (int k = 0; k < 3; ++k) {
                const GridPoint& p = mesh.at(t.wedges[k]);
                corners.push_back({p.x, p.y, p.z});
            }
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            result.insert(corners);
        }
        return result;
    }

    SplitCounters counters;
};

TEST(CuttingPlanes, AreEquallySpacedBetweenTheEndsOfTheBox) {
    EXPECT_EQ(cuttingPlanes(0, 400, 4), (std::vector<std::int32_t>{100, 200, 300}));
    EXPECT_EQ(cuttingPlanes(10, 20, 2), (std::vector<std::int32_t>{15}));
    EXPECT_EQ(cuttingPlanes(0, 10, 3), (std::vector<std::int32_t>{3, 7}));  // 3.33 and 6.67
}

TEST(CuttingPlanes, NeverLieOnTheEndsOfAShortBoxNorOnEachOther) {
    EXPECT_EQ(cuttingPlanes(5, 5, 4), std::vector<std::int32_t>{});
    EXPECT_EQ(cuttingPlanes(5, 6, 4), std::vector<std::int32_t>{});
    EXPECT_EQ(cuttingPlanes(5, 7, 4), std::vector<std::int32_t>{6});
}

// (0,0)      (100,0)          cut at x = 50: the corner (100,0) is alone on its side,
//    +----------+             the two others make a quad of two triangles.
//    |   /
//    |/
//  (0,40)
TEST(SplitMesh, CutsATriangleAcrossOnePlaneIntoThree) {
    World world;
    world.add(world.wedge({0, 0, 0}), world.wedge({100, 0, 0}), world.wedge({0, 40, 0}));
    const Level cut = world.split(2);
    ASSERT_EQ(cut.pieces.size(), 2u);
    EXPECT_EQ(cut.pieces[0].size(), 2u);
    EXPECT_EQ(cut.pieces[1].size(), 1u);
    EXPECT_EQ(world.shapes(cut, 1),
              (std::set<std::vector<std::array<int, 3>>>{{{50, 0, 0}, {100, 0, 0}, {50, 20, 0}}}));
    EXPECT_EQ(areaOf(world.mesh, world.piece(cut, 0)), 1500.0);
    EXPECT_EQ(areaOf(world.mesh, world.piece(cut, 1)), 500.0);
    EXPECT_EQ(world.mesh.positions.size(), 5u);  // two new ones
}

TEST(SplitMesh, CutsATriangleWithOneVertexOnThePlaneIntoTwo) {
    World world;
    world.add(world.wedge({0, 0, 0}), world.wedge({100, 0, 0}), world.wedge({50, 40, 0}));
    const Level cut = world.split(2);
    ASSERT_EQ(cut.pieces.size(), 2u);
    EXPECT_EQ(world.shapes(cut, 0),
              (std::set<std::vector<std::array<int, 3>>>{{{0, 0, 0}, {50, 0, 0}, {50, 40, 0}}}));
    EXPECT_EQ(world.shapes(cut, 1),
              (std::set<std::vector<std::array<int, 3>>>{{{50, 0, 0}, {100, 0, 0}, {50, 40, 0}}}));
    EXPECT_EQ(world.mesh.positions.size(), 4u);
}

TEST(SplitMesh, LeavesTrianglesWholeWhoseEdgeLiesInThePlane) {
    World world;
    const std::uint32_t a = world.wedge({50, 0, 0}), b = world.wedge({50, 40, 0});
    world.add(world.wedge({0, 0, 0}), a, b);
    world.add(a, world.wedge({100, 0, 0}), b);
    const Level cut = world.split(2);
    ASSERT_EQ(cut.pieces.size(), 2u);
    EXPECT_EQ(cut.pieces[0].size(), 1u);
    EXPECT_EQ(cut.pieces[1].size(), 1u);
    EXPECT_EQ(world.mesh.positions.size(), 4u);
}

TEST(SplitMesh, GivesATriangleInThePlaneToTheLowerPieceOnly) {
    World world;
    world.add(world.wedge({50, 0, 0}), world.wedge({50, 30, 0}), world.wedge({50, 0, 30}));
    world.add(world.wedge({0, 0, 0}), world.wedge({10, 0, 0}), world.wedge({0, 10, 0}));
    world.add(world.wedge({100, 0, 0}), world.wedge({90, 0, 0}), world.wedge({100, 10, 0}));
    const Level cut = world.split(2);
    ASSERT_EQ(cut.pieces.size(), 2u);
    EXPECT_EQ(cut.pieces[0].size(), 2u);
    EXPECT_EQ(cut.pieces[1].size(), 1u);
}

TEST(SplitMesh, CutsATriangleAcrossTwoPlanesAndSkipsAnEmptyPiece) {
    // Planes at 100, 200, 300; nothing lies between 200 and 300.
    World world;
    world.add(world.wedge({0, 0, 0}), world.wedge({200, 0, 0}), world.wedge({0, 100, 0}));
    world.add(world.wedge({400, 0, 0}), world.wedge({350, 0, 0}), world.wedge({400, 50, 0}));
    const Level cut = world.split(4);
    ASSERT_EQ(cut.pieces.size(), 3u);
    EXPECT_EQ(world.counters.emptyPieces, 1u);
    EXPECT_EQ(areaOf(world.mesh, world.piece(cut, 0)), 7500.0);
    EXPECT_EQ(areaOf(world.mesh, world.piece(cut, 1)), 2500.0);
    EXPECT_EQ(areaOf(world.mesh, world.piece(cut, 2)), 1250.0);
}

TEST(SplitMesh, CutsAcrossTheLongestAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        World world;
        GridPoint far(10);
        far[axis] = 1000;
        GridPoint side(0);
        side[(axis + 1) % 3] = 10;
        world.add(world.wedge({0, 0, 0}), world.wedge(far), world.wedge(side));
        const Level cut = world.split(2);
        ASSERT_EQ(cut.pieces.size(), 2u);
        for (const MeshTriangle& t : world.piece(cut, 0)) {
            for (int k = 0; k < 3; ++k) EXPECT_LE(world.mesh.at(t.wedges[k])[axis], 500);
        }
        for (const MeshTriangle& t : world.piece(cut, 1)) {
            for (int k = 0; k < 3; ++k) EXPECT_GE(world.mesh.at(t.wedges[k])[axis], 500);
        }
    }
}

TEST(SplitMesh, InterpolatesTextureCoordinatesColoursAndNormalsAtTheCut) {
    World world;
    world.mesh.normals = {{1, 0, 0}, {0, 1, 0}};
    const std::uint32_t a = world.wedge({0, 0, 0}, {0.0f, 0.25f}),
                        b = world.wedge({400, 0, 0}, {1.0f, 0.75f}),
                        c = world.wedge({0, 40, 0}, {0.0f, 0.5f});
    world.mesh.wedges[a].colour = {0, 100, 200, 255};
    world.mesh.wedges[b].colour = {200, 100, 0, 255};
    world.level.triangles.push_back({{a, b, c}, {0, 1, 0}});
    const Level cut = world.split(4);  // edge a-b is cut at 100, 200 and 300
    std::map<int, const Wedge*> onEdge;
    std::map<int, glm::vec3> normals;
    for (const MeshTriangle& t : cut.triangles) {
        for (int k = 0; k < 3; ++k) {
            const GridPoint& p = world.mesh.at(t.wedges[k]);
            if (p.y != 0) continue;
            onEdge[p.x] = &world.mesh.wedges[t.wedges[k]];
            normals[p.x] = world.mesh.normals[t.normals[k]];
        }
    }
    ASSERT_EQ(onEdge.size(), 5u);
    for (const int x : {100, 200, 300}) {
        EXPECT_FLOAT_EQ(onEdge[x]->uv.x, static_cast<float>(x) / 400.0f);
        EXPECT_FLOAT_EQ(onEdge[x]->uv.y, 0.25f + 0.5f * static_cast<float>(x) / 400.0f);
        EXPECT_EQ(onEdge[x]->colour, glm::u8vec4(x / 2, 100, 200 - x / 2, 255));
        EXPECT_NEAR(glm::length(normals[x]), 1.0f, 1e-6f);
    }
    EXPECT_NEAR(normals[100].x, 0.9486833f, 1e-5f);  // (3,1)/sqrt(10)
    EXPECT_NEAR(normals[100].y, 0.3162278f, 1e-5f);
}

std::set<std::array<int, 3>> pointsAt(const World& world, const Level& level, std::size_t piece, int x) {
    std::set<std::array<int, 3>> points;
    for (const MeshTriangle& t : world.piece(level, piece)) {
        for (int k = 0; k < 3; ++k) {
            const GridPoint& p = world.mesh.at(t.wedges[k]);
            if (p.x == x) points.insert({p.x, p.y, p.z});
        }
    }
    return points;
}

TEST(SplitMesh, GivesBothSidesOfACutTheSameVertices) {
    World world;
    Random random(7);
    std::vector<std::uint32_t> wedges;
    for (int y = 0; y <= 10; ++y) {
        for (int x = 0; x <= 20; ++x) {
            const auto jitter = static_cast<int>(random.index(40));
            wedges.push_back(world.wedge({x * 100 + (x % 20 == 0 ? 0 : jitter), y * 77 + jitter, jitter}));
        }
    }
    const auto at = [&](int x, int y) { return wedges[static_cast<std::size_t>(y * 21 + x)]; };
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 20; ++x) {
            world.add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            world.add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    }
    const Level cut = world.split(2);
    ASSERT_EQ(cut.pieces.size(), 2u);
    const auto left = pointsAt(world, cut, 0, 1000), right = pointsAt(world, cut, 1, 1000);
    EXPECT_GE(left.size(), 11u);
    EXPECT_EQ(left, right);
}

// Counts the directed edges of a level, all pieces together.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directedEdges(const BlockMesh& mesh,
                                                                     const Level& level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const MeshTriangle& t : level.triangles) {
        for (int k = 0; k < 3; ++k) {
            ++edges[{mesh.wedges[t.wedges[k]].position, mesh.wedges[t.wedges[(k + 1) % 3]].position}];
        }
    }
    return edges;
}

// A closed surface stays closed if and only if no cut leaves a T-junction: within pieces, between siblings
// and where the planes of neighbouring pieces end on a common border.
TEST(SplitMesh, LeavesNoTJunctionBetweenAnyPiecesOfALevel) {
    QuantisedBlock sphere = quantiseBlock(test::blockOf(test::makeSphere(40, 20)), BlockTextures{});
    Level level;
    level.triangles = sphere.triangles;
    level.pieces = {{0, 0, static_cast<std::uint32_t>(level.triangles.size())}};
    const double area = areaOf(sphere.mesh, level.triangles);
    for (int depth = 0; depth < 4; ++depth) {
        SplitCounters counters;
        level = splitLevel(sphere.mesh, level, 3, counters);
        EXPECT_EQ(counters.degenerateTriangles, 0u);
        const auto edges = directedEdges(sphere.mesh, level);
        std::size_t open = 0;
        for (const auto& [edge, count] : edges) {
            const auto back = edges.find({edge.second, edge.first});
            if (count != 1 || back == edges.end()) ++open;
        }
        EXPECT_EQ(open, 0u) << "at depth " << depth;
        EXPECT_NEAR(areaOf(sphere.mesh, level.triangles), area, 1e-6 * area);
    }
    EXPECT_GT(level.pieces.size(), 60u);
}

TEST(SplitMesh, KeepsThePieceWhoseBoxIsTooShortToCut) {
    World world;
    world.add(world.wedge({0, 0, 0}), world.wedge({1, 0, 0}), world.wedge({0, 1, 0}));
    const Level cut = world.split(16);
    ASSERT_EQ(cut.pieces.size(), 1u);
    EXPECT_EQ(cut.pieces[0].size(), 1u);
    EXPECT_EQ(world.counters.emptyPieces, 15u);
}

// Random soups: slivers, flat and collinear triangles, shared and repeated edges.
RC_GTEST_PROP(SplitMesh, KeepsAreaAndBoundsOfRandomTriangles, (std::uint64_t seed, std::uint8_t size)) {
    Random random(seed);
    World world;
    std::vector<std::uint32_t> wedges;
    const int spread = 1 << (4 + random.index(18));
    for (int i = 0; i < 3 + size / 8; ++i) {
        GridPoint p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = static_cast<int>(random.index(static_cast<std::uint64_t>(spread)));
        if (random.index(4) == 0) p.z = 7;
        wedges.push_back(world.wedge(p));
    }
    for (int i = 0; i < 1 + size / 4; ++i) {
        const glm::uvec3 corners(wedges[random.index(wedges.size())], wedges[random.index(wedges.size())],
                                 wedges[random.index(wedges.size())]);
        if (!isDegenerate(world.mesh, corners)) world.add(corners.x, corners.y, corners.z);
    }
    RC_PRE(!world.level.triangles.empty());
    const int factor = 2 + static_cast<int>(random.index(5));
    const double area = areaOf(world.mesh, world.level.triangles);
    Level level = world.split(factor);
    for (int depth = 0; depth < 3; ++depth) {
        // Each snapped vertex moves by less than a step, each edge is at most 2 * spread long.
        RC_ASSERT(std::abs(areaOf(world.mesh, level.triangles) - area) <=
                  4.0 * spread * static_cast<double>(level.triangles.size()));
        if (spread > 1 << 18)
            RC_ASSERT(std::abs(areaOf(world.mesh, level.triangles) - area) <= 1e-4 * area + 4.0 * spread);
        std::uint32_t end = 0;
        for (const Piece& piece : level.pieces) {
            RC_ASSERT(piece.begin == end);
            RC_ASSERT(piece.end > piece.begin);
            end = piece.end;
        }
        RC_ASSERT(end == level.triangles.size());
        for (const MeshTriangle& t : level.triangles) RC_ASSERT(!isDegenerate(world.mesh, t.wedges));
        level = splitLevel(world.mesh, level, factor, world.counters);
    }
}

}  // namespace
}  // namespace fb
