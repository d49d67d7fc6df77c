// A picture as lines, filled shapes and text, in pixels from the top left corner; and its two writers. A
// laid-out figure (figure.h) comes in; an SVG text or the pixels of a PNG go out.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"
#include "import/source_scene.h"
#include "measure/plot_colours.h"

namespace fb {

struct DrawnLine {
    std::vector<glm::dvec2> points;  // open polyline with round ends
    Rgb colour;
    double width = 1.0;
};

struct DrawnShape {
    std::vector<glm::dvec2> points;  // closed polygon, filled where it winds around (nonzero)
    Rgb colour;
};

enum class TextAnchor : std::uint8_t { start, middle, end };

struct DrawnText {
    glm::dvec2 at;     // on the baseline
    std::string text;  // UTF-8
    double size = 12.0;
    TextAnchor anchor = TextAnchor::start;
    Rgb colour = kInk;
    bool bold = false;
    bool upward = false;  // turned a quarter to the left: read from bottom to top
};

using DrawnItem = std::variant<DrawnLine, DrawnShape, DrawnText>;

struct Drawing {
    int width = 0, height = 0;
    std::vector<DrawnItem> items;  // later ones cover earlier ones; the ground is white
};

// Width in pixels as DejaVu Sans has it, within a few percent for Latin text: for the layout, whatever fonts
// there are.
[[nodiscard]] double textWidth(std::string_view text, double size, bool bold = false);

// A complete SVG document; `title` is what a screen reader says.
[[nodiscard]] std::string drawingSvg(const Drawing& drawing, std::string_view title);

// RGB, anti-aliased. Text is reduced to ASCII (see asciiText) and set in DejaVu Sans where installed, else in
// any TrueType font found under /usr/share/fonts; without any the picture has no words (the SVG has).
[[nodiscard]] Image rasterise(const Drawing& drawing);

// The picture (grey, RGB or RGBA) as a PNG file's bytes.
[[nodiscard]] Result<std::vector<std::uint8_t>> pngBytes(const Image& image);

}  // namespace fb
