// A height map as a quadtree: counts, exact leaves, borders, one result whatever the threads, resumed builds.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <fstream>
#include <map>
#include <set>

#include "terrain_world.h"

namespace fb {
namespace {

using test::HandMadeTerrain;
using test::kHole;
using test::ShownNode;

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<float> flat(std::size_t count) {
    return std::vector<float>(count, 2.0f);
}

// Nodes a level, and triangles without skirts a level.
struct LevelCounts {
    std::vector<int> nodes, triangles;
};
LevelCounts countsOf(const Hierarchy& h) {
    LevelCounts counts;
    counts.nodes.resize(h.maxLevel() + 1u);
    counts.triangles.resize(h.maxLevel() + 1u);
    for (NodeId n = 0; n < h.size(); ++n) {
        ++counts.nodes[h.level[n]];
        counts.triangles[h.level[n]] += static_cast<int>(h.triangles(n) - h.skirtTriangles[n]);
    }
    return counts;
}

TEST(LayOutTerrain, TakesSquaresWithAtMostTwiceTheDesiredTriangles) {
    EXPECT_EQ(layOutTerrain(9, 9, 900).leafCells(), 16u);  // 512 triangles; 32 cells would have 2048
    EXPECT_EQ(layOutTerrain(9, 9, 16).leafCells(), 4u);
    EXPECT_EQ(layOutTerrain(9, 9, 1024).leafCells(), 32u);
    EXPECT_EQ(layOutTerrain(17, 9, 900).depth, 0u);
    EXPECT_EQ(layOutTerrain(18, 9, 900).depth, 1u);
    EXPECT_EQ(layOutTerrain(2, 1025, 900).depth, 6u);
}

//  5 x 3 cells, leaves of 4 x 4: [4x3] [1x3] below one root.
TEST(BuildTerrain, CountsOfSmallMaps) {
    const ScratchFolder folder;
    HandMadeTerrain four(5, 5, flat(25));
    ASSERT_EQ(test::buildLine(four, folder / "four"), "built");
    const Scene one = openScene(folder / "four").value();
    EXPECT_EQ(one.hierarchy.size(), 1u);
    EXPECT_EQ(countsOf(one.hierarchy).triangles, (std::vector<int>{32}));
    EXPECT_EQ(one.hierarchy.skirtTriangles[0], 0u);
    EXPECT_TRUE(one.hierarchy.isTerrain(0));

    HandMadeTerrain five(6, 4, flat(24));
    ASSERT_EQ(test::buildLine(five, folder / "five"), "built");
    const Scene two = openScene(folder / "five").value();
    const LevelCounts counts = countsOf(two.hierarchy);
    EXPECT_EQ(counts.nodes, (std::vector<int>{1, 2}));
    EXPECT_EQ(counts.triangles[1], 30);
    EXPECT_EQ(two.hierarchy.triangles(1), 24u);  // no neighbour of another level: no skirts
    EXPECT_EQ(two.hierarchy.triangles(2), 6u);
    EXPECT_LE(counts.triangles[0], 16);
    EXPECT_EQ(two.hierarchy.geometricErrorMetres[0], 0.0f);  // it is flat
    EXPECT_EQ(two.info.sourceTriangles, 30u);
    EXPECT_NEAR(two.info.sourceAreaSquareMetres, 15.0, 1e-3);
}

TEST(BuildTerrain, ThinMapsAndSquaresWithoutACellAreNoTrouble) {
    const ScratchFolder folder;
    HandMadeTerrain thin(2, 40, flat(80));
    ASSERT_EQ(test::buildLine(thin, folder / "thin"), "built");
    EXPECT_EQ(countsOf(openScene(folder / "thin")->hierarchy).nodes, (std::vector<int>{1, 2, 3, 5, 10}));

    // 9 x 9 heights of which only the outer 3 x 3 corners at the upper left and the lower right are known.
    std::vector<float> heights(81, kHole);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) heights[r * 9 + c] = heights[(8 - r) * 9 + 8 - c] = 1.0f;
    }
    HandMadeTerrain corners(9, 9, heights);
    ASSERT_EQ(test::buildLine(corners, folder / "corners"), "built");
    const Scene scene = openScene(folder / "corners").value();
    EXPECT_EQ(countsOf(scene.hierarchy).nodes, (std::vector<int>{1, 2}));
    EXPECT_EQ(countsOf(scene.hierarchy).triangles[1], 16);
}

TEST(BuildTerrain, LeavesHoldEveryHeightExactlyAndNoCellTwice) {
    const ScratchFolder folder;
    HandMadeTerrain terrain = test::randomTerrain(23, 18, 3, 0.3);
    ASSERT_EQ(test::buildLine(terrain, folder / "s"), "built");
    const Scene scene = openScene(folder / "s").value();
    std::map<std::pair<int, int>, double> seen;
    std::multiset<std::pair<int, int>> cells;
    for (NodeId n = 0; n < scene.hierarchy.size(); ++n) {
        if (!scene.hierarchy.isLeaf(n)) continue;
        const ShownNode node = test::shownNode(scene, n);
        for (const glm::uvec3& t : node.surface) {
            int left = 1000, top = 1000;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3& p = node.vertices[t[k]];
                const auto [at, isNew] = seen.emplace(std::pair(std::lround(p.x), std::lround(p.z)), p.y);
                EXPECT_EQ(at->second, p.y);
                left = std::min(left, static_cast<int>(std::lround(p.x)));
                top = std::min(top, static_cast<int>(std::lround(p.z)));
            }
            cells.insert({left, top});
        }
    }
    std::size_t expectedCells = 0;
    for (std::uint32_t r = 0; r + 1 < 18; ++r) {
        for (std::uint32_t c = 0; c + 1 < 23; ++c) {
            const float all =
                terrain.at(c, r) + terrain.at(c + 1, r) + terrain.at(c, r + 1) + terrain.at(c + 1, r + 1);
            const std::size_t triangles = cells.count({static_cast<int>(c), static_cast<int>(r)});
            EXPECT_EQ(triangles, all == all ? 2u : 0u) << c << " " << r;
            expectedCells += all == all ? 1 : 0;
        }
    }
    EXPECT_EQ(cells.size(), 2 * expectedCells);
    for (const auto& [at, height] : seen) {
        EXPECT_EQ(height, static_cast<double>(terrain.at(static_cast<std::uint32_t>(at.first),
                                                         static_cast<std::uint32_t>(at.second))));
    }
}

TEST(BuildTerrain, TilesOfOneLevelHaveTheSameVerticesAlongTheirBorder) {
    const ScratchFolder folder;
    HandMadeTerrain terrain = test::randomTerrain(60, 70, 11, 0.5);
    ASSERT_EQ(test::buildLine(terrain, folder / "s"), "built");
    const Scene scene = openScene(folder / "s").value();
    const Hierarchy& h = scene.hierarchy;
    // By level and line: edges of triangles that lie on it, with their heights. Both sides have each edge, or
    // one does where the other has a hole.
    int shared = 0;
    for (std::uint32_t level = 1; level <= h.maxLevel(); ++level) {
        const int side = 4 << (h.maxLevel() - level);
        using Edge = std::array<double, 6>;
        std::map<Edge, int> edges;
        std::map<std::pair<double, double>, double> heights;
        for (NodeId n = 0; n < h.size(); ++n) {
            if (h.level[n] != level) continue;
            const ShownNode node = test::shownNode(scene, n);
            for (const glm::uvec3& t : node.surface) {
                for (int k = 0; k < 3; ++k) {
                    glm::dvec3 a = node.vertices[t[k]], b = node.vertices[t[(k + 1) % 3]];
                    if (std::pair(b.x, b.z) < std::pair(a.x, a.z)) std::swap(a, b);
                    const bool vertical = a.x == b.x && std::lround(a.x) % side == 0 && a.x > 0 && a.x < 59;
                    const bool level_ = a.z == b.z && std::lround(a.z) % side == 0 && a.z > 0 && a.z < 69;
                    if (!vertical && !level_) continue;
                    ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
                    for (const glm::dvec3& p : {a, b}) {
                        const auto [at, isNew] = heights.emplace(std::pair(p.x, p.z), p.y);
                        EXPECT_EQ(at->second, p.y) << "level " << level;
                    }
                }
            }
        }
        // No edge of one side passes over a vertex of the other: where two edges overlap they are equal.
        for (const auto& [edge, count] : edges) {
            EXPECT_LE(count, 2);
            shared += count == 2 ? 1 : 0;
            for (const auto& [at, height] : heights) {
                const bool inside = edge[0] == edge[3]
                                        ? at.first == edge[0] && at.second > edge[2] && at.second < edge[5]
                                        : at.second == edge[2] && at.first > edge[0] && at.first < edge[3];
                EXPECT_FALSE(inside) << "level " << level << ": a vertex at " << at.first << " " << at.second;
            }
        }
    }
    EXPECT_GT(shared, 100);
}

TEST(BuildTerrain, GivesTheSameBytesWithOneThreadAndWithFour) {
    const ScratchFolder folder;
    HandMadeTerrain terrain = test::randomTerrain(200, 150, 5, 0.4);
    for (const auto& [name, threads] : {std::pair{"one", 1}, {"four", 4}}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        ASSERT_EQ(test::buildLine(terrain, folder / name), "built");
    }
    for (const char* file : {"hierarchy.bin", "scene.toml", "blocks/00000.pack"}) {
        EXPECT_EQ(bytesOf(folder / "one" / file), bytesOf(folder / "four" / file)) << file;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "one/terrain-work"));
}

TEST(BuildTerrain, AStoppedBuildGoesOnWhereItWas) {
    const ScratchFolder folder;
    HandMadeTerrain terrain = test::randomTerrain(200, 150, 5, 0.4);
    ASSERT_EQ(test::buildLine(terrain, folder / "whole"), "built");
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    int told = 0;
    const Progress stopAfterSome = [&](std::string_view phase, double) {
        return phase != "build terrain" || ++told < 4;
    };
    Result<BuildReport> stopped =
        buildScene(test::TerrainAlone(terrain), test::terrainSettings(16), folder / "s", stopAfterSome);
    ASSERT_FALSE(stopped);
    EXPECT_NE(stopped.error().oneLine().find("was stopped"), std::string::npos);
    const std::filesystem::path part = folder / "s/terrain-work/blocks/00000.pack";
    ASSERT_TRUE(std::filesystem::exists(part));
    const auto written = std::filesystem::last_write_time(part);
    std::filesystem::file_time_type later{};
    const Progress lookAtPart = [&](std::string_view, double) {
        if (std::filesystem::exists(part)) later = std::filesystem::last_write_time(part);
        return true;
    };
    Result<BuildReport> resumed =
        buildScene(test::TerrainAlone(terrain), test::terrainSettings(16), folder / "s", lookAtPart);
    ASSERT_TRUE(resumed);
    EXPECT_EQ(later, written);  // the finished part was taken over
    EXPECT_EQ(bytesOf(folder / "s/blocks/00000.pack"), bytesOf(folder / "whole/blocks/00000.pack"));
    EXPECT_EQ(bytesOf(folder / "s/hierarchy.bin"), bytesOf(folder / "whole/hierarchy.bin"));

    // A finished terrain is taken over without a look at its heights.
    const int reads = terrain.reads;
    Result<BuildReport> again =
        buildScene(test::TerrainAlone(terrain), test::terrainSettings(16), folder / "s", {});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->reusedBlocks, 1u);
    EXPECT_EQ(again->leafTriangles, resumed->leafTriangles);
    EXPECT_EQ(terrain.reads, reads);
}

TEST(BuildTerrain, HeightsOfAMillionMetresAndNarrowCellsAreBuiltOrRefused) {
    const ScratchFolder folder;
    std::vector<float> heights(33 * 33);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = i % 2 == 0 ? 1e6f : -1e6f;
    HandMadeTerrain cliffs(33, 33, heights);
    ASSERT_EQ(test::buildLine(cliffs, folder / "cliffs"), "built");
    EXPECT_TRUE(checkScene(folder / "cliffs", {})->faults.empty());
    HandMadeTerrain narrow(33, 33, heights, 0.1);
    EXPECT_NE(test::buildLine(narrow, folder / "narrow").find("its cells are too narrow"), std::string::npos);
}

TEST(BuildTerrain, ZUpHasTheSameSurfaceTurned) {
    const ScratchFolder folder;
    HandMadeTerrain terrain = test::randomTerrain(20, 20, 9, 0.2);
    ASSERT_EQ(test::buildLine(terrain, folder / "y"), "built");
    terrain.change().up = UpAxis::z;
    ASSERT_EQ(test::buildLine(terrain, folder / "z"), "built");
    const Scene y = openScene(folder / "y").value(), z = openScene(folder / "z").value();
    ASSERT_EQ(y.hierarchy.size(), z.hierarchy.size());
    for (NodeId n = 0; n < y.hierarchy.size(); ++n) {
        EXPECT_NEAR(y.hierarchy.geometricErrorMetres[n], z.hierarchy.geometricErrorMetres[n], 1e-4);
        EXPECT_GT(y.hierarchy.averageNormal[n].y, 0.0f);
        EXPECT_GT(z.hierarchy.averageNormal[n].z, 0.0f);
        EXPECT_NEAR(y.hierarchy.bounds[n].min.z, -z.hierarchy.bounds[n].max.y, 1e-4);
        EXPECT_NEAR(y.hierarchy.bounds[n].max.y, z.hierarchy.bounds[n].max.z, 1e-4);
    }
}

}  // namespace
}  // namespace fb
