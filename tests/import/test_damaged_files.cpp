// Every reader meets every prefix and thousands of damaged copies of a small valid file of its format. What
// must hold: no crash (the sanitizers watch), and either one clear error or a mesh that keeps all the
// promises of SourceMesh. A cut inside the last number of a text, or between two lines of OBJ, cannot be
// seen: it gives a smaller valid mesh.
#include "base/random.h"
#include "gltf_builder.h"
#include "import/clean_mesh.h"
#include "import/mesh_file.h"

namespace fb::test {
namespace {

struct Format {
    const char* name;
    std::string content;
    std::size_t leastUseful;  // shorter prefixes than this must be refused
};

// In memory: thousands of files would test the disk.
Read readBytes(const TempFolder& folder, const std::string& name, std::string_view content) {
    Read result;
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(content.data()),
                                              content.size());
    Result<LoadedMesh> loaded = parseMesh({folder.path() / name, bytes}, {}, result.report);
    if (loaded) {
        result.block = std::move(loaded->mesh.block);
    } else {
        result.error = loaded.error().oneLine();
    }
    return result;
}

void expectSound(const Read& r, const std::string& what) {
    if (!r.error.empty()) {
        EXPECT_TRUE(contains(r.error, "damaged.")) << "an error names its file: " << r.error;
        EXPECT_EQ(r.error.find('\n'), std::string::npos) << r.error;
        return;
    }
    const SourceMesh& mesh = r.mesh();
    const std::size_t vertices = mesh.positions.size();
    ASSERT_FALSE(mesh.triangles.empty()) << what;
    ASSERT_EQ(mesh.materials.size(), mesh.triangles.size()) << what;
    ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == vertices) << what;
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == vertices) << what;
    ASSERT_TRUE(mesh.colours.empty() || mesh.colours.size() == vertices) << what;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int c = 0; c < 3; ++c) {
            ASSERT_LT(mesh.triangles[t][c], vertices) << what;
            ASSERT_TRUE(std::isfinite(glm::dot(mesh.positions[mesh.triangles[t][c]], glm::dvec3(1.0))))
                << what;
        }
        const std::uint32_t material = mesh.materials[t];
        ASSERT_TRUE(material == kNoMaterial || material < r.block.materials.size()) << what;
    }
    for (const SourceMaterial& material : r.block.materials) {
        ASSERT_LT(material.texture, static_cast<int>(r.block.textures.size())) << what;
    }
    SourceMesh cleaned = mesh;
    ImportReport report;
    ASSERT_TRUE(cleanMesh(cleaned, what, report)) << what;
    EXPECT_EQ(report.keptTriangles + report.degenerateTriangles + report.duplicateTriangles,
              mesh.triangles.size());
}

std::string binaryPly(bool bigEndian) {
    Bytes bytes(bigEndian);
    bytes.add(
        std::string("ply\nformat binary_") + (bigEndian ? "big" : "little") +
        "_endian 1.0\ncomment TextureFile t.png\nelement vertex 4\nproperty double x\nproperty float y\n"
        "property short z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\n"
        "property float t\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property list ushort float texcoord\nproperty char texnumber\nelement tristrips 1\n"
        "property list int int vertex_indices\nend_header\n");
    for (int v = 0; v < 4; ++v) {
        bytes.add(double(v % 2))
            .add(float(v / 2))
            .add(std::int16_t(v))
            .add(std::uint8_t(v))
            .add(std::uint8_t{2});
        bytes.add(std::uint8_t{3}).add(0.5f).add(0.25f);
    }
    for (int f = 0; f < 2; ++f) {
        bytes.add(std::uint8_t{3}).add(std::int32_t{f}).add(std::int32_t{1 + f}).add(std::int32_t{2 + f});
        bytes.add(std::uint16_t{6});
        for (int i = 0; i < 6; ++i) bytes.add(0.125f * static_cast<float>(i));
        bytes.add(std::int8_t(f));
    }
    bytes.add(std::int32_t{7});
    for (const int index : {0, 1, 2, -1, 1, 2, 3}) bytes.add(std::int32_t{index});
    return bytes.text();
}

std::string binaryStl() {
    Bytes bytes;
    bytes.add(std::string(80, 'h')).add(std::uint32_t{2});
    for (int i = 0; i < 24; ++i) {
        bytes.add(static_cast<float>(i * i % 7));
        if (i % 12 == 11) bytes.add(std::uint16_t{0});
    }
    return bytes.text();
}

std::vector<Format> formats() {
    const std::string obj =
        "mtllib m.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 1 1 1 1\nvt 0 0\n"
        "vt 1 1\nvn 0 0 1\ng b\nusemtl x\ns 1\nf 1/1/1 2/2/1 3/1/1\nf -1//1 2//1 3//1\nl 1 2\nf 1 2 4 3 \\\n "
        "1\n";
    const std::string ply =
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n"
        "1 1 1 7 8 9\n3 0 1 2\n4 0 1 3 2\n";
    const std::string stl =
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
        "endfacet\nendsolid s\nsolid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
        "vertex 0 1 0.5\nendloop\nendfacet\nendsolid t\n";
    const std::string off =
        "STCNOFF\n# c\n4 3 0\n0 0 0 0 0 1 1 2 3 0 0\n1 0 0 0 0 1 1 2 3 1 0\n0 1 0 0 0 1 1 2 3 0 1\n"
        "1 1 0 0 0 1 1 2 3 1 1\n3 0 1 2\n4 0 1 3 2 255 0 0\n2 0 1\n";
    GltfBuilder gltf;
    gltf.add(cubePositions(), GltfBuilder::kFloat, "VEC3");
    gltf.add(cubeIndices<std::uint16_t>(), GltfBuilder::kUShort, "SCALAR");
    gltf.add(std::vector<float>(16, 0.5f), GltfBuilder::kFloat, "VEC2");
    const std::string rest =
        oneMesh(R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})") +
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
                             "textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,AAAA"}])";
    // Nothing is a mesh before the first face; the others are refused whenever anything of substance is
    // missing.
    return {{"damaged.obj", obj, obj.find("f 1/1/1") + 15},
            {"damaged.ply", ply, ply.size() - 1},
            {"damaged.ply", binaryPly(false), binaryPly(false).size()},
            {"damaged.ply", binaryPly(true), binaryPly(true).size()},
            {"damaged.stl", stl, stl.find("endsolid s") + 8},
            {"damaged.stl", binaryStl(), binaryStl().size()},
            {"damaged.off", off, off.size() - 1},
            {"damaged.glb", gltf.glb(rest), gltf.glb(rest).size()},
            {"damaged.gltf", gltf.embedded(rest), gltf.embedded(rest).size()}};
}

TEST(DamagedFiles, EveryPrefixIsRefusedOrAValidMesh) {
    const TempFolder folder;
    for (const Format& format : formats()) {
        const Read whole = readBytes(folder, format.name, format.content);
        ASSERT_EQ(whole.error, "") << format.name;
        for (std::size_t size = 0; size < format.content.size(); ++size) {
            const Read r = readBytes(folder, format.name, std::string_view(format.content).substr(0, size));
            const std::string what = std::string(format.name) + " cut at " + std::to_string(size);
            expectSound(r, what);
            if (size < format.leastUseful) {
                EXPECT_NE(r.error, "") << what;
            }
            EXPECT_LE(r.mesh().triangles.size(), whole.mesh().triangles.size()) << what;
        }
    }
}

TEST(DamagedFiles, ThousandsOfFlippedBitsAndReplacedBytesNeverCrashAReader) {
    constexpr int kTrials = 500;
    const TempFolder folder;
    Random random(20040711);
    for (const Format& format : formats()) {
        for (int trial = 0; trial < kTrials; ++trial) {
            std::string content = format.content;
            const std::uint64_t changes = 1 + random.index(4);
            for (std::uint64_t c = 0; c < changes; ++c) {
                char& byte = content[random.index(content.size())];
                switch (random.index(3)) {
                    case 0:
                        byte = static_cast<char>(byte ^ 1 << random.index(8));
                        break;
                    case 1:
                        byte = static_cast<char>(random.bits());
                        break;
                    default:
                        byte = "0-9 .e\n/\xff"[random.index(9)];
                        break;
                }
            }
            expectSound(readBytes(folder, format.name, content),
                        std::string(format.name) + " trial " + std::to_string(trial));
        }
    }
}

TEST(DamagedFiles, PartsRemovedRepeatedOrSwappedNeverCrashAReader) {
    constexpr int kTrials = 200;
    const TempFolder folder;
    Random random(7);
    for (const Format& format : formats()) {
        for (int trial = 0; trial < kTrials; ++trial) {
            std::string content = format.content;
            const std::size_t from = random.index(content.size()), length = 1 + random.index(30);
            const std::string part = content.substr(from, length);
            if (trial % 2 == 0) content.erase(from, length);
            if (trial % 4 != 0) content.insert(random.index(content.size() + 1), part);
            expectSound(readBytes(folder, format.name, content),
                        std::string(format.name) + " trial " + std::to_string(trial));
        }
    }
}

}  // namespace
}  // namespace fb::test
