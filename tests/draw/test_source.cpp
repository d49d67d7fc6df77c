// The source drawn directly is the reference for what nodes show.
#include <gtest/gtest.h>

#include <cstdlib>

#include "draw/draw_world.h"
#include "draw/source_renderer.h"

namespace fb::draw_test {

namespace {

std::shared_ptr<const Image> imageOf(int width, int height, const std::vector<std::uint8_t>& rgba) {
    auto image = std::make_shared<Image>();
    *image = {width, height, 4, rgba, true};
    return image;
}

// The same mesh as nodes have it, and as import makes it: `at` is the node's grid origin.
void addToSource(SourceBlock& block, const DecodedNode& node, const glm::dvec3& at) {
    SourceMesh& mesh = block.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const GpuVertex& v : node.vertices) {
        mesh.positions.push_back(at + glm::dvec3(v.position[0], v.position[1], v.position[2]));
        mesh.normals.push_back(decodeNormal(v.normal));
        mesh.uvs.push_back(glm::vec2(v.u, v.v) / 65535.0f);
        mesh.colours.push_back({v.colour[0], v.colour[1], v.colour[2], v.colour[3]});
    }
    std::uint32_t material = kNoMaterial;
    if (node.texturedTriangles > 0) {
        material = static_cast<std::uint32_t>(block.materials.size());
        block.materials.push_back(
            {"", glm::vec4(1.0f), static_cast<int>(block.textures.size()), node.flags.alphaMask});
        const std::size_t bytes = std::size_t{4} * node.textureWidth * node.textureHeight;
        block.textures.push_back({"texture",
                                  {},
                                  {},
                                  imageOf(node.textureWidth, node.textureHeight,
                                          {node.texels.begin(), node.texels.begin() + bytes})});
    }
    for (std::size_t i = 0; i + 2 < node.indices.size(); i += 3) {
        mesh.triangles.push_back(glm::uvec3(node.indices[i], node.indices[i + 1], node.indices[i + 2]) +
                                 first);
        mesh.materials.push_back(i / 3 < node.texturedTriangles ? material : kNoMaterial);
    }
}

int largestDifference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size() && i < b.pixels.size(); ++i) {
        largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
    }
    return a.pixels.size() == b.pixels.size() ? largest : 256;
}

}  // namespace

// Fifteen nodes at 6.5e6 m, textured with several pixels a texel, some with holes, some in odd windings.
TEST_F(DrawTest, ShowsWhatTheSourceShows) {
    World world;
    std::vector<SourceBlock> blocks(3);
    const glm::dvec3 far(6.5e6, 5.5e6, 100.0);
    for (int i = 0; i < 15; ++i) {
        const glm::dvec3 at = far + glm::dvec3(i * 1.5 - 11, 0.25 * (i % 3), -10 - i % 4);
        DecodedNode node;
        if (i % 3 != 0) {
            addTexturedQuad(node, {glm::vec3{0, 4, 0}, {4, 4, -2}, {4, -1, 0}, {0, -1, 0.5f}});
            setTexture(node, 16, 16, manyColours(16, 16));
            node.flags.alphaMask = i % 3 == 2;
            for (std::size_t k = 3; node.flags.alphaMask && k < 1024; k += 12) node.texels[k] = 0;
            // The middle of the texture: at its border a node's atlas is clamped and the source's image
            // repeats.
            for (GpuVertex& v : node.vertices) v.u = v.u == 0 ? 16384 : 49151, v.v = v.v == 0 ? 16384 : 49151;
        }
        addQuad(node, {glm::vec3{0, -2, 0}, {4, -2, 0}, {4, -3, 2}, {0, -3, 2}},
                {static_cast<std::uint8_t>(i * 17), 99, 200});
        if (i % 2 == 0) std::swap(node.indices[0], node.indices[1]);
        addToSource(blocks[static_cast<std::size_t>(i) % 3], node, at);
        world.add(std::move(node), at);
    }
    world.uploadAll(*renderer);
    const View view = viewAlongZ(far + glm::dvec3(0.5, 0.25, 0), 200, 150);
    for (const bool texturing : {false, true}) {
        for (const bool lighting : {false, true}) {
            effects[Effect::texturing] = texturing;
            effects[Effect::lighting] = lighting;
            const auto source = drawSource(kShaders, blocks, view, effects, {0, 1, 0});
            ASSERT_TRUE(source) << source.error().oneLine();
            // Normals and colours of nodes are decoded from integers on the GPU, which may round a byte the
            // other way.
            EXPECT_LE(largestDifference(picture(world, view), *source), lighting ? 1 : 0)
                << texturing << lighting;
        }
    }
}

// uv from (-1, -1) to (1, 1): the texture twice in each direction, one texel a pixel.
TEST_F(DrawTest, RepeatsTheTexturesOfTheSource) {
    const auto texels = manyColours(4, 4);
    SourceBlock block;
    block.mesh.positions = {{-4, 4, -4}, {4, 4, -4}, {4, -4, -4}, {-4, -4, -4}};
    block.mesh.uvs = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    block.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    block.mesh.materials = {0, 0};
    block.materials = {{"", glm::vec4(1.0f), 0, false}};
    block.textures = {{"t", {}, {}, imageOf(4, 4, texels)}};
    effects[Effect::texturing] = true;
    const auto image = drawSource(kShaders, {&block, 1}, viewAlongZ({}, 8, 8), effects, {0, 1, 0});
    ASSERT_TRUE(image) << image.error().oneLine();
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            const auto at = static_cast<std::size_t>((y % 4 * 4 + x % 4) * 4);
            EXPECT_EQ(pixel(*image, x, y), (Rgb{texels[at], texels[at + 1], texels[at + 2]}))
                << x << " " << y;
        }
    }
}

// Base colour times vertex colour; a grey texture with alpha; a triangle without material or normals.
TEST_F(DrawTest, DrawsMaterialsOfTheSource) {
    SourceBlock block;
    block.mesh.positions = {{-4, 4, -4}, {0, 4, -4}, {0, -4, -4}, {-4, -4, -4}, {4, 4, -4}, {4, -4, -4}};
    block.mesh.uvs.assign(6, {0.5f, 0.5f});
    block.mesh.colours = {{255, 255, 255, 255}, {255, 255, 255, 255}, {255, 255, 255, 255},
                          {255, 255, 255, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}};
    for (auto& colour : block.mesh.colours) colour = {200, 100, 50, 255};
    block.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {1, 2, 5}, {1, 5, 4}};
    block.mesh.materials = {0, 0, kNoMaterial, kNoMaterial};
    block.materials = {{"", {0.5f, 1.0f, 0.2f, 1.0f}, 0, false}};
    auto grey = std::make_shared<Image>();
    *grey = {1, 1, 2, {102, 0}, true};  // 0.4; the alpha counts only with a mask
    block.textures = {{"grey", {}, {}, grey}};
    effects[Effect::texturing] = true;
    const View view = viewAlongZ({}, 8, 8);
    auto image = drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0});
    ASSERT_TRUE(image);
    EXPECT_EQ(count(*image, {40, 40, 4}), 32);
    EXPECT_EQ(count(*image, {200, 100, 50}), 32);
    block.materials[0].alphaMask = true;
    image = drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0});
    EXPECT_EQ(count(*image, {40, 40, 4}), 0);
    // Lit by the normal of the triangles, which face the viewer: 0.94877 as for nodes.
    effects[Effect::lighting] = true;
    image = drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0});
    EXPECT_EQ(count(*image, {190, 95, 47}), 32);
}

TEST_F(DrawTest, RefusesASourceThatDoesNotFitTogether) {
    SourceBlock block;
    block.name = "roof";
    block.mesh.positions = {{0, 0, -4}, {1, 0, -4}, {0, 1, -4}};
    block.mesh.triangles = {{0, 1, 3}};
    const View view = viewAlongZ({}, 8, 8);
    auto image = drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0});
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().oneLine(), "roof: triangle 0: a vertex that does not exist");
    block.mesh.triangles[0].z = 2;
    block.mesh.colours = {{1, 2, 3, 4}};
    EXPECT_FALSE(drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0}));
    block.mesh.colours.clear();
    EXPECT_TRUE(drawSource(kShaders, {&block, 1}, view, effects, {0, 1, 0}));
}

}  // namespace fb::draw_test
