// Wireframe and boxes. viewAlongZ of 40 x 40 pixels maps 1 m of the plane z = -20 to 1 pixel.
#include <gtest/gtest.h>

#include "draw/draw_world.h"

namespace fb::draw_test {

// A square of 30 x 30 pixels, its diagonal from lower left to upper right. In the row at y = 0.5 m an edge
// darkens the pixel at each side (0.5 pixels away), the one on the diagonal and its two neighbours (0.71
// pixels away).
TEST_F(DrawTest, DarkensTheEdgesOfTrianglesAndNothingElse) {
    World world;
    world.add(colouredRectangle(-15, -15, 15, 15, -20, kRed));
    world.uploadAll(*renderer);
    const View view = viewAlongZ({}, 40, 40);
    const std::string plain(30, 'r'), outside(5, '.');
    EXPECT_EQ(row(picture(world, view), 19, {{'r', kRed}}), outside + plain + outside);
    settings.wireframe = true;
    const Image image = picture(world, view);
    EXPECT_EQ(row(image, 19, {{'r', kRed}}),
              outside + "." + std::string(13, 'r') + "..." + std::string(12, 'r') + "." + outside);
    EXPECT_EQ(row(image, 5, {{'r', kRed}}), std::string(40, '.'));
    // 0.85 of (0.03, 0.04, 0.07) over 0.15 of red.
    EXPECT_NEAR(pixel(image, 20, 19)[0], 44.75, 1.0);
    EXPECT_NEAR(pixel(image, 20, 19)[1], 8.7, 1.0);
    EXPECT_NEAR(pixel(image, 20, 19)[2], 15.2, 1.0);
    EXPECT_EQ(counters.triangles, 2u);
    EXPECT_EQ(counters.multiDraws, 2u);
}

// The far wall's diagonal x = y passes behind the near wall, whose own diagonal is x = -y.
TEST_F(DrawTest, HidesEdgesBehindSurfaces) {
    World world;
    world.add(colouredRectangle(-15, -15, 15, 15, -20, kRed));
    DecodedNode near;
    addQuad(near, {glm::vec3{4, -4, -10}, {4, 4, -10}, {-4, 4, -10}, {-4, -4, -10}},
            kGreen);  // 16 x 16 pixels
    world.add(std::move(near));
    world.uploadAll(*renderer);
    settings.wireframe = true;
    const Image image = picture(world, viewAlongZ({}, 40, 40));
    for (int i = 3; i <= 6; ++i) {
        EXPECT_EQ(pixel(image, 20 + i, 19 - i), kGreen) << i;
        EXPECT_NE(pixel(image, 20 + i, 20 + i), kGreen) << i;  // its own
    }
}

// Where indices start in a page must not matter: odd numbers of vertices and triangles before.
TEST_F(DrawTest, FindsTheCornersOfEveryNodeOfAPage) {
    World world;
    for (int i = 0; i < 4; ++i) {
        DecodedNode node;
        const auto x = static_cast<float>(i * 8 - 16);
        addTriangle(node, {glm::vec3{x, -16, -20}, {x + 7, -16, -20}, {x, 16, -20}}, kRed);
        if (i % 2 == 0) addTriangle(node, {glm::vec3{x, 17, -20}, {x + 7, 17, -20}, {x, 19, -20}}, kGreen);
        for (int extra = 0; extra < i; ++extra) node.vertices.push_back(node.vertices[0]);
        world.add(std::move(node));
    }
    world.uploadAll(*renderer);
    settings.wireframe = true;
    const Image image = picture(world, viewAlongZ({}, 40, 40));
    // At y = -10.5 a triangle is 7 * 26.5 / 32 = 5.8 m wide: pixel centres at 0.5 and 5.5 are on an edge, 1.5
    // to 4.5 are more than 1.1 pixels away from both.
    for (int i = 0; i < 4; ++i) {
        const std::string text = row(image, 30, {{'r', kRed}}).substr(static_cast<std::size_t>(4 + i * 8), 8);
        EXPECT_EQ(text, ".rrrr...") << i;
    }
}

// A box from (-10.5, -10.5, -25) to (10.5, 10.5, -20) whose front is a wall: of the box, the outline of the
// front shows.
TEST_F(DrawTest, OutlinesTheBoundsOfANodeInTheColourOfItsLevel) {
    World world;
    DecodedNode node = colouredRectangle(-10.5f, -10.5f, 10.5f, 10.5f, -20, kRed);
    addTriangle(node, {glm::vec3{-1, -1, -21}, {1, -1, -21}, {0, 0, -25}}, kGreen);
    world.add(std::move(node), {}, 3);
    world.uploadAll(*renderer);
    const View view = viewAlongZ({}, 40, 40);
    const Rgb level{0, 158, 115};  // 0.000, 0.620, 0.451
    EXPECT_EQ(count(picture(world, view), level), 0);
    settings.boxes = true;
    const Image image = picture(world, view);
    // Column 9 is x = -10.5, column 30 is x = 10.5.
    EXPECT_EQ(row(image, 19, {{'r', kRed}, {'b', level}}),
              std::string(9, '.') + "b" + std::string(20, 'r') + "b" + std::string(9, '.'));
    EXPECT_EQ(row(image, 9, {{'b', level}}).substr(10, 20), std::string(20, 'b'));
    EXPECT_EQ(row(image, 30, {{'b', level}}).substr(10, 20), std::string(20, 'b'));
}

// Without a wall all twelve edges show. From (0, 0, 0) along -z, half sides of 10.5 at depth 20 and 10.5 * 20
// / 28 = 7.5 at depth 28: two squares and four lines between their corners.
TEST_F(DrawTest, DrawsAllTwelveEdgesOfABox) {
    World world;
    DecodedNode node;
    addTriangle(node, {glm::vec3{-10.5f, -10.5f, -20}, {-10.5f, -10.5f, -20}, {-10.5f, -10.5f, -20}}, kRed);
    addTriangle(node, {glm::vec3{10.5f, 10.5f, -28}, {10.5f, 10.5f, -28}, {10.5f, 10.5f, -28}}, kRed);
    world.add(std::move(node), {}, 3);
    world.uploadAll(*renderer);
    settings.boxes = true;
    const Image image = picture(world, viewAlongZ({}, 40, 40));
    const Rgb level{0, 158, 115};
    const std::string middle = row(image, 19, {{'b', level}});
    EXPECT_EQ(middle, std::string(9, '.') + "b..b" + std::string(14, '.') + "b..b" + std::string(9, '.'));
    EXPECT_EQ(row(image, 12, {{'b', level}}).substr(13, 14), std::string(14, 'b'));  // y = 7.5
    EXPECT_EQ(row(image, 9, {{'b', level}}).substr(10, 20), std::string(20, 'b'));   // y = 10.5
    // Between the corners (9, 9) and (12, 12) of the squares.
    for (const auto& [x, y] : {std::pair{11, 11}, {28, 11}, {11, 28}, {28, 28}})
        EXPECT_EQ(pixel(image, x, y), level);
}

}  // namespace fb::draw_test
