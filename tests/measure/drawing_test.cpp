#include "measure/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "xml_checker.h"

namespace fb {
namespace {

Rgb pixelOf(const Image& image, int x, int y) {
    const std::uint8_t* p = &image.pixels[3 * std::size_t(y * image.width + x)];
    return {p[0], p[1], p[2]};
}

TEST(XmlChecker, FindsWhatIsNotWellFormed) {
    EXPECT_EQ(test::faultInXml("<a b=\"1\"><c/>x &amp; y</a>\n"), "");
    for (const char* bad :
         {"", "x", "<a>", "<a></b>", "<a/><b/>", "<a b=1/>", "<a b=\"1/>", "<a>&</a>", "<a>&nbsp;</a>",
          "<a>></a>", "<a b=\"<\"/>", "<a", "<a>\x01</a>", "<a b=\"1\"c=\"2\"/>"}) {
        EXPECT_NE(test::faultInXml(bad), "") << bad;
    }
}

TEST(DrawingSvg, IsWellFormedWhateverTheWords) {
    Drawing drawing{100, 50, {}};
    drawing.items.emplace_back(DrawnLine{{{1, 2}, {3, 4.5}}, kBlue, 1.5});
    drawing.items.emplace_back(DrawnShape{{{0, 0}, {5, 0}, {5, 5}}, kOrange});
    drawing.items.emplace_back(
        DrawnText{{10, 20}, "a<b & \"c\" > d\x02 Z\xc3\xbcrich", 12, TextAnchor::end, kInk, true, true});
    const std::string svg = drawingSvg(drawing, "5 < 6 & \"7\"");
    EXPECT_EQ(test::faultInXml(svg), "");
    EXPECT_NE(svg.find("<title>5 &lt; 6 &amp; &quot;7&quot;</title>"), std::string::npos);
    EXPECT_NE(svg.find("a&lt;b &amp; &quot;c&quot; &gt; d  Z\xc3\xbcrich</text>"), std::string::npos);
    EXPECT_NE(svg.find("width=\"100\" height=\"50\""), std::string::npos);
}

TEST(DrawingSvg, WritesPointsToTheHundredthOfAPixel) {
    Drawing drawing{10, 10, {DrawnLine{{{1, 2}, {3.14159, -0.001}}, Rgb{0, 15, 255}, 1.5}}};
    const std::string svg = drawingSvg(drawing, "");
    EXPECT_NE(svg.find("stroke=\"#000fff\" stroke-width=\"1.5\" points=\"1,2 3.14,0\""), std::string::npos)
        << svg;
}

TEST(Rasterise, IsWhiteWhereNothingIsDrawn) {
    const Image image = rasterise({7, 5, {}});
    EXPECT_EQ(image.width, 7);
    EXPECT_EQ(image.height, 5);
    EXPECT_EQ(image.pixels, std::vector<std::uint8_t>(7 * 5 * 3, 255));
}

// A rectangle from 2 to 5.5 and 1 to 3.2: whole pixels, a half, a fifth and a tenth of black on white.
TEST(Rasterise, FillsShapesByTheCoveredPart) {
    const Image image =
        rasterise({10, 6, {DrawnShape{{{2, 1}, {5.5, 1}, {5.5, 3.2}, {2, 3.2}}, Rgb{0, 0, 0}}}});
    const auto grey = [&](int x, int y) { return int(pixelOf(image, x, y).g); };
    EXPECT_EQ(grey(1, 1), 255);
    EXPECT_EQ(grey(2, 1), 0);
    EXPECT_EQ(grey(4, 2), 0);
    EXPECT_NEAR(grey(5, 1), 255 * 0.5, 1);
    EXPECT_NEAR(grey(3, 3), 255 * 0.8, 1);
    EXPECT_NEAR(grey(5, 3), 255 * 0.9, 1);
    EXPECT_EQ(grey(6, 1), 255);
    EXPECT_EQ(grey(3, 0), 255);
    EXPECT_EQ(grey(3, 4), 255);
}

TEST(Rasterise, FillsAShapeTheSameWhicheverWayRound) {
    const std::vector<glm::dvec2> points = {{1, 1}, {8, 2}, {6.5, 7}, {2, 6}};
    std::vector<glm::dvec2> reversed(points.rbegin(), points.rend());
    EXPECT_EQ(rasterise({10, 10, {DrawnShape{points, kBlue}}}).pixels,
              rasterise({10, 10, {DrawnShape{reversed, kBlue}}}).pixels);
}

TEST(Rasterise, DrawsALineOnePixelWideSharply) {
    const Image image = rasterise({10, 5, {DrawnLine{{{2.5, 2.5}, {7.5, 2.5}}, Rgb{0, 0, 0}, 1.0}}});
    for (int x = 2; x <= 7; ++x) {
        EXPECT_EQ(pixelOf(image, x, 2), (Rgb{0, 0, 0})) << x;
        EXPECT_EQ(pixelOf(image, x, 1), kWhite) << x;
        EXPECT_EQ(pixelOf(image, x, 3), kWhite) << x;
    }
    EXPECT_EQ(pixelOf(image, 0, 2), kWhite);
    EXPECT_EQ(pixelOf(image, 9, 2), kWhite);
}

TEST(Rasterise, DrawsLaterItemsOverEarlierOnes) {
    const DrawnShape below{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, kBlue},
        above{{{0, 0}, {2, 0}, {2, 4}, {0, 4}}, kOrange};
    const Image image = rasterise({4, 4, {below, above}});
    EXPECT_EQ(pixelOf(image, 1, 1), kOrange);
    EXPECT_EQ(pixelOf(image, 3, 1), kBlue);
}

TEST(Rasterise, TakesItemsBeyondThePicture) {
    const Image image =
        rasterise({4,
                   4,
                   {DrawnLine{{{-50, 2.5}, {50, 2.5}}, kBlue, 1.0},
                    DrawnShape{{{-9, -9}, {9, -9}, {9, 1}, {-9, 1}}, kOrange},
                    DrawnText{{-20, 90}, "beyond", 12, TextAnchor::start, kInk, false, false}}});
    EXPECT_EQ(pixelOf(image, 3, 2), kBlue);
    EXPECT_EQ(pixelOf(image, 0, 0), kOrange);
}

// Columns and rows with ink, half-open.
struct Ink {
    int left = 1000, top = 1000, right = 0, bottom = 0;
};
Ink inkOf(const Image& image) {
    Ink ink;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (pixelOf(image, x, y) == kWhite) continue;
            ink = {std::min(ink.left, x), std::min(ink.top, y), std::max(ink.right, x + 1),
                   std::max(ink.bottom, y + 1)};
        }
    }
    return ink;
}

Image textImage(TextAnchor anchor, bool upward, const std::string& words = "Hill") {
    return rasterise({120, 120, {DrawnText{{60, 60}, words, 20, anchor, kInk, false, upward}}});
}

TEST(Rasterise, SetsTextOnItsBaselineByItsAnchor) {
    if (inkOf(textImage(TextAnchor::start, false)).right == 0) GTEST_SKIP() << "no font installed";
    const Ink start = inkOf(textImage(TextAnchor::start, false)),
              end = inkOf(textImage(TextAnchor::end, false));
    const Ink middle = inkOf(textImage(TextAnchor::middle, false));
    EXPECT_NEAR(start.bottom, 60, 1);  // "Hill" has nothing below the baseline
    EXPECT_NEAR(start.bottom - start.top, 15, 3);
    EXPECT_NEAR(start.left, 62, 2);
    EXPECT_NEAR(end.right, 59, 2);
    EXPECT_NEAR((middle.left + middle.right) / 2.0, 60, 2);
    EXPECT_NEAR(start.right - start.left, textWidth("Hill", 20), 8);
}

TEST(Rasterise, TurnsTextUpward) {
    if (inkOf(textImage(TextAnchor::start, false)).right == 0) GTEST_SKIP() << "no font installed";
    const Ink level = inkOf(textImage(TextAnchor::start, false)),
              up = inkOf(textImage(TextAnchor::start, true));
    EXPECT_EQ(up.right - up.left, level.bottom - level.top);
    EXPECT_EQ(up.bottom - up.top, level.right - level.left);
    EXPECT_NEAR(up.right, 60, 2);  // the baseline is to the right
    EXPECT_LE(up.bottom, 61);      // and it reads upward from its start
}

TEST(Rasterise, DropsAccentsThatTheTextLibraryGarbles) {
    EXPECT_EQ(textImage(TextAnchor::start, false, "Z\xc3\xbcrich").pixels,
              textImage(TextAnchor::start, false, "Zurich").pixels);
    EXPECT_EQ(textImage(TextAnchor::start, false, "\xe2\x82\xac 5").pixels,
              textImage(TextAnchor::start, false, "? 5").pixels);
}

TEST(PngBytes, RefusesAPictureWithoutPixels) {
    EXPECT_FALSE(pngBytes(Image{}).has_value());
    EXPECT_FALSE(pngBytes(Image{2, 2, 3, std::vector<std::uint8_t>(11), true}).has_value());
}

TEST(PlotColours, TellLevelsApart) {
    for (int a = 0; a < 14; ++a) {
        for (int b = 0; b < a; ++b) EXPECT_FALSE(levelPlotColour(a) == levelPlotColour(b)) << a << " " << b;
    }
}

}  // namespace
}  // namespace fb
