#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "base/random.h"
#include "scenefile/limits.h"
#include "scenefile/payload_format.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::Bytes;
using test::lineOf;
using test::says;

using Raw = std::array<std::uint8_t, sizeof(NodeVertex)>;
using Triangle = std::array<Raw, 3>;

Raw rawOf(const NodeVertex& v) {
    Raw raw;
    std::memcpy(raw.data(), &v, sizeof v);
    return raw;
}

// The triangles of one range as sets of vertex values, independent of their order and of the corner they
// begin with.
std::vector<Triangle> trianglesOf(const NodeMesh& mesh, std::size_t first, std::size_t count) {
    std::vector<Triangle> triangles;
    for (std::size_t t = first; t < first + count; ++t) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = rawOf(mesh.vertices[mesh.indices[t * 3 + k]]);
        const auto& [a, b, c] = triangle;
        triangles.push_back(std::min({triangle, Triangle{b, c, a}, Triangle{c, a, b}}));
    }
    std::ranges::sort(triangles);
    return triangles;
}

std::vector<Raw> verticesOf(const NodeMesh& mesh) {
    std::vector<Raw> all;
    for (const NodeVertex& v : mesh.vertices) all.push_back(rawOf(v));
    std::ranges::sort(all);
    return all;
}

NodeData randomNode() {
    NodeData node;
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto vertices =
        *rc::gen::inRange<std::uint32_t>(1, 700);  // more than two blocks of the vertex codec
    for (std::uint32_t i = 0; i < vertices; ++i) {
        NodeVertex v{};
        // Distinct, so that triangles can be told apart.
        v.x = i;
        v.y = static_cast<std::uint32_t>(random.index(kGridCells));
        v.z = static_cast<std::uint32_t>(random.index(100));
        encodeNormal({static_cast<float>(random.normal()), static_cast<float>(random.normal()), 1.0f},
                     v.normal);
        v.u = static_cast<std::uint16_t>(random.bits());
        v.v = static_cast<std::uint16_t>(random.bits());
        for (std::uint8_t& c : v.colour) c = static_cast<std::uint8_t>(random.bits());
        node.mesh.vertices.push_back(v);
    }
    const bool textured = *rc::gen::arbitrary<bool>();
    node.mesh.texturedTriangles = textured ? *rc::gen::inRange<std::uint32_t>(0, 300) : 0;
    node.mesh.untexturedTriangles = *rc::gen::inRange<std::uint32_t>(0, 300);
    node.mesh.texturedSkirts =
        node.mesh.texturedTriangles > 0 ? *rc::gen::inRange<std::uint32_t>(0, node.mesh.texturedTriangles + 1) : 0;
    node.mesh.untexturedSkirts =
        *rc::gen::inRange<std::uint32_t>(0, node.mesh.untexturedTriangles + 1);
    node.mesh.flags.alphaMask = *rc::gen::arbitrary<bool>();
    const std::uint32_t indices = 3 * (node.mesh.texturedTriangles + node.mesh.untexturedTriangles);
    for (std::uint32_t i = 0; i < indices; ++i) {
        node.mesh.indices.push_back(static_cast<std::uint32_t>(random.index(vertices)));
    }
    if (!textured) return node;
    node.texture.codec = *rc::gen::element(PayloadCodec::jpeg, PayloadCodec::png);
    node.texture.width = *rc::gen::element<std::uint16_t>(4, 6, 8, 12, 16384);
    node.texture.height = *rc::gen::element<std::uint16_t>(4, 6, 8, 12, 16384);
    node.texture.channels = *rc::gen::inRange<std::uint8_t>(1, 5);
    node.texture.encoded = *rc::gen::nonEmpty<Bytes>();  // not decoded here
    return node;
}

RC_GTEST_PROP(Payload, GivesBackWhatWasWritten, ()) {
    const NodeData node = randomNode();
    const Bytes bytes = encodePayload(node).value();
    Result<NodeData> read = parsePayload(bytes, "node");
    RC_ASSERT(lineOf(read) == "no error");
    const NodeMesh& before = node.mesh;
    const NodeMesh& after = read->mesh;
    RC_ASSERT(after.texturedTriangles == before.texturedTriangles);
    RC_ASSERT(after.untexturedTriangles == before.untexturedTriangles);
    RC_ASSERT(after.flags.alphaMask == before.flags.alphaMask);
    RC_ASSERT(verticesOf(after) == verticesOf(before));
    RC_ASSERT(after.texturedSkirts == before.texturedSkirts);
    RC_ASSERT(after.untexturedSkirts == before.untexturedSkirts);
    std::size_t first = 0;
    for (const std::uint32_t count :
         {before.texturedTriangles - before.texturedSkirts, before.texturedSkirts,
          before.untexturedTriangles - before.untexturedSkirts, before.untexturedSkirts}) {
        RC_ASSERT(trianglesOf(after, first, count) == trianglesOf(before, first, count));
        first += count;
    }
    RC_ASSERT(read->texture.codec == node.texture.codec);
    RC_ASSERT(read->texture.width == node.texture.width);
    RC_ASSERT(read->texture.height == node.texture.height);
    RC_ASSERT(read->texture.channels == node.texture.channels);
    RC_ASSERT(read->texture.encoded == node.texture.encoded);
    RC_ASSERT(encodePayload(node).value() == bytes);
}

TEST(Payload, MayBeWithoutTriangles) {
    const Bytes bytes = encodePayload(NodeData{}).value();
    Result<NodeData> read = parsePayload(bytes, "node");
    ASSERT_TRUE(read) << lineOf(read);
    EXPECT_TRUE(read->mesh.vertices.empty());
    EXPECT_TRUE(read->mesh.indices.empty());
    EXPECT_EQ(read->texture.codec, PayloadCodec::none);
}

Bytes tinyPayload() {
    return encodePayload(test::oneTriangle(8, test::makeTexture(PayloadCodec::jpeg, 4, 4, 3, 1))).value();
}

TEST(ParsePayload, RefusesEveryPrefix) {
    const Bytes bytes = tinyPayload();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const Bytes prefix(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(length));  // ASan sees its end
        const Result<NodeData> read = parsePayload(prefix, "node");
        EXPECT_FALSE(read) << length;
    }
}

TEST(ParsePayload, RefusesOneByteMore) {
    Bytes bytes = tinyPayload();
    bytes.push_back(0);
    EXPECT_TRUE(says(lineOf(parsePayload(bytes, "node")), "node: the node's parts take"));
}

// Checksums find these (see the scene's tests); here the parser itself must survive and stay within its own
// rules.
TEST(ParsePayload, SurvivesEveryFlippedBit) {
    const Bytes good = tinyPayload();
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
        Bytes bytes = good;
        bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
        const Result<NodeData> read = parsePayload(bytes, "node");
        if (!read) continue;
        for (std::uint32_t index : read->mesh.indices) EXPECT_LT(index, read->mesh.vertices.size());
        const Result<DecodedNode> decoded = decodeNode(*read, BlockGrid{}, "node");
        if (!decoded) continue;
        EXPECT_EQ(decoded->texels.size(), mippedBytes(read->texture.width, read->texture.height));
    }
}

TEST(ParsePayload, NamesAnotherVersion) {
    Bytes bytes = tinyPayload();
    bytes[4] = 7;
    EXPECT_EQ(lineOf(parsePayload(bytes, "node")),
              "node: made by version 7; this program reads 2 (build it again)");
}

PayloadHeader soundHeader() {
    PayloadHeader header;
    header.vertices = 3;
    header.texturedTriangles = 1;
    header.codec = 1;
    header.channels = 3;
    header.textureWidth = header.textureHeight = 4;
    header.vertexBytes = 100;
    header.indexBytes = 18;
    header.textureBytes = 10;
    return header;
}

std::string verdict(const PayloadHeader& h) {
    return lineOf(
        checkPayloadHeader(h, std::uint64_t{h.vertexBytes} + h.indexBytes + h.textureBytes, "node"));
}

TEST(CheckPayloadHeader, AcceptsCountsAtTheirCapsAndNoneAbove) {
    PayloadHeader h = soundHeader();
    EXPECT_EQ(verdict(h), "no error");
    h.vertices = kMaxNodeVertices;
    h.vertexBytes = kMaxNodeVertices;
    h.untexturedTriangles = kMaxNodeTriangles - 1;
    h.indexBytes = kMaxNodeTriangles + 17;
    h.textureWidth = h.textureHeight = kMaxTextureSide;
    h.channels = 4;
    EXPECT_EQ(verdict(h), "no error");

    PayloadHeader above = h;
    above.vertices += 1;
    EXPECT_TRUE(says(verdict(above), "too many vertices"));
    above = h;
    above.untexturedTriangles += 1, above.indexBytes += 1;
    EXPECT_TRUE(says(verdict(above), "too many triangles"));
    above = h;
    above.untexturedTriangles = ~0u;
    EXPECT_TRUE(says(verdict(above), "too many triangles"));
    above = h;
    above.channels = 5;
    EXPECT_TRUE(says(verdict(above), "cannot be 16384 x 16384 with 5"));
    above = h;
    above.textureHeight = 24576;  // the next class
    EXPECT_TRUE(says(verdict(above), "cannot be"));
}

TEST(CheckPayloadHeader, RefusesMoreSkirtsThanTriangles) {
    PayloadHeader h = soundHeader();
    h.texturedSkirts = 1;
    EXPECT_EQ(verdict(h), "no error");
    h.texturedSkirts = 2;
    EXPECT_TRUE(says(verdict(h), "more skirts than triangles"));
    h.texturedSkirts = 0, h.untexturedSkirts = 1;
    EXPECT_TRUE(says(verdict(h), "more skirts than triangles"));
}

TEST(CheckPayloadHeader, BelievesNoCountThatTheBytesCannotHold) {
    PayloadHeader h = soundHeader();
    h.indexBytes = 17;  // one triangle needs 18
    EXPECT_TRUE(says(verdict(h), "too many triangles"));
    h = soundHeader();
    h.vertices = 256 * 2, h.vertexBytes = 191;  // two blocks of the codec need 192
    EXPECT_TRUE(says(verdict(h), "too many vertices"));
    h.vertexBytes = 192;
    EXPECT_EQ(verdict(h), "no error");
}

// The bound above against the codec itself: the most compressible vertices that there are.
TEST(CheckPayloadHeader, AcceptsTheShortestMeshesThatTheCodecsMake) {
    for (std::uint32_t count : {1u, 255u, 256u, 257u, 5000u}) {
        NodeData node;
        node.mesh.vertices.resize(count);
        node.mesh.untexturedTriangles = count;
        node.mesh.indices.resize(std::size_t{count} * 3, 0);
        EXPECT_TRUE(parsePayload(encodePayload(node).value(), "node")) << count;
    }
}

TEST(CheckPayloadHeader, RefusesTexturesThatContradictThemselves) {
    PayloadHeader h = soundHeader();
    h.codec = 3;
    EXPECT_TRUE(says(verdict(h), "codec is unknown"));
    h = soundHeader();
    h.codec = 0;
    EXPECT_TRUE(says(verdict(h), "texture without a codec"));
    h = soundHeader();
    h.codec = 0, h.channels = 0, h.textureWidth = h.textureHeight = 0, h.textureBytes = 0;
    EXPECT_TRUE(says(verdict(h), "textured triangles but no texture"));
    h.texturedTriangles = 0, h.untexturedTriangles = 1;
    EXPECT_EQ(verdict(h), "no error");
    h = soundHeader();
    h.textureBytes = 0;
    EXPECT_TRUE(says(verdict(h), "cannot be"));
    h = soundHeader();
    h.textureWidth = 0;
    EXPECT_TRUE(says(verdict(h), "cannot be"));
    h = soundHeader();
    h.textureWidth = 5;  // no class
    EXPECT_TRUE(says(verdict(h), "cannot be"));
}

TEST(EncodePayload, RefusesWhatIsAboveTheCaps) {
    NodeData node = test::oneTriangle(0, {PayloadCodec::jpeg, 24576, 4, 3, {1}});
    EXPECT_TRUE(says(lineOf(encodePayload(node)), "wider than 16384"));
}

TEST(DecodeNode, TurnsTheGridIntoMetres) {
    NodeData node = test::oneTriangle(16);
    node.mesh.vertices[1].x = kGridCells - 1;
    const Result<DecodedNode> decoded = decodeNode(node, {{5.0, 6.0, 7.0}, 0.125}, "node");
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->vertices[0].position[0], 2.0f);  // 16 * 0.125: relative to the grid's origin
    EXPECT_EQ(decoded->vertices[2].position[1], 2.5f);  // (16 + 4) * 0.125
    EXPECT_EQ(decoded->vertices[1].position[0], 2097151.875f);
    EXPECT_EQ(decoded->vertices[1].u, 65535);
    EXPECT_EQ(decoded->indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(decoded->untexturedTriangles, 1u);
    EXPECT_TRUE(decoded->texels.empty());
    EXPECT_EQ(decoded->sizeBytes(), residentBytes(3, 1, 0, 0));
}

// PNG is lossless, so the texels are those that were put in; 1 to 4 channels become four.
TEST(DecodeNode, WidensPngsToFourChannels) {
    for (std::uint8_t channels = 1; channels <= 4; ++channels) {
        Bytes pixels(std::size_t{6} * 4 * channels);
        for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * 37 + 11);
        const NodeTexture texture = test::makeTexture(PayloadCodec::png, 6, 4, channels, pixels);
        const Result<DecodedNode> decoded = decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node");
        ASSERT_TRUE(decoded) << lineOf(decoded);
        EXPECT_EQ(decoded->mipLevels, 3u);
        EXPECT_EQ(decoded->sizeBytes(), residentBytes(3, 1, 6, 4));
        for (std::size_t i = 0; i < 24; ++i) {
            const std::uint8_t* from = &pixels[i * channels];
            const bool colour = channels >= 3;
            const std::array<int, 4> expected = {from[0], from[colour ? 1 : 0], from[colour ? 2 : 0],
                                                 channels % 2 == 0 ? from[channels - 1] : 255};
            for (std::size_t c = 0; c < 4; ++c) {
                ASSERT_EQ(decoded->texels[i * 4 + c], expected[c])
                    << int{channels} << " channels, texel " << i;
            }
        }
    }
}

TEST(DecodeNode, DecodesAFlatJpegToItsColour) {
    Bytes pixels;
    for (int i = 0; i < 16 * 8; ++i) pixels.insert(pixels.end(), {200, 100, 50});
    const NodeTexture texture = test::makeTexture(PayloadCodec::jpeg, 16, 8, 3, pixels);
    const Result<DecodedNode> decoded = decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node");
    ASSERT_TRUE(decoded) << lineOf(decoded);
    ASSERT_EQ(decoded->texels.size(), mippedBytes(16, 8));
    for (std::size_t i = 0; i < decoded->texels.size(); i += 4) {
        EXPECT_NEAR(decoded->texels[i], 200, 3);
        EXPECT_NEAR(decoded->texels[i + 1], 100, 3);
        EXPECT_NEAR(decoded->texels[i + 2], 50, 3);
        EXPECT_EQ(decoded->texels[i + 3], 255);
    }
}

TEST(DecodeNode, RefusesATextureThatIsNotWhatTheHeaderSays) {
    NodeTexture texture = test::makeTexture(PayloadCodec::png, 8, 8, 3, 1);
    texture.height = 4;
    EXPECT_TRUE(says(lineOf(decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node")),
                     "node: texture: is 8 x 8 x 3 uint8 instead of 8 x 4 x 3 uint8"));
    texture.height = 8, texture.channels = 4;
    EXPECT_TRUE(
        says(lineOf(decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node")), "instead of 8 x 8 x 4"));
    texture.channels = 3, texture.codec = PayloadCodec::jpeg;
    EXPECT_TRUE(
        says(lineOf(decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node")), "cannot be opened"));
    texture.codec = PayloadCodec::png, texture.encoded[60] ^= 0xff;  // in the compressed texels
    EXPECT_FALSE(decodeNode(test::oneTriangle(0, texture), BlockGrid{}, "node"));
}

// Of the 2x2 quads four are half leaf, one is three quarters leaf, eleven are holes: 11 of 64 texels, so 2.75
// of the 16 of level 1 should pass. The plain means (128 four times, 191) let 5 pass; asking for more lets 1
// pass, which is nearer.
TEST(DecodeNode, KeepsCoverageOnlyForMasks) {
    Bytes pixels(8 * 8 * 4, 0);
    const auto leaf = [&](std::size_t x, std::size_t y) { pixels[(y * 8 + x) * 4 + 3] = 255; };
    for (std::size_t quad = 0; quad < 4; ++quad) leaf(quad * 2, 0), leaf(quad * 2 + 1, 1);
    leaf(0, 4), leaf(1, 4), leaf(0, 5);
    NodeData node = test::oneTriangle(0, test::makeTexture(PayloadCodec::png, 8, 8, 4, pixels));
    const auto passingAtLevelOne = [&] {
        const DecodedNode decoded = decodeNode(node, BlockGrid{}, "node").value();
        int passing = 0;
        for (std::size_t i = 64; i < 80; ++i) passing += decoded.texels[i * 4 + 3] >= 128 ? 1 : 0;
        return passing;
    };
    EXPECT_EQ(passingAtLevelOne(), 5);
    node.mesh.flags.alphaMask = true;
    EXPECT_EQ(passingAtLevelOne(), 1);
}

}  // namespace
}  // namespace fb
