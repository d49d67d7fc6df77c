#include <gtest/gtest.h>

#include "build/make_atlas.h"
#include "scenefile/scene.h"

namespace fb {
namespace {

// As the texture of a node of one triangle.
Result<DecodedNode> decodeTexture(const NodeTexture& texture) {
    NodeData node;
    node.mesh.vertices.resize(3);
    node.mesh.indices = {0, 1, 2};
    node.mesh.texturedTriangles = 1;
    node.texture = texture;
    return decodeNode(node, BlockGrid{}, "test");
}

TEST(EncodeTexture, GivesBackPngTexelsExactlyAndJpegTexelsNearly) {
    Image image{24, 16, 3, {}, false};
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 24; ++x) {
            const glm::u8vec3 colour(x * 10, y * 15, 128);
            for (int c = 0; c < 3; ++c) image.pixels.push_back(colour[c]);
        }
    }
    for (const PayloadCodec codec : {PayloadCodec::png, PayloadCodec::jpeg}) {
        Result<NodeTexture> texture = encodeTexture(image, codec, 92);
        ASSERT_TRUE(texture) << texture.error().oneLine();
        EXPECT_EQ(texture->width, 24);
        EXPECT_EQ(texture->channels, 3);
        const Result<DecodedNode> decoded = decodeTexture(*texture);
        ASSERT_TRUE(decoded) << decoded.error().oneLine();
        for (std::size_t i = 0; i < 24 * 16; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(decoded->texels[i * 4 + c], image.pixels[i * 3 + c],
                            codec == PayloadCodec::png ? 0 : 6);
            }
        }
    }
}

TEST(EncodeTexture, KeepsColoursUnderTransparentTexels) {
    Image image{4, 4, 4, {}, false};
    for (int i = 0; i < 16; ++i)
        image.pixels.insert(image.pixels.end(), {200, 100, 50, static_cast<std::uint8_t>(i * 17)});
    Result<NodeTexture> texture = encodeTexture(image, PayloadCodec::png, 92);
    ASSERT_TRUE(texture);
    const Result<DecodedNode> decoded = decodeTexture(*texture);
    ASSERT_TRUE(decoded) << decoded.error().oneLine();
    EXPECT_EQ(std::vector<std::uint8_t>(decoded->texels.begin(), decoded->texels.begin() + 64), image.pixels);
}

}  // namespace
}  // namespace fb
