#include "gltf_builder.h"

namespace fb::test {
namespace {

using B = GltfBuilder;

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::vector<float> kFourOfAStrip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

TEST(ReadGltf, ReadsACubeWithIndicesOfEachSizeFromGlbDataUriAndFile) {
    const std::string cube = R"({"attributes":{"POSITION":0},"indices":1})";
    B bytes, shorts, ints;
    bytes.add(cubePositions(), B::kFloat, "VEC3");
    bytes.add(cubeIndices<std::uint8_t>(), B::kUByte, "SCALAR");
    expectCube(readText("cube.glb", bytes.glb(oneMesh(cube))));
    shorts.add(cubePositions(), B::kFloat, "VEC3");
    shorts.add(cubeIndices<std::uint16_t>(), B::kUShort, "SCALAR");
    expectCube(readText("cube.gltf", shorts.embedded(oneMesh(cube))));
    ints.add(cubePositions(), B::kFloat, "VEC3");
    ints.add(cubeIndices<std::uint32_t>(), B::kUInt, "SCALAR");
    const TempFolder folder;
    folder.write("my data.bin", ints.buffer() + "padding that some exporters write");
    expectCube(read(folder.write("cube.gltf", ints.json(oneMesh(cube), "my%20data.bin"))));
}

TEST(ReadGltf, ReadsStripsFansAndTrianglesWithoutIndices) {
    B builder;
    builder.add(kFourOfAStrip, B::kFloat, "VEC3");
    builder.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, B::kFloat, "VEC3");
    builder.add(kTriangle, B::kFloat, "VEC3");
    const Read r = readText("t.glb", builder.glb(oneMesh(R"({"attributes":{"POSITION":0},"mode":5},
        {"attributes":{"POSITION":1},"mode":6},{"attributes":{"POSITION":2}},{"attributes":{"POSITION":0},"mode":0},
        {"attributes":{"POSITION":0},"mode":1})")));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().triangles.size(), 5u);
    for (std::size_t t = 0; t < 5; ++t) {
        const glm::dvec3 a = r.corner(t, 0);
        EXPECT_EQ(glm::cross(r.corner(t, 1) - a, r.corner(t, 2) - a), glm::dvec3(0, 0, 1)) << t;
    }
    EXPECT_EQ(r.report.ignoredElements, 8u) << "4 points and the 4 corners of lines";
    EXPECT_EQ(r.report.sourceTriangles, 5u);
}

TEST(ReadGltf, MultipliesTransformsInDoublePrecisionDownTheTree) {
    B builder;
    builder.add(kTriangle, B::kFloat, "VEC3");
    // Node 0 moves far away, its child turns 90 degrees about z and scales by 2: (1,0,0) -> (0,2,0).
    const std::string rest = R"("nodes":[{"children":[1],"translation":[6512345.25,1,2]},
        {"mesh":0,"name":"child","rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,2,2]},
        {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 10,20,30,1]}],
        "scenes":[{"nodes":[0,2]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const Read r = readText("t.glb", builder.glb(rest));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().triangles.size(), 2u);
    EXPECT_LT(glm::distance(r.corner(0, 1), glm::dvec3(6512345.25, 3, 2)), 1e-9);
    EXPECT_LT(glm::distance(r.corner(0, 2), glm::dvec3(6512343.25, 1, 2)), 1e-9);
    EXPECT_EQ(r.corner(1, 1), glm::dvec3(11, 20, 30));
}

TEST(ReadGltf, TurnsTrianglesAndNormalsOfMirroredNodesTheRightWay) {
    B builder;
    builder.add(cubePositions(), B::kFloat, "VEC3");
    builder.add(cubeIndices<std::uint16_t>(), B::kUShort, "SCALAR");
    std::vector<float> normals;
    for (int i = 0; i < 8; ++i) normals.insert(normals.end(), {1, 0, 0});
    builder.add(normals, B::kFloat, "VEC3");
    const Read r =
        readText("t.glb", builder.glb(oneMesh(R"({"attributes":{"POSITION":0,"NORMAL":2},"indices":1})",
                                              R"(,"scale":[-2,1,1])")));
    ASSERT_EQ(r.error, "");
    EXPECT_DOUBLE_EQ(sixVolumes(r.mesh()), 96.0) << "twice the volume, still facing outward";
    EXPECT_EQ(glm::normalize(r.mesh().normals[0]), glm::vec3(-1, 0, 0));
}

TEST(ReadGltf, FillsUpAttributesThatOnlySomePrimitivesHave) {
    B builder;
    builder.add(kTriangle, B::kFloat, "VEC3");
    builder.add(std::vector<float>{0.25f, 0.75f, 1, 0, 0, 1}, B::kFloat, "VEC2");
    builder.add(std::vector<std::uint8_t>{255, 0, 188, 128, 0, 0, 0, 255, 0, 0, 0, 255}, B::kUByte, "VEC4",
                ",\"normalized\":true");
    const Read r = readText("t.glb", builder.glb(oneMesh(R"({"attributes":{"POSITION":0}},
        {"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2}},{"attributes":{"POSITION":0}})")));
    ASSERT_EQ(r.error, "");
    ASSERT_EQ(r.mesh().positions.size(), 9u);
    ASSERT_EQ(r.mesh().uvs.size(), 9u);
    ASSERT_EQ(r.mesh().colours.size(), 9u);
    EXPECT_EQ(r.mesh().uvs[3], glm::vec2(0.25f, 0.75f)) << "glTF's origin is top left already";
    EXPECT_EQ(r.mesh().colours[0], glm::u8vec4(255));
    // 188/255 of linear light is 0.8756 in sRGB: 1.055 * 0.73725^(1/2.4) - 0.055 = 0.8743, times 255 is
    // 222.9.
    EXPECT_EQ(r.mesh().colours[3], glm::u8vec4(255, 0, 223, 128));
    EXPECT_EQ(r.mesh().colours[8], glm::u8vec4(255));
}

TEST(ReadGltf, ReadsNormalisedAndSparseNumbers) {
    B builder;
    builder.add(std::vector<std::int16_t>{32767, 0, 0, -32768, 0, 0, 0, 16384, 0, 0, 0, 0}, B::kShort, "VEC3",
                ",\"normalized\":true");
    const int indices = builder.addView(B::bytesOf(std::vector<std::uint16_t>{2}));
    const int values = builder.addView(B::bytesOf(std::vector<float>{5, 6, 7}));
    builder.add(kTriangle, B::kFloat, "VEC3",
                ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(indices) +
                    ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(values) + "}}");
    const Read r = readText(
        "t.glb",
        builder.glb(oneMesh(R"({"attributes":{"POSITION":0},"mode":5},{"attributes":{"POSITION":1}})")));
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.corner(0, 0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(r.corner(0, 1), glm::dvec3(-1, 0, 0)) << "-32768 is -1 as well";
    EXPECT_DOUBLE_EQ(r.corner(0, 2).y, 16384.0 / 32767.0);
    EXPECT_EQ(r.corner(2, 2), glm::dvec3(5, 6, 7));
}

TEST(ReadGltf, AddsOnlyTheVerticesThatAPrimitiveUses) {
    B builder;
    builder.add(cubePositions(), B::kFloat, "VEC3");
    builder.add(std::vector<std::uint8_t>{0, 1, 2}, B::kUByte, "SCALAR");
    builder.add(std::vector<std::uint8_t>{4, 5, 6, 6, 7, 4}, B::kUByte, "SCALAR");
    const Read r = readText("t.glb", builder.glb(oneMesh(R"({"attributes":{"POSITION":0},"indices":1},
        {"attributes":{"POSITION":0},"indices":2})")));
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().positions.size(), 7u);
    EXPECT_EQ(r.corner(1, 1), glm::dvec3(1, -1, -1));
}

// --- Materials ---

std::string withMaterial(const std::string& material, const std::string& more = "") {
    return oneMesh(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0})") + R"(,"materials":[)" +
           material + "]" + more;
}

B texturedTriangle() {
    B builder;
    builder.add(kTriangle, B::kFloat, "VEC3");
    builder.add(std::vector<float>{0, 0, 1, 0, 0, 1}, B::kFloat, "VEC2");
    return builder;
}

TEST(GltfMaterials, KeepImagesEncodedFromViewsDataUrisAndFiles) {
    const std::string texture = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    const std::string png = "\x89PNG not decoded here";
    B view = texturedTriangle();
    const int number = view.addView(png);
    const Read fromView = readText(
        "t.glb",
        view.glb(withMaterial(
            texture,
            R"(,"textures":[{"source":0}],"images":[{"name":"bark","mimeType":"image/png","bufferView":)" +
                std::to_string(number) + "}]")));
    ASSERT_EQ(fromView.error, "");
    ASSERT_EQ(fromView.block.textures.size(), 1u);
    EXPECT_EQ(fromView.block.textures[0].name, "bark");
    EXPECT_EQ(
        std::string(fromView.block.textures[0].encoded.begin(), fromView.block.textures[0].encoded.end()),
        png);

    const B plain = texturedTriangle();
    const Read fromUri = readText(
        "t.glb", plain.glb(withMaterial(
                     texture, R"(,"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" +
                                  base64(png) + "\"}]")));
    ASSERT_EQ(fromUri.error, "");
    ASSERT_EQ(fromUri.block.textures.size(), 1u);
    EXPECT_EQ(std::string(fromUri.block.textures[0].encoded.begin(), fromUri.block.textures[0].encoded.end()),
              png);

    const TempFolder folder;
    folder.write("tex/bark 1.png", png);
    const std::string images = R"(,"textures":[{"source":0}],"images":[{"uri":"tex/bark%201.png"}])";
    const Read fromFile = read(folder.write("t.glb", plain.glb(withMaterial(texture, images))));
    ASSERT_EQ(fromFile.error, "");
    ASSERT_EQ(fromFile.block.textures.size(), 1u);
    EXPECT_TRUE(fromFile.block.textures[0].encoded.empty());
    EXPECT_EQ(fromFile.block.textures[0].file.filename(), "bark 1.png");
    const Read missing = readText("t.glb", plain.glb(withMaterial(texture, images)));
    ASSERT_EQ(missing.error, "");
    EXPECT_EQ(warningsWith(missing.report, "texture 'tex/bark 1.png' is missing: 1 triangle is drawn"), 1);
}

TEST(GltfMaterials, TurnLinearColoursIntoSrgbAndMaskHoles) {
    const std::string image = R"(,"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,AAAA"}])";
    const auto first = [&](const std::string& material) {
        const Read r = readText("t.glb", texturedTriangle().glb(withMaterial(material, image)));
        EXPECT_EQ(r.error, "");
        return r.block.materials.empty() ? SourceMaterial{} : r.block.materials[0];
    };
    const SourceMaterial opaque = first(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0,1,0.5]}})");
    // 1.055 * 0.5^(1/2.4) - 0.055 = 0.735357
    EXPECT_NEAR(opaque.baseColour.x, 0.735357, 1e-6);
    EXPECT_EQ(opaque.baseColour.y, 0.0f);
    EXPECT_EQ(opaque.baseColour.z, 1.0f);
    EXPECT_EQ(opaque.baseColour.w, 1.0f);
    EXPECT_FALSE(opaque.alphaMask);
    for (const char* mode : {"MASK", "BLEND"}) {
        const std::string alpha = std::string(R"("alphaMode":")") + mode + '"';
        EXPECT_TRUE(
            first("{" + alpha + R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})").alphaMask)
            << mode;
        EXPECT_FALSE(first("{" + alpha + "}").alphaMask) << "no texture, no holes";
    }
}

TEST(GltfMaterials, LayTexturesOnAsTheExampleOfTheExtensionSays) {
    // KHR_texture_transform: offset (0,1), rotation 90 degrees, scale 0.5 shows "only the lower left quadrant
    // of the source image, rotated clockwise 90 degrees": u in [0, 0.5], v (from the top) in [0.5, 1].
    const std::string material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{
        "KHR_texture_transform":{"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]}}}}})";
    const Read r = readText("t.glb", texturedTriangle().glb(withMaterial(
                                         material, R"(,"extensionsRequired":["KHR_texture_transform"],
        "textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,AAAA"}])")));
    ASSERT_EQ(r.error, "");
    EXPECT_LT(glm::distance(r.mesh().uvs[0], glm::vec2(0.0f, 1.0f)), 1e-6f);
    EXPECT_LT(glm::distance(r.mesh().uvs[1], glm::vec2(0.0f, 0.5f)), 1e-6f);
    EXPECT_LT(glm::distance(r.mesh().uvs[2], glm::vec2(0.5f, 1.0f)), 1e-6f);
}

TEST(GltfMaterials, UseTheSetOfTextureCoordinatesThatTheyName) {
    B builder = texturedTriangle();
    builder.add(std::vector<float>{0.5f, 0.25f, 1, 0, 0, 1}, B::kFloat, "VEC2");
    const std::string image = R"(,"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,AAAA"}])";
    const std::string rest =
        oneMesh(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2},"material":0},
        {"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0})") +
        R"(,"materials":[{"pbrMetallicRoughness":{
        "baseColorTexture":{"index":0,"texCoord":1}}}])" +
        image;
    const Read r = readText("t.glb", builder.glb(rest));
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.mesh().uvs[0], glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(r.block.materials[r.mesh().materials[0]].texture, 0);
    EXPECT_EQ(r.block.materials[r.mesh().materials[1]].texture, -1) << "the second primitive lacks that set";
}

// --- What is refused ---

TEST(ReadGltf, NamesRequiredExtensionsThatItDoesNotHave) {
    const Read r = readText(
        "t.glb",
        texturedTriangle().glb(
            oneMesh(R"({"attributes":{"POSITION":0}})") +
            R"(,"extensionsRequired":["KHR_draco_mesh_compression","KHR_materials_unlit","EXT_meshopt_compression"])"));
    EXPECT_TRUE(contains(
        r.error, "requires what cannot be read: KHR_draco_mesh_compression, EXT_meshopt_compression ("))
        << r.error;
}

TEST(ReadGltf, SaysWhatIsWrongInADocument) {
    const std::string one = R"({"attributes":{"POSITION":0}})";
    B builder = texturedTriangle();
    builder.add(std::vector<std::uint8_t>{0, 1, 3}, B::kUByte, "SCALAR");
    const struct {
        std::string text;
        const char* part;
    } cases[] = {
        {builder.glb(oneMesh(R"({"attributes":{"POSITION":0},"indices":2})")),
         "mesh 0, primitive 0: refers to vertex 3 of 3"},
        {builder.glb(oneMesh(R"({"attributes":{"POSITION":9}})")), "accessor 9: does not exist"},
        {builder.glb(oneMesh(R"({"attributes":{"POSITION":1}})")),
         "accessor 1: has a type that does not fit"},
        {builder.glb(oneMesh(R"({"attributes":{"NORMAL":0}})")), "has no positions"},
        {builder.glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])"),
         "node 0: has two parents or is its own ancestor"},
        {builder.glb(R"("scenes":[{"nodes":[7]}],"nodes":[{"mesh":0}])"), "node 7: does not exist"},
        {builder.glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":5}])"),
         "refers to a mesh that does not exist"},
        {"{\"asset\":{\"version\":\"1.0\"}}", "is glTF '1.0'"},
        {"{\"asset\":{}}", "says no version"},
        {"{\"asset\":", "its JSON cannot be parsed"},
        {std::string(100000, '['), "is not gltf: that begins with"},
        {"{\"a\":" + std::string(100000, '['), "nested too deeply"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"../../etc/passwd"}]})",
         "lies outside the model's folder"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"gone.bin"}]})",
         "'gone.bin' is missing"},
        {R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:application/octet-stream;base64,AAAAAA=="}],
            "bufferViews":[{"buffer":0,"byteOffset":2,"byteLength":3}]})",
         "bufferView 0: reaches beyond the end"},
    };
    for (const auto& c : cases) {
        const std::string error = readText("bad.gltf", c.text).error;
        EXPECT_TRUE(contains(error, c.part)) << error.substr(0, 500);
    }
    const std::string glb = builder.glb(oneMesh(one));
    EXPECT_TRUE(contains(readText("t.glb", glb.substr(0, glb.size() - 1)).error,
                         "byte " + std::to_string(glb.size() - 1) + ": the file ends here and should have " +
                             std::to_string(glb.size())));
}

TEST(ReadGltf, RefusesAccessorsBeyondTheirView) {
    B builder = texturedTriangle();
    std::string text = builder.embedded(oneMesh(R"({"attributes":{"POSITION":0}})"));
    const std::size_t at = text.find("\"count\":3");
    text.replace(at, 9, "\"count\":4");
    EXPECT_TRUE(contains(readText("t.gltf", text).error, "accessor 0: does not lie within its buffer view"));
    text.replace(at, 9, "\"count\":4611686018427387905");
    EXPECT_TRUE(contains(readText("t.gltf", text).error, "accessor 0: does not lie within its buffer view"));
}

}  // namespace
}  // namespace fb::test
