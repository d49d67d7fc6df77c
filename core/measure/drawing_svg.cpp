#include <array>
#include <cmath>
#include <cstdio>

#include "measure/drawing.h"
#include "measure/number_text.h"

namespace fb {
namespace {

std::string escaped(std::string_view text) {
    std::string safe;
    for (char c : text) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return safe;
}

// Hundredths of a pixel are enough and keep files small.
std::string pixels(double value) {
    std::string text = fixedText(std::round(value * 100.0) / 100.0, 2);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string colourText(Rgb c) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", c.r, c.g, c.b);
    return text.data();
}

std::string pointList(const std::vector<glm::dvec2>& points) {
    std::string list;
    for (const glm::dvec2& p : points) list += (list.empty() ? "" : " ") + pixels(p.x) + "," + pixels(p.y);
    return list;
}

struct SvgWriter {
    std::string& svg;

    void operator()(const DrawnLine& line) const {
        svg += "<polyline fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke=\"" +
               colourText(line.colour) + "\" stroke-width=\"" + pixels(line.width) + "\" points=\"" +
               pointList(line.points) + "\"/>\n";
    }
    void operator()(const DrawnShape& shape) const {
        svg += "<polygon fill=\"" + colourText(shape.colour) + "\" points=\"" + pointList(shape.points) +
               "\"/>\n";
    }
    void operator()(const DrawnText& text) const {
        static constexpr std::array<std::string_view, 3> kAnchors = {"start", "middle", "end"};
        svg += "<text fill=\"" + colourText(text.colour) + "\" font-size=\"" + pixels(text.size) +
               "\" text-anchor=\"" + std::string(kAnchors[static_cast<std::size_t>(text.anchor)]) + "\"";
        if (text.bold) svg += " font-weight=\"bold\"";
        const std::string x = pixels(text.at.x), y = pixels(text.at.y);
        svg += text.upward ? " transform=\"translate(" + x + " " + y + ") rotate(-90)\""
                           : " x=\"" + x + "\" y=\"" + y + "\"";
        svg += ">" + escaped(text.text) + "</text>\n";
    }
};

}  // namespace

std::string drawingSvg(const Drawing& drawing, std::string_view title) {
    const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
    std::string svg =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
        width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
        "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<title>" + escaped(title) +
        "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const DrawnItem& item : drawing.items) std::visit(SvgWriter{svg}, item);
    return svg + "</svg>\n";
}

}  // namespace fb
