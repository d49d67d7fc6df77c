#include "draw/draw_world.h"

#include <algorithm>

namespace fb::draw_test {

OffscreenContext& context() {
    static const std::unique_ptr<OffscreenContext> only = [] {
        auto made = OffscreenContext::create();
        if (!made) {
            std::fprintf(stderr, "%s\n", made.error().oneLine().c_str());
            std::abort();
        }
        return std::move(*made);
    }();
    return *only;
}

View viewAlongZ(const glm::dvec3& eye, int width, int height) {
    View view;
    view.camera.eye = eye;
    view.camera.fovyRadians = 1.5707963267948966;
    view.camera.nearMetres = 0.001;
    view.width = width;
    view.height = height;
    return view;
}

GpuVertex vertex(const glm::vec3& position, const Rgb& colour, const glm::vec3& normal, const glm::vec2& uv) {
    GpuVertex v{};
    for (int i = 0; i < 3; ++i) v.position[i] = position[i];
    encodeNormal(normal, v.normal);
    v.u = static_cast<std::uint16_t>(uv.x * 65535.0f + 0.5f);
    v.v = static_cast<std::uint16_t>(uv.y * 65535.0f + 0.5f);
    std::ranges::copy(colour, v.colour);
    v.colour[3] = 255;
    return v;
}

std::array<glm::vec3, 4> rectangle(float left, float bottom, float right, float top, float z) {
    return {glm::vec3{left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}};
}

DecodedNode colouredRectangle(float left, float bottom, float right, float top, float z, const Rgb& colour) {
    DecodedNode node;
    addQuad(node, rectangle(left, bottom, right, top, z), colour);
    return node;
}

std::vector<std::uint8_t> manyColours(int width, int height) {
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < width * height; ++i) {
        for (const int value : {i * 37 + 11, i * 91 + 5, i * 53 + 200, 255}) {
            texels.push_back(static_cast<std::uint8_t>(value % 256));
        }
    }
    return texels;
}

void addTriangle(DecodedNode& node, const std::array<glm::vec3, 3>& corners, const Rgb& colour) {
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const glm::vec3& corner : corners) {
        node.indices.push_back(static_cast<std::uint32_t>(node.vertices.size()));
        node.vertices.push_back(vertex(corner, colour, normal));
    }
    ++node.untexturedTriangles;
}

void addQuad(DecodedNode& node, const std::array<glm::vec3, 4>& c, const Rgb& colour) {
    addTriangle(node, {c[0], c[1], c[2]}, colour);
    addTriangle(node, {c[0], c[2], c[3]}, colour);
}

void addTexturedQuad(DecodedNode& node, const std::array<glm::vec3, 4>& corners) {
    constexpr std::array<glm::vec2, 4> kUvs = {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto first = static_cast<std::uint32_t>(node.vertices.size());
    for (std::size_t i = 0; i < 4; ++i) node.vertices.push_back(vertex(corners[i], kWhite, normal, kUvs[i]));
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) node.indices.push_back(first + i);
    node.texturedTriangles += 2;
}

void setTexture(DecodedNode& node, int width, int height, const std::vector<std::uint8_t>& rgba) {
    node.textureWidth = static_cast<std::uint16_t>(width);
    node.textureHeight = static_cast<std::uint16_t>(height);
    node.texels = rgba;
    node.mipLevels = 1;
    std::vector<std::uint8_t> level = rgba;
    while (width > 1 || height > 1) {
        const int nextWidth = std::max(1, width / 2), nextHeight = std::max(1, height / 2);
        std::vector<std::uint8_t> next;
        for (int y = 0; y < nextHeight; ++y) {
            for (int x = 0; x < nextWidth * 4; ++x) {
                int sum = 2;
                for (int k = 0; k < 4; ++k) {
                    const int fromX = std::min(width - 1, x / 4 * 2 + k % 2),
                              fromY = std::min(height - 1, y * 2 + k / 2);
                    sum += level[static_cast<std::size_t>((fromY * width + fromX) * 4 + x % 4)];
                }
                next.push_back(static_cast<std::uint8_t>(sum / 4));
            }
        }
        node.texels.insert(node.texels.end(), next.begin(), next.end());
        level = std::move(next);
        width = nextWidth;
        height = nextHeight;
        ++node.mipLevels;
    }
}

NodeId World::add(DecodedNode content, const glm::dvec3& gridOrigin, std::uint8_t level, double gridStep) {
    const auto node = static_cast<NodeId>(contents.size());
    Box3f bounds;
    for (const GpuVertex& v : content.vertices) {
        bounds.grow(glm::vec3(gridOrigin + glm::dvec3(v.position[0], v.position[1], v.position[2])));
    }
    hierarchy.parent.push_back(kNoNode);
    hierarchy.level.push_back(level);
    hierarchy.block.push_back(node);
    hierarchy.grids.push_back({gridOrigin, gridStep});
    hierarchy.kinds.push_back(BlockKind::objects);
    hierarchy.bounds.push_back(bounds);
    contents.push_back(std::move(content));
    front.push_back(node);
    return node;
}

void World::uploadAll(Renderer& renderer) const {
    for (NodeId node = 0; node < contents.size(); ++node) {
        const auto uploaded = renderer.upload(node, contents[node]);
        ASSERT_TRUE(uploaded) << uploaded.error().oneLine();
    }
}

DrawTest::DrawTest() {
    remake({});
}

DrawTest::~DrawTest() {
    renderer.reset();
    EXPECT_TRUE(messages.errors().empty()) << messages.errors().front();
}

void DrawTest::remake(const RendererOptions& options) {
    renderer.reset();
    auto made = Renderer::create(kShaders, options);
    if (!made) throw std::runtime_error(made.error().oneLine());
    renderer = std::move(*made);
}

Image DrawTest::picture(const World& world, const View& view) {
    counters = renderer->draw({world.hierarchy, world.front, view, settings, effects}, 1);
    EXPECT_EQ(renderer->fault(), "");
    return renderer->readPicture();
}

Image DrawTest::pictureWith(const RendererOptions& options, const World& world, const View& view,
                            const DrawSettings& drawSettings, const ActiveEffects& activeEffects) {
    auto made = Renderer::create(kShaders, options);
    if (!made) throw std::runtime_error(made.error().oneLine());
    world.uploadAll(**made);
    (*made)->draw({world.hierarchy, world.front, view, drawSettings, activeEffects}, 1);
    return (*made)->readPicture();
}

Rgb pixel(const Image& image, int x, int y) {
    const auto at = static_cast<std::size_t>(y * image.width + x) * 3;
    return {image.pixels.at(at), image.pixels.at(at + 1), image.pixels.at(at + 2)};
}

int count(const Image& image, const Rgb& colour) {
    int found = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) found += pixel(image, x, y) == colour ? 1 : 0;
    }
    return found;
}

std::string row(const Image& image, int y, const std::vector<std::pair<char, Rgb>>& letters) {
    std::string text;
    for (int x = 0; x < image.width; ++x) {
        char letter = '.';
        for (const auto& [name, colour] : letters) letter = pixel(image, x, y) == colour ? name : letter;
        text += letter;
    }
    return text;
}

}  // namespace fb::draw_test
