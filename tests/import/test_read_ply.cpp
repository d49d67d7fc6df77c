#include <sstream>

#include "temp_folder.h"

namespace fb::test {
namespace {

std::string cubeAscii() {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& c : kCubeCorners) text << c[0] << ' ' << c[1] << ' ' << c[2] << '\n';
    for (const auto& s : kCubeSquares)
        text << "4 " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << '\n';
    return text.str();
}

// Properties in an unusual order and of unusual types: faces first, z before x, lists counted with 16 bits.
std::string cubeBinary(bool bigEndian) {
    Bytes body(bigEndian);
    body.add(std::string("ply\r\nformat binary_") + (bigEndian ? "big" : "little") +
             "_endian 1.0\r\nobj_info x\r\nelement face 6\r\nproperty uchar flags\r\n"
             "property list ushort uint vertex_index\r\nelement vertex 8\r\nproperty double z\r\n"
             "property short quality\r\nproperty double x\r\nproperty float y\r\nelement edge 2\r\n"
             "property int a\r\nproperty int b\r\nend_header\r\n");
    for (const auto& s : kCubeSquares) {
        body.add(std::uint8_t{7}).add(std::uint16_t{4}).add(s[0]).add(s[1]).add(s[2]).add(s[3]);
    }
    for (const auto& c : kCubeCorners) {
        body.add(c[2]).add(std::int16_t{-3}).add(c[0]).add(static_cast<float>(c[1]));
    }
    for (int i = 0; i < 4; ++i) body.add(std::int32_t{i});
    return body.text();
}

const std::string kThree = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kOneFace = "element face 1\nproperty list uchar int vertex_indices\n";

Read readAscii(const std::string& header, const std::string& body) {
    return readText("t.ply", "ply\nformat ascii 1.0\n" + header + "end_header\n" + body);
}

TEST(ReadPly, ReadsACubeInAscii) {
    expectCube(readText("cube.ply", cubeAscii()));
}

TEST(ReadPly, ReadsACubeInBothByteOrdersWithAnyOrderOfPropertiesAndTypes) {
    for (const bool bigEndian : {false, true}) {
        const Read r = readText("cube.ply", cubeBinary(bigEndian));
        expectCube(r);
        EXPECT_EQ(r.report.ignoredElements, 2u) << "the edges";
        EXPECT_TRUE(r.report.warnings.empty());
    }
}

TEST(ReadPly, IsRecognisedByContentWhateverItsName) {
    expectCube(readText("cube.obj", cubeAscii()));
}

TEST(ReadPly, KeepsGeoreferencedCoordinatesToTheLastDigit) {
    const Read text =
        readAscii("element vertex 3\nproperty double x\nproperty double y\nproperty double z\n" + kOneFace,
                  "6512345.6789 412345.0001 1\n6512346 412345 1\n6512345 412346 1\n3 0 1 2\n");
    ASSERT_EQ(text.error, "");
    EXPECT_EQ(text.mesh().positions[0], glm::dvec3(6512345.6789, 412345.0001, 1));
    Bytes binary;
    binary.add(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\n" +
        kOneFace + "end_header\n");
    for (const double n :
         {6512345.6789, 412345.0001, 1.0, 6512346.0, 412345.0, 1.0, 6512345.0, 412346.0, 1.0})
        binary.add(n);
    binary.add(std::uint8_t{3}).add(0).add(1).add(2);
    const Read bytes = readText("t.ply", binary.text());
    ASSERT_EQ(bytes.error, "");
    EXPECT_EQ(bytes.mesh().positions[0], glm::dvec3(6512345.6789, 412345.0001, 1));
}

TEST(ReadPly, ReadsNormalsColoursAndTextureCoordinatesOfVertices) {
    for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}) {
        const Read r = readAscii(
            "element vertex 3\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property float x\nproperty float y\nproperty float z\nproperty float nx\n"
            "property float ny\nproperty float nz\nproperty float " +
                std::string(u) + "\nproperty float " + v + "\n" + kOneFace,
            "1 2 3 0 0 0 0 0 1 0.25 0.75\n4 5 6 1 0 0 0 1 0 0 0\n7 8 9 0 1 0 1 0 0 1 1\n3 0 1 2\n");
        ASSERT_EQ(r.error, "");
        EXPECT_EQ(r.mesh().colours[0], glm::u8vec4(1, 2, 3, 255));
        EXPECT_EQ(r.mesh().normals[1], glm::vec3(0, 1, 0));
        EXPECT_EQ(r.mesh().uvs[0], glm::vec2(0.25f, 0.25f)) << "v is turned: the origin is top left";
        EXPECT_EQ(r.mesh().uvs[1], glm::vec2(0.0f, 1.0f));
    }
}

TEST(ReadPly, ScalesColoursByTheirType) {
    const Read r = readAscii(
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float diffuse_red\nproperty ushort green\nproperty int blue\nproperty uchar alpha\n" +
            kOneFace,
        "0 0 0 0.5 65535 128 10\n1 0 0 2 257 300 20\n0 1 0 -1 0 -5 30\n3 0 1 2\n");
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().colours[0], glm::u8vec4(128, 255, 128, 10));
    EXPECT_EQ(r.mesh().colours[1], glm::u8vec4(255, 1, 255, 20));
    EXPECT_EQ(r.mesh().colours[2], glm::u8vec4(0, 0, 0, 30));
}

TEST(ReadPly, GivesCornersOfFacesTextureCoordinatesAndFacesColours) {
    const Read r = readAscii(
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
        "3 0 1 2  6 0 0 1 0 1 1  9 8 7\n3 0 2 3  6 0 0 0.5 0.5 0 1  1 2 3\n");
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().triangles.size(), 2u);
    EXPECT_EQ(r.mesh().positions.size(), 6u) << "no corner is like another: the faces have different colours";
    const glm::uvec3 second = r.mesh().triangles[1];
    EXPECT_EQ(r.mesh().positions[second.y], glm::dvec3(1, 1, 0));
    EXPECT_EQ(r.mesh().uvs[second.y], glm::vec2(0.5f, 0.5f));
    EXPECT_EQ(r.mesh().uvs[second.z], glm::vec2(0.0f, 0.0f));
    EXPECT_EQ(r.mesh().colours[second.x], glm::u8vec4(1, 2, 3, 255));
    EXPECT_EQ(r.mesh().colours[r.mesh().triangles[0].x], glm::u8vec4(9, 8, 7, 255));
}

TEST(ReadPly, ReadsTriangleStripsWithRestartsAndTurnsEverySecondTriangleOver) {
    //  1---3---5      strip 0 1 2 3 4 5: four triangles that all face +z;
    //  |\  |\  |      then after -1 a strip of three of its own, then one of two, which is nothing.
    //  0---2---4
    const std::string header =
        "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\n";
    const Read r =
        readAscii(header, "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n13 1 0 3 2 5 4 -1 0 2 1 -1 3 4\n");
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().triangles.size(), 5u);
    EXPECT_EQ(r.report.sourceTriangles, 5u);
    for (std::size_t t = 0; t < 5; ++t) {
        const glm::dvec3 a = r.corner(t, 0);
        EXPECT_EQ(glm::cross(r.corner(t, 1) - a, r.corner(t, 2) - a), glm::dvec3(0, 0, 1)) << t;
    }
    EXPECT_TRUE(contains(readAscii(header, "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n3 0 1 6\n").error,
                         "vertex 6 of 6"));
    EXPECT_TRUE(contains(readAscii(header, "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n3 0 -2 1\n").error,
                         "vertex -2"));
}

TEST(ReadPly, TakesTheTexturesThatItsCommentsName) {
    const TempFolder folder;
    folder.write("a.png", "x");
    const std::string header =
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile gone.jpg\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float s\nproperty float t\nelement face 3\n"
        "property list uchar int vertex_indices\nproperty int texnumber\nend_header\n";
    const Read r = read(folder.write(
        "t.ply", header + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2 0\n3 0 2 1 1\n3 1 2 0 -1\n"));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.block.textures.size(), 1u);
    EXPECT_EQ(r.mesh().materials, (std::vector<std::uint32_t>{0, 1, kNoMaterial}));
    EXPECT_EQ(r.block.materials[0].texture, 0);
    EXPECT_EQ(r.block.materials[1].texture, -1);
    EXPECT_EQ(warningsWith(r.report, "texture 'gone.jpg' is missing: 1 triangle is drawn"), 1);
}

TEST(ReadPly, SaysWhereAFileIsWrong) {
    const struct {
        std::string text;
        const char* part;
    } cases[] = {
        {"ply\nformat ascii 1.0\n" + kThree, "line 6: the file ends inside the header"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n",
         "line 4: the type 'quad' is not known"},
        {"ply\nformat ascii 1.0\nelement vertex -3\n", "line 3: an element has a name and a count"},
        {"ply\nformat ascii 1.0\nproperty float x\n", "line 3: a property stands before"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list float int i\n",
         "line 4: 'float' is not a type that can count"},
        {"ply\nformat binary 1.0\n", "line 2: the format 'binary'"},
        {"ply\nelement vertex 3\nend_header\n", "names no format"},
        {"ply\nformat ascii 1.0\n" + kOneFace + "end_header\n3 0 1 2\n", "has no element 'vertex'"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         "vertex 3 of 3"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
         "vertex 1.5"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
         "vertex -1"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 zwei 0\n0 1 0\n3 0 1 2\n",
         "line 11: 'y' of 'vertex' is not a number"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n",
         "vertex 1: has a coordinate"},
        {"ply\nformat ascii 1.0\n" + kThree + kOneFace + "end_header\n0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n",
         "a list longer than the file"},
        {"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty "
         "float z\nend_header\n0 0 0\n",
         "promises 4000000000 rows of 'vertex', the rest of the file can hold 1"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nproperty uchar x\nend_header\nab",
         "can hold 2"},
    };
    for (const auto& c : cases)
        EXPECT_TRUE(contains(readText("bad.ply", c.text).error, c.part)) << readText("bad.ply", c.text).error;
}

TEST(ReadPly, LeavesOutVerticesThatAreNotNumbersWhenNoFaceUsesThem) {
    const Read r =
        readAscii("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + kOneFace,
                  "nan nan nan\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n");
    EXPECT_EQ(r.error, "");
}

TEST(ReadPly, WarnsOfBytesBehindTheEnd) {
    EXPECT_EQ(warningsWith(readText("cube.ply", cubeAscii() + "\n 12\n").report, "behind the last element"),
              1);
    EXPECT_EQ(warningsWith(readText("cube.ply", cubeAscii() + "\n \n").report, "behind"), 0);
    EXPECT_EQ(warningsWith(readText("cube.ply", cubeBinary(false) + "x").report, "behind the last element"),
              1);
}

}  // namespace
}  // namespace fb::test
