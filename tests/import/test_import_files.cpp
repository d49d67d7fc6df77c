#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "base/random.h"
#include "temp_folder.h"

namespace fb::test {
namespace {

// A flat square of side `metres` in the ground plane (y up) with 2 * n * n triangles, its corner at (x, z).
std::string square(int n, double metres, double x, double z, int firstVertex = 1) {
    std::ostringstream text;
    text.precision(17);
    text << "vt 0 0\n";
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k)
            text << "v " << x + metres * k / n << " 0 " << z + metres * i / n << '\n';
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            const int a = firstVertex + i * (n + 1) + k, c = a + n + 1;
            text << "f " << a << "/1 " << c << "/1 " << a + 1 << "/1\nf " << a + 1 << "/1 " << c << "/1 "
                 << c + 1 << "/1\n";
        }
    }
    return text.str();
}

std::unique_ptr<BlockSource> import(const std::vector<std::filesystem::path>& files,
                                    const ImportOptions& options = {}) {
    Result<std::unique_ptr<BlockSource>> source = importFiles(files, options, {});
    EXPECT_TRUE(source.has_value()) << (source ? "" : source.error().oneLine());
    return source ? std::move(*source) : nullptr;
}

std::vector<SourceBlock> blocksOf(const BlockSource& source) {
    std::vector<SourceBlock> blocks;
    for (std::size_t b = 0; b < source.blockCount(); ++b) blocks.push_back(*source.load(b));
    return blocks;
}

TEST(ImportFiles, MakesOneBlockOfEachFile) {
    const TempFolder folder;
    const auto source =
        import({folder.write("a.obj", square(2, 1, 0, 0)), folder.write("b.obj", square(3, 1, 5, 0))});
    ASSERT_TRUE(source);
    ASSERT_EQ(source->blockCount(), 2u);
    const std::vector<SourceBlock> blocks = blocksOf(*source);
    EXPECT_EQ(blocks[0].name, "a");
    EXPECT_EQ(blocks[0].mesh.triangles.size(), 8u);
    EXPECT_EQ(blocks[1].name, "b");
    EXPECT_EQ(blocks[1].mesh.triangles.size(), 18u);
    EXPECT_EQ(source->info().name, "a");
    EXPECT_EQ(source->info().files.size(), 2u);
    EXPECT_EQ(source->info().bounds.min, glm::dvec3(0, 0, 0));
    EXPECT_EQ(source->info().bounds.max, glm::dvec3(6, 0, 1));
    EXPECT_EQ(source->info().report.keptTriangles, 26u);
    EXPECT_FALSE(source->load(2).has_value());
}

TEST(ImportFiles, KeepsCoordinatesFarAwayRelativeToWholeMetres) {
    const TempFolder folder;
    const auto far = import({folder.write("far.obj",
                                          "v 6512345.6789 412345.25 101\nv 6512347.6789 412345 101.5\n"
                                          "v 6512345 412348.125 99\nf 1 2 3\n")});
    ASSERT_TRUE(far);
    // The middle is (6512346.33945, 412346.5625, 100.25).
    EXPECT_EQ(far->info().origin, glm::dvec3(6512346, 412347, 100));
    const SourceMesh mesh = far->load(0)->mesh;
    EXPECT_NEAR(mesh.positions[0].x, -0.3211, 1e-9);
    EXPECT_EQ(mesh.positions[0].y, -1.75);
    EXPECT_NEAR(far->info().bounds.max.x, 1.6789, 1e-9);

    const auto near = import({folder.write("near.obj", square(1, 100, 900, 0))});
    EXPECT_EQ(near->info().origin, glm::dvec3(0)) << "neither 10 km nor ten diagonals away";
    const auto small = import({folder.write("small.obj", square(1, 1, 900, 0))});
    EXPECT_EQ(small->info().origin, glm::dvec3(901, 0, 1)) << "(900.5, 0, 0.5) rounded away from zero";
}

TEST(ImportFiles, TakesTheUpAxisOfTheOptionsOrTheUsualOneOfTheFormat) {
    const TempFolder folder;
    const auto obj = folder.write("a.obj", square(1, 1, 0, 0));
    const auto stl = folder.write("a.stl",
                                  "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                  "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    EXPECT_EQ(import({obj})->info().up, UpAxis::y);
    EXPECT_EQ(import({stl})->info().up, UpAxis::z);
    ImportOptions options;
    options.up = UpAxis::z;
    EXPECT_EQ(import({obj}, options)->info().up, UpAxis::z);
    EXPECT_EQ(warningsWith(import({obj, stl})->info().report, "nothing is turned"), 1);
    EXPECT_EQ(warningsWith(import({obj, stl}, options)->info().report, "nothing is turned"), 0);
}

// Three groups of 2 * 20 * 20 = 800 triangles, each with a material of its own, one of them twice in the
// file.
std::string threeGroups() {
    std::ostringstream text;
    text << "mtllib m.mtl\n";
    for (int g = 0; g < 3; ++g) {
        text << "g part" << g << "\nusemtl m" << g << '\n' << square(20, 10, 20.0 * g, 0, 1 + g * 441);
    }
    text << "g part0\nf 1/1 2/1 3/1\n";
    return text.str();
}

TEST(ImportFiles, MakesBlocksOfGroupsOfGoodSize) {
    const TempFolder folder;
    folder.write("m.mtl",
                 "newmtl m0\nmap_Kd a.png\nnewmtl m1\nKd 1 0 0\nnewmtl unused\nmap_Kd b.png\nnewmtl "
                 "m2\nmap_Kd b.png\n");
    folder.write("a.png", "x");
    folder.write("b.png", "x");
    const auto file = folder.write("g.obj", threeGroups());
    const auto source = import({file});
    ASSERT_EQ(source->blockCount(), 3u);
    const std::vector<SourceBlock> blocks = blocksOf(*source);
    // The last triangle has no area: it lies on an edge of the first square.
    EXPECT_EQ(blocks[0].mesh.triangles.size(), 800u);
    EXPECT_EQ(source->info().report.degenerateTriangles, 1u);
    EXPECT_EQ(blocks[1].name, "part1");
    ASSERT_EQ(blocks[1].materials.size(), 1u) << "only what the block uses";
    EXPECT_EQ(blocks[1].materials[0].name, "m1");
    EXPECT_TRUE(blocks[1].textures.empty());
    ASSERT_EQ(blocks[2].textures.size(), 1u);
    EXPECT_EQ(blocks[2].textures[0].name, "b.png");
    EXPECT_EQ(blocks[2].materials[blocks[2].mesh.materials[0]].texture, 0);
    EXPECT_EQ(blocks[2].mesh.positions.size(), 441u);
    EXPECT_EQ(source->info().files.size(), 4u) << "the mesh, its materials and two textures";

    ImportOptions options;
    options.split = BlockSplit::none;
    EXPECT_EQ(import({file}, options)->blockCount(), 1u);
    options.split = BlockSplit::automatic;
    options.trianglesPerBlock = 399;
    EXPECT_EQ(import({file}, options)->load(0)->name, "g row 0 column 0")
        << "groups above twice the aim: the grid";
}

TEST(ImportFiles, MakesNoBlocksOfSmallGroupsUnlessAsked) {
    const TempFolder folder;
    std::ostringstream text;
    for (int g = 0; g < 3; ++g) text << "o part" << g << '\n' << square(15, 10, 20.0 * g, 0, 1 + g * 256);
    const auto file = folder.write("g.obj", text.str());
    EXPECT_EQ(import({file})->blockCount(), 1u) << "450 triangles a group are too few";
    ImportOptions options;
    options.split = BlockSplit::groups;
    EXPECT_EQ(import({file}, options)->blockCount(), 3u);
}

TEST(ImportFiles, CutsAFileOfMoreThanTwiceTheAimOnAGroundGrid) {
    const TempFolder folder;
    const auto file = folder.write("s.obj", square(20, 10, 0, 0));
    ImportOptions options;
    options.trianglesPerBlock = 400;
    EXPECT_EQ(import({file}, options)->blockCount(), 1u) << "800 triangles are exactly twice the aim";
    options.trianglesPerBlock = 200;
    const auto source = import({file}, options);
    ASSERT_EQ(source->blockCount(), 4u);
    const std::vector<SourceBlock> blocks = blocksOf(*source);
    for (const SourceBlock& block : blocks) EXPECT_EQ(block.mesh.triangles.size(), 200u);
    EXPECT_EQ(blocks[1].name, "s row 0 column 1");
    EXPECT_EQ(blocks[2].name, "s row 1 column 0");
}

TEST(ImportFiles, HashesContentsAndOptionsButNotNames) {
    const TempFolder folder, other;
    folder.write("m.mtl", "newmtl a\nmap_Kd t.png\n");
    folder.write("t.png", "one");
    const std::string mesh = "mtllib m.mtl\nusemtl a\nvt 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n";
    const auto file = folder.write("a.obj", mesh);
    std::set<std::uint64_t> hashes{import({file})->info().sourceHash};
    other.write("m.mtl", "newmtl a\nmap_Kd t.png\n");
    other.write("t.png", "one");
    EXPECT_TRUE(hashes.count(import({other.write("b.obj", mesh)})->info().sourceHash) == 1);
    ImportOptions grid;
    grid.split = BlockSplit::grid;
    EXPECT_TRUE(hashes.insert(import({file}, grid)->info().sourceHash).second);
    ImportOptions smaller;
    smaller.trianglesPerBlock = 7;
    EXPECT_TRUE(hashes.insert(import({file}, smaller)->info().sourceHash).second);
    ImportOptions up;  // a triangle that lies in the plane z = 0 has z up by itself
    up.up = UpAxis::y;
    EXPECT_TRUE(hashes.insert(import({file}, up)->info().sourceHash).second);
    folder.write("t.png", "two");
    EXPECT_TRUE(hashes.insert(import({file})->info().sourceHash).second) << "another texture";
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\nmap_Kd t.png\n");
    EXPECT_TRUE(hashes.insert(import({file})->info().sourceHash).second) << "other materials";
    folder.write("a.obj", mesh + "# end\n");
    EXPECT_TRUE(hashes.insert(import({file})->info().sourceHash).second) << "another mesh";
}

TEST(ImportFiles, StopsWhenProgressSaysSo) {
    const TempFolder folder;
    const std::vector<std::filesystem::path> files{folder.write("a.obj", square(1, 1, 0, 0)),
                                                   folder.write("b.obj", square(1, 1, 0, 0))};
    std::vector<std::string> phases;
    const auto go = [&](std::string_view phase, double fraction) {
        phases.push_back(std::string(phase) + " " + std::to_string(fraction).substr(0, 3));
        return true;
    };
    ASSERT_TRUE(importFiles(files, {}, go).has_value());
    EXPECT_EQ(phases, (std::vector<std::string>{"reading 0.0", "reading 0.5", "splitting 0.0",
                                                "splitting 0.5", "splitting 1.0"}));
    for (std::size_t stop = 0; stop < phases.size(); ++stop) {
        std::size_t calls = 0;
        const auto result = importFiles(files, {}, [&](std::string_view, double) { return calls++ < stop; });
        ASSERT_FALSE(result.has_value());
        EXPECT_EQ(result.error().reason, "the import was stopped");
        EXPECT_EQ(calls, stop + 1);
    }
}

TEST(ImportFiles, RefusesNothingAtAllAndMeshesWithoutArea) {
    const auto none = importFiles({}, {}, {});
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().kind, Error::Kind::usage);
    const TempFolder folder;
    const std::vector<std::filesystem::path> line{
        folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")};
    EXPECT_TRUE(contains(importFiles(line, {}, {}).error().oneLine(), "has no triangle with an area"));
    ImportOptions options;
    options.trianglesPerBlock = 0;
    EXPECT_EQ(importFiles(line, options, {}).error().kind, Error::Kind::usage);
}

TEST(ImportReport, AddsCountsAndTellsEachWarningOnce) {
    ImportReport a, b;
    a.sourceTriangles = 3;
    a.duplicateTriangles = 1;
    a.warnings = {"x is missing"};
    b.sourceTriangles = 4;
    b.weldedVertices = 5;
    b.warnings = {"x is missing", "y is missing"};
    EXPECT_TRUE(ImportReport{}.lines().empty());
    a.add(b);
    EXPECT_EQ(a.sourceTriangles, 7u);
    EXPECT_EQ(a.lines(), (std::vector<std::string>{"1 triangle that was there twice was dropped",
                                                   "5 vertices were joined with equal ones", "x is missing",
                                                   "y is missing"}));
}

// --- The ground grid ---

// Triangles as corner positions, sorted: the same in any order and numbering.
std::multiset<std::array<double, 9>> cornersOf(const SourceMesh& mesh) {
    std::multiset<std::array<double, 9>> triangles;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<double, 9> corners{};
        for (int i = 0; i < 9; ++i) corners[static_cast<std::size_t>(i)] = mesh.positions[t[i / 3]][i % 3];
        triangles.insert(corners);
    }
    return triangles;
}

RC_GTEST_PROP(SplitOnGroundGrid, KeepsEveryTriangleExactlyOnce, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto triangles = static_cast<unsigned>(*rc::gen::inRange(1, 400));
    const auto perBlock = static_cast<std::uint64_t>(*rc::gen::inRange(1, 60));
    const UpAxis up = *rc::gen::arbitrary<bool>() ? UpAxis::y : UpAxis::z;
    const double depth = *rc::gen::element(0.0, 1.0, 300.0);
    SourceBlock block;
    block.materials.resize(3);
    for (unsigned t = 0; t < triangles; ++t) {
        for (int c = 0; c < 3; ++c) {
            block.mesh.positions.emplace_back(random.uniform(-50, 50), random.uniform(-1, 1) * depth,
                                              random.uniform(0, 9));
            block.mesh.uvs.emplace_back(static_cast<float>(t), static_cast<float>(c));
        }
        block.mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
        block.mesh.materials.push_back(t % 4 == 3 ? kNoMaterial : t % 4);
    }
    for (unsigned m = 0; m < 3; ++m) block.materials[m].name = std::to_string(m);
    const std::multiset<std::array<double, 9>> before = cornersOf(block.mesh);
    std::multiset<std::array<double, 9>> after;
    const auto blocks = splitOnGroundGrid(std::move(block), up, perBlock);
    for (const SourceBlock& part : blocks) {
        RC_ASSERT(!part.mesh.triangles.empty());
        after.merge(cornersOf(part.mesh));
        std::vector<bool> used(part.mesh.positions.size(), false);
        for (std::size_t t = 0; t < part.mesh.triangles.size(); ++t) {
            const glm::uvec3 corners = part.mesh.triangles[t];
            used[corners.x] = used[corners.y] = used[corners.z] = true;
            // The texture coordinate carries the number of the source triangle, the material's name its rest
            // by 4.
            const auto source = static_cast<unsigned>(part.mesh.uvs[corners.x].x);
            RC_ASSERT(part.mesh.uvs[corners.z].y == 2.0f);
            const std::uint32_t material = part.mesh.materials[t];
            const bool matches = source % 4 == 3
                                     ? material == kNoMaterial
                                     : part.materials.at(material).name == std::to_string(source % 4);
            RC_ASSERT(matches);
        }
        RC_ASSERT(std::find(used.begin(), used.end(), false) == used.end());
    }
    RC_ASSERT(after == before);
}

TEST(SplitOnGroundGrid, MakesBlocksOfTheWantedMeanSizeThoughHalfOfTheGroundIsEmpty) {
    // 20,000 small triangles along a diagonal street 1000 m long and 10 m wide.
    Random random(5);
    SourceBlock block;
    for (unsigned t = 0; t < 20000; ++t) {
        const double along = random.uniform(0, 700), across = random.uniform(-5, 5);
        const glm::dvec3 at(along + across, random.uniform(0, 20), along - across);
        for (const glm::dvec3& corner : {at, at + glm::dvec3(0.1, 0, 0), at + glm::dvec3(0, 0, 0.1)})
            block.mesh.positions.push_back(corner);
        block.mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
        block.mesh.materials.push_back(kNoMaterial);
    }
    const std::vector<SourceBlock> blocks = splitOnGroundGrid(std::move(block), UpAxis::y, 1000);
    EXPECT_GE(blocks.size(), 17u);
    EXPECT_LE(blocks.size(), 23u);
    for (const SourceBlock& part : blocks) {
        Box3d bounds;
        for (const glm::dvec3& p : part.mesh.positions) bounds.grow(p);
        EXPECT_LT(bounds.size().x, 100.0) << "cells are about square: none reaches along the whole street";
        EXPECT_LT(bounds.size().z, 100.0);
    }
}

TEST(SplitOnGroundGrid, SplitsAWallAlongItsLengthOnly) {
    SourceBlock block;
    for (unsigned t = 0; t < 100; ++t) {
        for (const glm::dvec3& corner : {glm::dvec3(t, 0, 3), glm::dvec3(t + 1.0, 0, 3), glm::dvec3(t, 9, 3)})
            block.mesh.positions.push_back(corner);
        block.mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
        block.mesh.materials.push_back(kNoMaterial);
    }
    const std::vector<SourceBlock> blocks = splitOnGroundGrid(std::move(block), UpAxis::y, 25);
    ASSERT_EQ(blocks.size(), 4u);
    for (const SourceBlock& part : blocks) EXPECT_EQ(part.mesh.triangles.size(), 25u);
    EXPECT_TRUE(splitOnGroundGrid(SourceBlock{}, UpAxis::y, 25).empty());
}

}  // namespace
}  // namespace fb::test
