#include <sstream>

#include "temp_folder.h"

namespace fb::test {
namespace {

std::string stlAscii() {
    std::ostringstream text;
    text << "solid a cube\n";
    for (const auto& t : kCubeTriangles) {
        text << " facet normal 0 0 0\n  outer loop\n";
        for (const unsigned v : t) {
            text << "   vertex " << kCubeCorners[v][0] << ' ' << kCubeCorners[v][1] << ' '
                 << kCubeCorners[v][2] << '\n';
        }
        text << "  endloop\n endfacet\n";
    }
    text << "endsolid a cube\n";
    return text.str();
}

std::string stlBinary(const std::string& header) {
    Bytes bytes;
    bytes.add(header + std::string(80 - header.size(), ' ')).add(std::uint32_t{12});
    for (const auto& t : kCubeTriangles) {
        for (int i = 0; i < 3; ++i) bytes.add(0.0f);
        for (const unsigned v : t) {
            for (const double n : kCubeCorners[v]) bytes.add(static_cast<float>(n));
        }
        bytes.add(std::uint16_t{0});
    }
    return bytes.text();
}

TEST(ReadStl, ReadsACubeAsTextWithCornersOfItsOwnForEachTriangle) {
    expectCube(readText("cube.stl", stlAscii()), 36);
}

TEST(ReadStl, ReadsACubeInBinaryEvenIfItBeginsWithSolid) {
    expectCube(readText("cube.stl", stlBinary("made by hand")), 36);
    expectCube(readText("cube.stl", stlBinary("solid lie")), 36);
}

TEST(ReadStl, KeepsGeoreferencedCoordinatesOfTextToTheLastDigit) {
    const Read r =
        readText("t.stl",
                 "solid\nfacet normal 0 0 1\nouter loop\nvertex 6512345.6789 412345.0001 1\n"
                 "vertex 6512346 412345 1\nvertex 6512345 412346 1\nendloop\nendfacet\nendsolid\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().positions[0], glm::dvec3(6512345.6789, 412345.0001, 1));
}

TEST(ReadStl, SaysWhereAFileIsWrong) {
    EXPECT_TRUE(
        contains(readText("t.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2\nendloop\n").error,
                 "line 5: 'endloop' stands where 'a number' should"));
    EXPECT_TRUE(contains(readText("t.stl", "solid x\nfacet normal 0 0 1\nouter rim\n").error,
                         "line 3: 'rim' stands where 'loop'"));
    EXPECT_TRUE(contains(readText("t.stl", "solid x\nfacet normal 0 0 1\n").error,
                         "the file ends where 'outer' should follow"));
    const std::string cut = stlBinary("x").substr(0, 84 + 11 * 50 + 49);
    EXPECT_TRUE(contains(readText("t.stl", cut).error,
                         "byte 80: the header promises 12 triangles, the rest of the file can hold 11"));
    EXPECT_TRUE(contains(readText("t.stl", "hello").error, "byte 5: the file ends inside the header"));
}

std::string cubeOff(const std::string& keyword, const std::string& faceColour = "") {
    std::ostringstream text;
    text << keyword << "# a cube\n\n8 6 12\n";
    for (const auto& c : kCubeCorners) text << c[0] << ' ' << c[1] << ' ' << c[2] << " # corner\n";
    for (const auto& s : kCubeSquares)
        text << "4 " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << faceColour << '\n';
    return text.str();
}

TEST(ReadOff, ReadsACubeWithCommentsAndWithOrWithoutTheKeyword) {
    expectCube(readText("cube.off", cubeOff("OFF\n")));
    expectCube(readText("cube.off", cubeOff("")));
    expectCube(readText("cube.off", cubeOff("OFF ")));
    expectCube(readText("cube.mesh", cubeOff("OFF\n")));
}

TEST(ReadOff, ReadsColoursNormalsAndTextureCoordinatesOfVertices) {
    const Read integers =
        readText("c.off", "COFF\n3 1 0\n0 0 0 255 128 0\n1 0 0 1 1 1 7\n0 1 0 0 0 0 255\n3 0 1 2\n");
    ASSERT_EQ(integers.error, "");
    EXPECT_EQ(integers.mesh().colours[0], glm::u8vec4(255, 128, 0, 255));
    EXPECT_EQ(integers.mesh().colours[1], glm::u8vec4(1, 1, 1, 7));
    const Read reals =
        readText("c.off", "COFF\n3 1 0\n0 0 0 1 0.5 0 1\n1 0 0 1 1 1 0.5\n0 1 0 0 0 0 1\n3 0 1 2\n");
    EXPECT_EQ(reals.mesh().colours[0], glm::u8vec4(255, 128, 0, 255));
    EXPECT_EQ(reals.mesh().colours[1], glm::u8vec4(255, 255, 255, 128));
    const Read all = readText("c.off",
                              "STCNOFF\n3 1 0\n0 0 0 0 0 1 10 20 30 0.25 0.75\n1 0 0 0 0 1 1 1 1 1 0\n"
                              "0 1 0 0 1 0 1 1 1 0 1\n3 0 1 2\n");
    // 0.25 is no colour: the colours are whole numbers to 255.
    ASSERT_EQ(all.error, "");
    EXPECT_EQ(all.mesh().colours[0], glm::u8vec4(10, 20, 30, 255));
    EXPECT_EQ(all.mesh().normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(all.mesh().uvs[0], glm::vec2(0.25f, 0.25f));
    EXPECT_EQ(
        readText("n.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n").mesh().normals[1],
        glm::vec3(0, 0, 1));
    EXPECT_EQ(readText("s.off", "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n").mesh().uvs[2],
              glm::vec2(0, 0));
}

TEST(ReadOff, GivesVerticesTheColoursOfTheirFaces) {
    const Read r = readText("f.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().positions.size(), 6u) << "0 and 2 are red in one face and white in the other";
    EXPECT_EQ(r.mesh().colours[r.mesh().triangles[0].x], glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(r.mesh().colours[r.mesh().triangles[1].x], glm::u8vec4(255, 255, 255, 255));
    expectCube(readText("cube.off", cubeOff("OFF\n", " 255 0 0")));
}

TEST(ReadOff, SaysWhereAFileIsWrong) {
    const struct {
        const char* text;
        const char* part;
    } cases[] = {
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: the face refers to vertex '3' of 3"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "line 6: the face has fewer corners"},
        {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4: a number of a vertex is missing"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "the file ends before face 0"},
        {"OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "more than the file can hold"},
        {"OFF\n3 -1 0\n", "line 2: '-1' is not a count"},
        {"4OFF\n3 1 0\n", "only three dimensions"},
        {"OFF BINARY\n", "binary OFF"},
        {"OFFICE\n", "'OFFICE' stands where 'OFF' should"},
    };
    for (const auto& c : cases)
        EXPECT_TRUE(contains(readText("bad.off", c.text).error, c.part)) << readText("bad.off", c.text).error;
}

TEST(RecogniseFormat, SaysWhatIsWrongWithFilesThatAreNoMesh) {
    EXPECT_TRUE(contains(readText("a.ply", "").error, "a.ply: is empty"));
    EXPECT_TRUE(contains(readText("a.ply", "some text that somebody renamed\n").error,
                         "byte 0: is not ply: that begins with the word 'ply'"));
    EXPECT_TRUE(contains(readText("a.glb", "some text").error, "begins with 'glTF'"));
    EXPECT_TRUE(contains(readText("a.fbx", "Kaydara FBX Binary").error,
                         "OBJ, PLY, STL, OFF, glTF and GLB can be read"));
    EXPECT_TRUE(contains(readText("a.obj", std::string("\0\1\2\3", 4)).error, "contains no triangles"));
    const TempFolder folder;
    EXPECT_TRUE(contains(read(folder.path()).error, "is not a file"));
    EXPECT_TRUE(contains(read(folder.path() / "gone.obj").error, "does not exist"));
    expectCube(readText("cube.obj", "\xef\xbb\xbf" + cubeOff("OFF\n")));
}

}  // namespace
}  // namespace fb::test
