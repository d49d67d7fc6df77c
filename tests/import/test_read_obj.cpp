#define TINYOBJLOADER_USE_DOUBLE
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <tiny_obj_loader.h>

#include <sstream>

#include "temp_folder.h"

namespace fb::test {
namespace {

std::string cubeObj() {
    std::ostringstream text;
    for (const auto& c : kCubeCorners) text << "v " << c[0] << ' ' << c[1] << ' ' << c[2] << '\n';
    for (const auto& s : kCubeSquares)
        text << "f " << s[0] + 1 << ' ' << s[1] + 1 << ' ' << s[2] + 1 << ' ' << s[3] + 1 << '\n';
    return text.str();
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ReadObj, CutsTheSquaresOfACubeIntoTwelveTriangles) {
    expectCube(readText("cube.obj", cubeObj()));
}

TEST(ReadObj, ReadsIndicesThatCountBackFromTheLastVertex) {
    const Read r = readText("t.obj", std::string(kTriangle) + "f -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.corner(0, 0), glm::dvec3(0, 0, 0));
    EXPECT_EQ(r.corner(0, 2), glm::dvec3(0, 1, 0));
    EXPECT_EQ(r.corner(1, 0), glm::dvec3(0, 0, 0));
    EXPECT_EQ(r.corner(1, 1), glm::dvec3(1, 0, 0));
    EXPECT_EQ(r.corner(1, 2), glm::dvec3(5, 5, 5));
}

TEST(ReadObj, TurnsTextureCoordinatesSoThatTheOriginIsTopLeft) {
    const Read r =
        readText("t.obj", std::string(kTriangle) + "vt 0 0\nvt 0.25 0.75\nvt 1 1\nf 1/1 2/2 3/3\n");
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().uvs.size(), 3u);
    EXPECT_EQ(r.mesh().uvs[0], glm::vec2(0.0f, 1.0f));
    EXPECT_EQ(r.mesh().uvs[1], glm::vec2(0.25f, 0.25f));
    EXPECT_EQ(r.mesh().uvs[2], glm::vec2(1.0f, 0.0f));
}

TEST(ReadObj, MakesOneVertexOfEachCombinationOfPositionTextureAndNormal) {
    const Read r = readText("t.obj", std::string(kTriangle) +
                                         "vt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\n"
                                         "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 2/2/1 3/1/2\nf 1//1 2//1 3//1\n");
    ASSERT_EQ(r.error, "");
    // 1/1/1 2/1/1 3/1/1, then 2/2/1 3/1/2, then three without texture.
    EXPECT_EQ(r.mesh().positions.size(), 8u);
    EXPECT_EQ(r.mesh().triangles[1].x, r.mesh().triangles[0].x);
    EXPECT_EQ(r.mesh().normals[r.mesh().triangles[1].z], glm::vec3(0, 1, 0));
}

TEST(ReadObj, ReadsLinesThatEndInCrLfOrCrOrWithABackslash) {
    const std::string lf = std::string(kTriangle) + "f 1 2 3\n";
    std::string crLf, cr;
    for (const char c : lf) {
        crLf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    for (const std::string& text : {crLf, cr, std::string(kTriangle) + "f 1 \\\n 2 \\\r\n3\n"}) {
        const Read r = readText("t.obj", text);
        ASSERT_EQ(r.error, "") << text;
        EXPECT_EQ(r.corner(0, 1), glm::dvec3(1, 0, 0));
        EXPECT_EQ(r.corner(0, 2), glm::dvec3(0, 1, 0));
    }
}

TEST(ReadObj, KeepsGeoreferencedCoordinatesToTheLastDigit) {
    const Read r = readText("t.obj",
                            "v 6512345.6789 412345.0001 101.12345\nv 6512345.6790 412345.0001 101\n"
                            "v 6512345.6789 412345.0002 101\nf 1 2 3\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().positions[0], glm::dvec3(6512345.6789, 412345.0001, 101.12345));
    EXPECT_EQ(r.mesh().positions[1].x, 6512345.6790);
}

TEST(ReadObj, KeepsTheAreaOfConcavePolygonsWhicheverWayTheyTurn) {
    // An L of three unit squares, in both directions, starting at each corner.
    const int l[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int start = 0; start < 6; ++start) {
        for (const int step : {1, 5}) {
            std::ostringstream text;
            for (const auto& p : l) text << "v " << p[0] + 1000 << " 7 " << p[1] + 1000 << '\n';
            text << 'f';
            for (int i = 0; i < 6; ++i) text << ' ' << (start + i * step) % 6 + 1;
            const Read r = readText("l.obj", text.str() + "\n");
            ASSERT_EQ(r.error, "");
            EXPECT_EQ(r.mesh().triangles.size(), 4u);
            EXPECT_DOUBLE_EQ(area(r.mesh()), 3.0) << start << ' ' << step;
        }
    }
}

TEST(ReadObj, ReadsVertexColoursFromZeroToOneOrTo255) {
    const Read unit = readText("c.obj", "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0\nf 1 2 3\n");
    ASSERT_EQ(unit.error, "");
    EXPECT_EQ(unit.mesh().colours[0], glm::u8vec4(255, 128, 0, 255));
    EXPECT_EQ(unit.mesh().colours[1], glm::u8vec4(0, 0, 0, 255));
    EXPECT_EQ(unit.mesh().colours[2], glm::u8vec4(255, 255, 255, 255)) << "a vertex without colour is white";
    const Read bytes = readText("c.obj", "v 0 0 0 200 100 1\nv 1 0 0 0 0 0\nv 0 1 0 0 0 255\nf 1 2 3\n");
    EXPECT_EQ(bytes.mesh().colours[0], glm::u8vec4(200, 100, 1, 255));
}

TEST(ReadObj, CountsLinesPointsAndFacesOfTwoCornersAsIgnored) {
    const Read r = readText("t.obj", std::string(kTriangle) + "l 1 2 3\np 1\nf 1 2\nf 1 2 3\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.report.ignoredElements, 3u);
    EXPECT_EQ(r.mesh().triangles.size(), 1u);
}

TEST(ReadObj, SaysInWhichLineSomethingIsWrong) {
    const struct {
        const char* text;
        const char* place;
        const char* reason;
    } cases[] = {
        {"v 0 0 0\nv 1 x 0\n", "line 2", "'x' is not a number"},
        {"v 0 0 0\nv 1 1,5 0\n", "line 2", "'1,5' is not a number"},
        {"v 0 0\n", "line 1", "has 2 numbers instead of 3"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4", "vertex 4"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n", "line 4", "texture coordinate 1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//2 2//1 3//1\n", "line 4", "normal 2"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4", "refers to nothing"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n", "line 4", "refers to nothing"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3x\n", "line 4", "is not a corner"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/1/1/1\n", "line 4", "is not a corner"},
        {"v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "line 4",
         "vertex 3, which has a coordinate that is not a finite"},
        {"v 0 0 0\nv 1 0 0\nv 0 1e999 0\nf 1 2 3\n", "line 4",
         "vertex 3, which has a coordinate that is not a finite"},
        {"v 0 0 0\nv 1 0 0\nv 0 1e16 0\nf 1 2 3\n", "line 4", "above 1e15"},
        {"v 0 0 0\n", "", "contains no triangles"},
    };
    for (const auto& c : cases) {
        const Read r = readText("bad.obj", c.text);
        EXPECT_TRUE(contains(r.error, "bad.obj")) << r.error;
        EXPECT_TRUE(contains(r.error, c.place)) << c.text << r.error;
        EXPECT_TRUE(contains(r.error, c.reason)) << c.text << r.error;
    }
}

TEST(ReadObj, WarnsOfLinesThatAreNotObj) {
    const Read r = readText("t.obj", std::string(kTriangle) + "hello\nf 1 2 3\nw 1\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(warningsWith(r.report, "2 lines are not OBJ"), 1);
    EXPECT_EQ(warningsWith(r.report, "line 4, 'hello'"), 1);
}

// --- Materials ---

TEST(ReadMtl, GivesColourOpacityAndTextureToNamesWithBlanks) {
    const TempFolder folder;
    folder.write("my colours.mtl",
                 "newmtl red paint\nKd 1 0.5 0.25\nd 0.75\nmap_Kd -s 2 4 -o 0.5 0.25 -clamp on  a wall.png\n"
                 "newmtl plain\nmap_Kd\ta wall.png\n");
    folder.write("a wall.png", "not decoded here");
    const Read r = read(folder.write("m.obj", std::string("mtllib my colours.mtl\n") + kTriangle +
                                                  "vt 0 0\nvt 1 0\nvt 0 1\nusemtl red paint\nf 1/1 2/2 3/3\n"
                                                  "usemtl plain\nf 1/1 2/2 3/3\n"));
    ASSERT_EQ(r.error, "");
    EXPECT_TRUE(r.report.warnings.empty()) << r.report.warnings.front();
    ASSERT_EQ(r.block.materials.size(), 2u);
    EXPECT_EQ(r.block.materials[0].name, "red paint");
    EXPECT_EQ(r.block.materials[0].baseColour, glm::vec4(1.0f, 0.5f, 0.25f, 0.75f));
    EXPECT_EQ(r.block.materials[1].baseColour, glm::vec4(1.0f)) << "no Kd of its own: white, not the other's";
    EXPECT_EQ(r.block.materials[0].texture, 0);
    EXPECT_EQ(r.block.materials[1].texture, 0);
    ASSERT_EQ(r.block.textures.size(), 1u);
    EXPECT_EQ(r.block.textures[0].file.filename(), "a wall.png");
    EXPECT_EQ(r.mesh().materials, (std::vector<std::uint32_t>{0, 1}));
    // uv (1,0) of the file is laid on as (1*2+0.5, 0*4+0.25) from the bottom, 0.75 from the top.
    EXPECT_EQ(r.mesh().uvs[r.mesh().triangles[0].y], glm::vec2(2.5f, 0.75f));
    EXPECT_EQ(r.mesh().uvs[r.mesh().triangles[1].y], glm::vec2(1.0f, 1.0f));
}

TEST(ReadMtl, NamesAMissingTextureOnceWithTheTrianglesThatLackIt) {
    const TempFolder folder;
    folder.write(
        "m.mtl",
        "newmtl a\nKd 0 1 0\nmap_Kd wall.jpg\nnewmtl b\nmap_Kd wall.jpg\nnewmtl c\nmap_Kd other.jpg\n");
    const Read r = read(folder.write("m.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                                  "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nf 1/1 3/1 2/1\nusemtl b\n"
                                                  "f 1/1 2/1 3/1\nusemtl c\nf 1/1 2/1 3/1\n"));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.report.warnings.size(), 2u);
    EXPECT_EQ(
        warningsWith(r.report, "texture 'wall.jpg' is missing: 3 triangles are drawn with the base colour"),
        1);
    EXPECT_EQ(
        warningsWith(r.report, "texture 'other.jpg' is missing: 1 triangle is drawn with the base colour"),
        1);
    EXPECT_EQ(r.block.materials[0].texture, -1);
    EXPECT_EQ(r.block.materials[0].baseColour, glm::vec4(0, 1, 0, 1));
}

TEST(ReadMtl, NamesAMissingMaterialFileOnceAndOtherwiseEachMaterialThatIsNotDefined) {
    const TempFolder folder;
    const std::string faces =
        std::string(kTriangle) + "usemtl x\nf 1 2 3\nusemtl y\nf 3 2 1\nusemtl x\nf 1 2 3\n";
    const Read missing = read(folder.write("a.obj", "mtllib gone.mtl\n" + faces));
    ASSERT_EQ(missing.error, "");
    ASSERT_EQ(missing.report.warnings.size(), 1u);
    EXPECT_EQ(warningsWith(missing.report, "'gone.mtl' is missing"), 1);
    EXPECT_EQ(missing.block.materials[0].baseColour, glm::vec4(0.8f, 0.8f, 0.8f, 1.0f));

    folder.write("there.mtl", "newmtl y\n");
    const Read undefined = read(folder.write("b.obj", "mtllib there.mtl\n" + faces));
    ASSERT_EQ(undefined.report.warnings.size(), 1u);
    EXPECT_EQ(warningsWith(undefined.report, "material 'x' is not defined: 2 triangles are drawn grey"), 1);
}

TEST(ReadMtl, NeverFollowsATexturePathOutOfTheModelsFolder) {
    const TempFolder folder;
    folder.write("secret.png", "outside");
    folder.write("model/inside.png", "inside");
    std::filesystem::create_symlink(folder.path() / "secret.png", folder.path() / "model/link.png");
    std::filesystem::create_symlink(folder.path(), folder.path() / "model/up");
    for (const char* name : {"../../etc/passwd", "../secret.png", "/etc/passwd", "link.png", "up/secret.png",
                             "sub/../../secret.png", "C:\\Windows\\win.ini", "..\\secret.png"}) {
        folder.write("model/m.mtl", std::string("newmtl a\nmap_Kd ") + name + "\n");
        const Read r = read(folder.write(
            "model/m.obj", std::string("mtllib m.mtl\n") + kTriangle + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"));
        ASSERT_EQ(r.error, "");
        EXPECT_TRUE(r.block.textures.empty()) << name;
        EXPECT_EQ(r.block.materials[0].texture, -1) << name;
        EXPECT_EQ(warningsWith(r.report, "outside the model's folder: 1 triangle is"), 1) << name;
    }
    folder.write("evil.mtl", "newmtl a\nKd 0 0 1\n");
    const Read mtl = read(
        folder.write("model/m.obj", std::string("mtllib ../evil.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n"));
    EXPECT_EQ(warningsWith(mtl.report, "'../evil.mtl' lies outside the model's folder"), 1);
    EXPECT_NE(mtl.block.materials[0].baseColour, glm::vec4(0, 0, 1, 1));
}

TEST(ReadMtl, FindsTexturesByBackslashOtherCaseOrBareName) {
    const TempFolder folder;
    folder.write("Textures/Wall.PNG", "x");
    folder.write("roof.jpg", "x");
    folder.write("m.mtl", "newmtl a\nmap_Kd textures\\wall.png\nnewmtl b\nmap_Kd C:\\Users\\me\\roof.jpg\n");
    const Read r =
        read(folder.write("m.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                       "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n"));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.block.textures.size(), 2u);
    EXPECT_EQ(r.block.textures[0].file.filename(), "Wall.PNG");
    EXPECT_EQ(r.block.textures[1].file.filename(), "roof.jpg");
    EXPECT_EQ(r.report.warnings.size(), 1u);
    EXPECT_EQ(warningsWith(r.report, "was found as 'roof.jpg' beside the model"), 1);
}

TEST(ReadMtl, MasksByTheAlphaOfTheTextureOnlyWhereTheFileSaysSo) {
    const TempFolder folder;
    folder.write("leaf.png", "x");
    folder.write("m.mtl",
                 "newmtl leaf\nmap_Kd leaf.png\nmap_d leaf.png\nnewmtl solid\nmap_Kd leaf.png\n"
                 "newmtl other\nmap_Kd leaf.png\nmap_d holes.png\n");
    const Read r =
        read(folder.write("m.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                       "vt 0 0\nusemtl leaf\nf 1/1 2/1 3/1\nusemtl solid\nf 1/1 2/1 3/1\n"
                                       "usemtl other\nf 1/1 2/1 3/1\n"));
    ASSERT_EQ(r.error, "");
    EXPECT_TRUE(r.block.materials[0].alphaMask);
    EXPECT_FALSE(r.block.materials[1].alphaMask);
    EXPECT_FALSE(r.block.materials[2].alphaMask);
    EXPECT_EQ(warningsWith(r.report, "opacity texture 'holes.png' is not used"), 1);
}

TEST(ReadMtl, LeavesTrianglesWithoutTextureCoordinatesUntextured) {
    const TempFolder folder;
    folder.write("wall.png", "x");
    folder.write("m.mtl", "newmtl a\nKd 0 0 1\nmap_Kd wall.png\n");
    const Read r = read(folder.write("m.obj", std::string("mtllib m.mtl\n") + kTriangle +
                                                  "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nf 1 2 3\nf 3 2 1\n"));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.block.materials.size(), 2u);
    EXPECT_EQ(r.mesh().materials, (std::vector<std::uint32_t>{0, 1, 1}));
    EXPECT_EQ(r.block.materials[1].texture, -1);
    EXPECT_EQ(r.block.materials[1].baseColour, glm::vec4(0, 0, 1, 1));
}

TEST(UnnamedTexture, IsTheOnlyImageThatGoesByTheNameOfTheFile) {
    const TempFolder folder;
    const std::string text = std::string(kTriangle) + "vt 0 0\nf 1/1 2/1 3/1\n";
    const auto file = folder.write("spot_triangulated.obj", text);
    folder.write("other.png", "x");
    EXPECT_TRUE(read(file).block.textures.empty());
    folder.write("spot_texture.png", "x");
    const Read r = read(file);
    ASSERT_EQ(r.block.textures.size(), 1u);
    EXPECT_EQ(r.block.textures[0].file.filename(), "spot_texture.png");
    EXPECT_EQ(r.block.materials[r.mesh().materials[0]].texture, 0);
    EXPECT_EQ(warningsWith(r.report, "spot_texture.png beside it is taken"), 1);
    folder.write("spot.jpg", "x");
    EXPECT_TRUE(read(file).block.textures.empty()) << "two images: neither is taken";
}

TEST(UnnamedTexture, IsTheOneOfTheOptionsWhereTheFileHasTextureCoordinates) {
    const TempFolder folder;
    const auto file = folder.write("a.obj", std::string(kTriangle) + "vt 0 0\nf 1/1 2/1 3/1\n");
    const auto bare = folder.write("b.obj", std::string(kTriangle) + "f 1 2 3\n");
    ImportOptions options;
    options.texture = folder.write("anywhere/t.png", "x");
    EXPECT_EQ(read(file, options).block.textures.at(0).file.filename(), "t.png");
    const Read without = read(bare, options);
    EXPECT_TRUE(without.block.textures.empty());
    EXPECT_EQ(warningsWith(without.report, "b.obj has no texture coordinates"), 1);
    options.texture = folder.path() / "gone.png";
    EXPECT_TRUE(contains(read(file, options).error, "gone.png"));
}

// Against an independent reader: whatever valid triangles a file has, both find the same corners.
RC_GTEST_PROP(ReadObj, FindsWhatTinyobjloaderFinds, ()) {
    const auto count = *rc::gen::inRange(3, 12);
    std::ostringstream text;
    text.precision(17);
    const auto number = [] { return *rc::gen::inRange(-1000000, 1000000) / 1024.0; };
    for (int i = 0; i < count; ++i) {
        text << "v " << number() << ' ' << number() << ' ' << number() << "\nvt " << number() << ' '
             << number() << "\nvn " << number() << ' ' << number() << ' ' << number() << '\n';
    }
    const auto faces = *rc::gen::inRange(1, 20);
    for (int f = 0; f < faces; ++f) {
        if (*rc::gen::inRange(0, 4) == 0) text << "g group" << *rc::gen::inRange(0, 3) << '\n';
        text << 'f';
        for (int c = 0; c < 3; ++c) {
            const auto index = [&] {
                return *rc::gen::arbitrary<bool>() ? *rc::gen::inRange(1, count + 1)
                                                   : -*rc::gen::inRange(1, count + 1);
            };
            text << ' ' << index() << '/' << index() << '/' << index();
        }
        text << '\n';
    }
    const Read ours = readText("t.obj", text.str());
    RC_ASSERT(ours.error == "");
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    std::istringstream stream(text.str());
    RC_ASSERT(tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream));
    std::size_t corner = 0;
    for (const tinyobj::shape_t& shape : shapes) {
        for (const tinyobj::index_t& index : shape.mesh.indices) {
            const std::uint32_t vertex = ours.mesh().triangles.at(corner / 3)[static_cast<int>(corner % 3)];
            const auto v = [&](int i) {
                return attributes.vertices[static_cast<std::size_t>(3 * index.vertex_index + i)];
            };
            const auto n = [&](int i) {
                return attributes.normals[static_cast<std::size_t>(3 * index.normal_index + i)];
            };
            const auto t = [&](int i) {
                return attributes.texcoords[static_cast<std::size_t>(2 * index.texcoord_index + i)];
            };
            RC_ASSERT(glm::distance(ours.mesh().positions[vertex], glm::dvec3(v(0), v(1), v(2))) < 1e-9);
            RC_ASSERT(glm::distance(glm::dvec3(ours.mesh().normals[vertex]), glm::dvec3(n(0), n(1), n(2))) <
                      1e-3);
            RC_ASSERT(glm::distance(glm::dvec2(ours.mesh().uvs[vertex]), glm::dvec2(t(0), 1.0 - t(1))) <
                      1e-3);
            ++corner;
        }
    }
    RC_ASSERT(corner == 3 * ours.mesh().triangles.size());
}

}  // namespace
}  // namespace fb::test
