// Tiny worlds for the renderer: nodes made by hand, each in a block of its own unless told otherwise, and a
// view whose pixels can be counted on paper.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "base/program_folder.h"
#include "draw/gl_messages.h"
#include "draw/offscreen_context.h"
#include "draw/renderer.h"

namespace fb::draw_test {

using Rgb = std::array<std::uint8_t, 3>;

inline const std::filesystem::path kShaders = programFolder() / "shaders";

// One context for all tests of the program: making one takes longer than most tests.
OffscreenContext& context();

// Looks along -z from `eye` with a 90 degree angle of view: at a distance of height / 2 metres a metre is a
// pixel.
View viewAlongZ(const glm::dvec3& eye, int width, int height);
// With the camera at (0, 0, 0), the plane z = -height / 2 maps 1 m to 1 pixel, and (0, 0) to the middle of
// the picture.

GpuVertex vertex(const glm::vec3& position, const Rgb& colour, const glm::vec3& normal = {0, 0, 1},
                 const glm::vec2& uv = {0, 0});

// Of the plane z, counter-clockwise from the lower left.
std::array<glm::vec3, 4> rectangle(float left, float bottom, float right, float top, float z);
DecodedNode colouredRectangle(float left, float bottom, float right, float top, float z, const Rgb& colour);

// RGBA, opaque, neighbours very different.
std::vector<std::uint8_t> manyColours(int width, int height);

// Adds a triangle or a rectangle (corners counter-clockwise) of one colour, untextured.
void addTriangle(DecodedNode& node, const std::array<glm::vec3, 3>& corners, const Rgb& colour);
void addQuad(DecodedNode& node, const std::array<glm::vec3, 4>& corners, const Rgb& colour);
// A textured rectangle: uv (0, 0) at the first corner, (1, 0), (1, 1), (0, 1) at the others. Before
// untextured ones.
void addTexturedQuad(DecodedNode& node, const std::array<glm::vec3, 4>& corners);
// Level 0 from RGBA texels, row 0 first, and all further levels by a 2 x 2 box filter.
void setTexture(DecodedNode& node, int width, int height, const std::vector<std::uint8_t>& rgba);

struct World {
    Hierarchy hierarchy;
    std::vector<DecodedNode> contents;
    std::vector<NodeId> front;  // every node

    // gridStep: positions of the node are multiples of it.
    NodeId add(DecodedNode content, const glm::dvec3& gridOrigin = glm::dvec3(0.0), std::uint8_t level = 0,
               double gridStep = 0x1p-10);
    // Fails the test where a node is refused.
    void uploadAll(Renderer& renderer) const;
};

// A renderer on the context, with a listener that fails the test on any error that the driver reports.
class DrawTest : public ::testing::Test {
  protected:
    DrawTest();
    ~DrawTest() override;

    void remake(const RendererOptions& options);
    // Draws the whole world.
    Image picture(const World& world, const View& view);
    // With a renderer made for the one picture.
    static Image pictureWith(const RendererOptions& options, const World& world, const View& view,
                             const DrawSettings& settings, const ActiveEffects& effects);

    OffscreenContext& current = context();  // before anything that asks the driver
    GlMessages messages;
    std::unique_ptr<Renderer> renderer;
    DrawSettings settings;
    ActiveEffects effects;
    DrawCounters counters;  // of the last picture
};

[[nodiscard]] Rgb pixel(const Image& image, int x, int y);
[[nodiscard]] int count(const Image& image, const Rgb& colour);
// The colours of a column from top to bottom, one letter each, "." for anything else: "..rrgg..".
[[nodiscard]] std::string row(const Image& image, int y, const std::vector<std::pair<char, Rgb>>& letters);

inline constexpr Rgb kRed{255, 0, 0}, kGreen{0, 255, 0}, kBlue{0, 0, 255}, kWhite{255, 255, 255};

}  // namespace fb::draw_test
