#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <limits>

#include "import/clean_mesh.h"
#include "import/triangulate_polygon.h"
#include "temp_folder.h"

namespace fb::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

SourceMesh meshOf(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> triangles) {
    SourceMesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    mesh.materials.assign(mesh.triangles.size(), kNoMaterial);
    return mesh;
}

TEST(CleanMesh, WeldsVerticesThatAreEqualInEveryAttributeAndNoOthers) {
    //  Two triangles of a square with corners of their own; corner (1,0) has another colour in the second
    //  one.
    SourceMesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 1, -0.0}},
                             {{0, 1, 2}, {3, 4, 5}});
    mesh.colours.assign(6, glm::u8vec4(9));
    mesh.colours[3] = glm::u8vec4(8);
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    EXPECT_EQ(report.weldedVertices, 1u) << "only (0,1,0) with (-0,1,-0)";
    EXPECT_EQ(report.droppedVertices, 0u);
    EXPECT_EQ(report.keptTriangles, 2u);
    EXPECT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(3, 4, 2));
    EXPECT_EQ(mesh.colours[3], glm::u8vec4(8));
}

TEST(CleanMesh, CountsDegenerateAndDuplicateTrianglesExactly) {
    SourceMesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 0, 0}, {7, 7, 7}},
                             {
                                 {0, 1, 2},  // kept
                                 {1, 2, 0},  // the same, turned
                                 {2, 0, 1},  // the same, turned again
                                 {4, 1, 2},  // the same after welding vertex 4 with 0
                                 {0, 2, 1},  // the other side: kept
                                 {0, 0, 1},  // repeated vertex
                                 {0, 4, 1},  // repeated position
                                 {0, 1, 3},  // collinear
                                 {1, 3, 2},  // kept
                             });
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 1}, {1, 3, 2}}));
    EXPECT_EQ(report.duplicateTriangles, 3u);
    EXPECT_EQ(report.degenerateTriangles, 3u);
    EXPECT_EQ(report.keptTriangles, 3u);
    EXPECT_EQ(report.weldedVertices, 1u);
    EXPECT_EQ(report.droppedVertices, 1u) << "(7,7,7)";
    EXPECT_EQ(mesh.positions.size(), 4u);
}

TEST(CleanMesh, KeepsEqualTrianglesOfDifferentMaterials) {
    SourceMesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}});
    mesh.materials = {0, 1, 0};
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(report.duplicateTriangles, 1u);
}

TEST(CleanMesh, RefusesWhatNoMeshMayHave) {
    const auto errorOf = [](SourceMesh mesh) {
        ImportReport report;
        const Result<void> cleaned = cleanMesh(mesh, "house.obj", report);
        return cleaned ? std::string() : cleaned.error().oneLine();
    };
    EXPECT_TRUE(contains(errorOf(meshOf({{0, 0, 0}, {1, 0, 0}, {0, kInf, 0}}, {{0, 1, 2}})),
                         "house.obj: vertex 2: has a coordinate"));
    EXPECT_TRUE(contains(errorOf(meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}})),
                         "triangle 0: refers to vertex 3 of 3"));
    SourceMesh uneven = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    uneven.uvs.resize(2);
    EXPECT_TRUE(contains(errorOf(uneven), "not as many"));
    EXPECT_EQ(errorOf(meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kInf, 0, 0}}, {{0, 1, 2}})), "")
        << "vertex 3 is not used";
}

TEST(CleanMesh, SetsAttributesThatAreNotFiniteToZeroAndMakesNormalsUnit) {
    SourceMesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    mesh.normals = {{0, 0, 4}, {kNan, 0, 0}, {0, 0, 0}};
    mesh.uvs = {{0.5f, kNan}, {2, 3}, {static_cast<float>(kInf), 0}};
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    EXPECT_EQ(report.repairedAttributes, 3u)
        << "one normal and two texture coordinates; (0,0,0) is only unknown";
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0}, {2, 3}, {0, 0}}));
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(CleanMesh, GivesMissingNormalsTheAreaWeightedMeanOfEachPosition) {
    // Corner 0 belongs to a triangle of area 2 facing +z and, across a texture seam, to one of area 0.5
    // facing +x.
    SourceMesh mesh =
        meshOf({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {3, 4, 5}});
    mesh.uvs = {{0, 0}, {0, 0}, {0, 0}, {1, 1}, {1, 1}, {1, 1}};
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    ASSERT_EQ(mesh.positions.size(), 6u) << "the seam stays";
    const glm::vec3 mean = glm::normalize(glm::vec3(0.5f, 0.0f, 2.0f));
    EXPECT_LT(glm::distance(mesh.normals[0], mean), 1e-6f);
    EXPECT_EQ(mesh.normals[0], mesh.normals[3]) << "no edge in the shading along the seam";
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[5], glm::vec3(1, 0, 0));
}

TEST(CleanMesh, GivesSheetsWithTwoSidesTheNormalOfTheFirst) {
    SourceMesh mesh = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(CleanMesh, FindsTheAreaOfSmallTrianglesFarAway) {
    // 0.1 mm triangles at georeferenced coordinates have an area; only the last one has none.
    const glm::dvec3 far(6512345.0, 412345.0, 100.0);
    SourceMesh mesh = meshOf({far, far + glm::dvec3(1.0 / 8192, 0, 0), far + glm::dvec3(0, 1.0 / 8192, 0),
                              far + glm::dvec3(1.0 / 4096, 0, 0)},
                             {{0, 1, 2}, {0, 1, 3}});
    ImportReport report;
    ASSERT_TRUE(cleanMesh(mesh, "m", report));
    EXPECT_EQ(report.degenerateTriangles, 1u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
}

RC_GTEST_PROP(CleanMesh, IsDoneAfterOneTimeAndLosesNoTriangleItDoesNotCount, ()) {
    const auto vertices = *rc::gen::inRange(3, 30);
    SourceMesh mesh;
    for (int v = 0; v < vertices; ++v) {
        mesh.positions.emplace_back(*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3),
                                    *rc::gen::inRange(0, 3));
    }
    const auto triangles = *rc::gen::inRange(1, 60);
    const auto vertex = [&] { return static_cast<unsigned>(*rc::gen::inRange(0, vertices)); };
    for (int t = 0; t < triangles; ++t) mesh.triangles.emplace_back(vertex(), vertex(), vertex());
    mesh.materials.assign(mesh.triangles.size(), kNoMaterial);
    ImportReport first, second;
    RC_ASSERT(cleanMesh(mesh, "m", first).has_value());
    RC_ASSERT(first.keptTriangles + first.degenerateTriangles + first.duplicateTriangles ==
              static_cast<std::uint64_t>(triangles));
    RC_ASSERT(mesh.positions.size() + first.weldedVertices + first.droppedVertices ==
              static_cast<std::uint64_t>(vertices));
    const SourceMesh once = mesh;
    RC_ASSERT(cleanMesh(mesh, "m", second).has_value());
    RC_ASSERT(second.weldedVertices + second.droppedVertices + second.degenerateTriangles +
                  second.duplicateTriangles ==
              0u);
    RC_ASSERT(mesh.triangles == once.triangles);
    RC_ASSERT(mesh.positions == once.positions);
    for (const glm::vec3& normal : mesh.normals) RC_ASSERT(std::abs(glm::length(normal) - 1.0f) < 1e-6f);
}

// --- Polygons ---

double areaOf(const std::vector<glm::dvec3>& corners, const std::vector<glm::uvec3>& triangles) {
    double sum = 0.0;
    for (const glm::uvec3& t : triangles) {
        sum += 0.5 * glm::length(glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]));
    }
    return sum;
}

TEST(TriangulatePolygon, CutsAConcaveQuadAlongTheDiagonalInside) {
    // A dart: corner 2 points inward. Area 4 * 3 / 2 minus 4 * 1 / 2.
    const std::vector<glm::dvec3> dart{{0, 0, 0}, {2, 3, 0}, {4, 0, 0}, {2, 1, 0}};
    for (std::size_t start = 0; start < 4; ++start) {
        std::vector<glm::dvec3> turned(dart);
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start), turned.end());
        std::vector<glm::uvec3> triangles;
        triangulatePolygon(turned, triangles);
        ASSERT_EQ(triangles.size(), 2u);
        EXPECT_DOUBLE_EQ(areaOf(turned, triangles), 4.0) << start;
    }
}

TEST(TriangulatePolygon, TakesTheShorterDiagonalOfAConvexQuad) {
    std::vector<glm::uvec3> triangles;
    triangulatePolygon(std::vector<glm::dvec3>{{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}}, triangles);
    EXPECT_EQ(triangles, (std::vector<glm::uvec3>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(TriangulatePolygon, UsesEveryCornerOfPolygonsThatCrossThemselvesOrHaveNoArea) {
    const std::vector<glm::dvec3> cases[] = {
        {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 5, 0}},  // crosses itself
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},  // a line
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},  // a point
        {{0, 0, kInf}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.5, 0}},
    };
    for (const auto& corners : cases) {
        std::vector<glm::uvec3> triangles;
        triangulatePolygon(corners, triangles);
        ASSERT_EQ(triangles.size(), 3u);
        std::vector<bool> used(5, false);
        for (const glm::uvec3& t : triangles) used[t.x] = used[t.y] = used[t.z] = true;
        EXPECT_EQ(used, std::vector<bool>(5, true));
    }
}

// Star-shaped polygons around a point: simple, mostly concave. Area by the shoelace formula, in a plane of
// any tilt.
RC_GTEST_PROP(TriangulatePolygon, KeepsTheAreaAndTheSideOfSimplePolygons, ()) {
    const auto n = *rc::gen::inRange(3, 40);
    const bool clockwise = *rc::gen::arbitrary<bool>();
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0, *rc::gen::inRange(-9, 9), 0.5));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(*rc::gen::inRange(1, 9), 0.25, 1.0)));
    std::vector<glm::dvec2> flat;
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * (clockwise ? -i : i) / n, radius = *rc::gen::inRange(1, 20);
        flat.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        corners.push_back(glm::dvec3(5000, -7000, 3) + flat.back().x * u + flat.back().y * v);
    }
    double shoelace = 0.0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        const glm::dvec2 a = flat[i], b = flat[(i + 1) % flat.size()];
        shoelace += 0.5 * (a.x * b.y - a.y * b.x);
    }
    std::vector<glm::uvec3> triangles;
    triangulatePolygon(corners, triangles);
    RC_ASSERT(triangles.size() == flat.size() - 2);
    RC_ASSERT(std::abs(areaOf(corners, triangles) - std::abs(shoelace)) < 1e-6 * std::abs(shoelace));
    const glm::dvec3 side = glm::cross(u, v) * (shoelace > 0.0 ? 1.0 : -1.0);
    for (const glm::uvec3& t : triangles) {
        RC_ASSERT(glm::dot(glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]), side) >
                  -1e-6);
    }
}

}  // namespace
}  // namespace fb::test
