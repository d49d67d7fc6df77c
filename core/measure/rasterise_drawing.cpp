// Drawing -> pixels. Lines by the distance of pixel centres to their segments, shapes by exact horizontal
// coverage on five scan lines a pixel, text by FreeType through OpenImageIO.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "measure/drawing.h"

namespace fb {
namespace {

// How much of each pixel is covered, and where that is not 0.
struct Mask {
    int width, height;
    std::vector<float> cover;
    int x0, y0, x1, y1;  // touched: [x0, x1) x [y0, y1)

    Mask(int w, int h)
        : width(w), height(h), cover(std::size_t(w) * std::size_t(h), 0.0f), x0(w), y0(h), x1(0), y1(0) {}

    [[nodiscard]] float& at(int x, int y) {
        return cover[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
    void touch(int left, int top, int right, int bottom) {
        x0 = std::min(x0, left);
        y0 = std::min(y0, top);
        x1 = std::max(x1, right);
        y1 = std::max(y1, bottom);
    }
};

// Paints the colour through the mask and clears it.
void paint(Image& image, Mask& mask, Rgb colour) {
    const std::uint8_t parts[3] = {colour.r, colour.g, colour.b};
    for (int y = mask.y0; y < mask.y1; ++y) {
        for (int x = mask.x0; x < mask.x1; ++x) {
            float& cover = mask.at(x, y);
            if (cover > 0.0f) {
                std::uint8_t* pixel =
                    &image.pixels[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
                const float a = std::min(1.0f, cover);
                for (int c = 0; c < 3; ++c) {
                    const float mixed =
                        static_cast<float>(pixel[c]) * (1.0f - a) + static_cast<float>(parts[c]) * a;
                    pixel[c] = static_cast<std::uint8_t>(mixed + 0.5f);
                }
            }
            cover = 0.0f;
        }
    }
    mask.x0 = mask.width;
    mask.y0 = mask.height;
    mask.x1 = mask.y1 = 0;
}

void coverSegment(Mask& mask, glm::dvec2 a, glm::dvec2 b, double width) {
    const double reach = width / 2.0 + 0.5;
    const int left = std::max(0, static_cast<int>(std::floor(std::min(a.x, b.x) - reach)));
    const int right = std::min(mask.width, static_cast<int>(std::ceil(std::max(a.x, b.x) + reach)) + 1);
    const int top = std::max(0, static_cast<int>(std::floor(std::min(a.y, b.y) - reach)));
    const int bottom = std::min(mask.height, static_cast<int>(std::ceil(std::max(a.y, b.y) + reach)) + 1);
    if (left >= right || top >= bottom) return;
    mask.touch(left, top, right, bottom);
    const glm::dvec2 way = b - a;
    const double squared = glm::dot(way, way);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            const double along = squared > 0.0 ? std::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0.0;
            const float cover =
                static_cast<float>(std::clamp(reach - glm::length(p - a - way * along), 0.0, 1.0));
            mask.at(x, y) = std::max(mask.at(x, y), cover);
        }
    }
}

constexpr int kScanLines = 5;  // a pixel

struct Crossing {
    double x;
    int winding;
};

void coverSpan(Mask& mask, int y, double from, double to) {
    from = std::clamp(from, 0.0, static_cast<double>(mask.width));
    to = std::clamp(to, 0.0, static_cast<double>(mask.width));
    for (int x = static_cast<int>(from); x < to; ++x) {
        const double covered = std::min(to, x + 1.0) - std::max(from, static_cast<double>(x));
        mask.at(x, y) += static_cast<float>(covered / kScanLines);
    }
}

void coverShape(Mask& mask, const std::vector<glm::dvec2>& points) {
    std::vector<std::vector<Crossing>> lines(std::size_t(mask.height) * kScanLines);
    for (std::size_t i = 0; i < points.size(); ++i) {
        glm::dvec2 a = points[i], b = points[(i + 1) % points.size()];
        const int winding = a.y < b.y ? 1 : -1;
        if (winding < 0) std::swap(a, b);
        // Scan line k lies at (k + 1/2) / kScanLines.
        const double first = std::max(0.0, std::ceil(a.y * kScanLines - 0.5));
        const double last = std::min(static_cast<double>(lines.size()), std::ceil(b.y * kScanLines - 0.5));
        for (double k = first; k < last; ++k) {
            const double y = (k + 0.5) / kScanLines;
            lines[static_cast<std::size_t>(k)].push_back(
                {a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), winding});
        }
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (lines[k].empty()) continue;
        std::ranges::sort(lines[k], {}, &Crossing::x);
        const int y = static_cast<int>(k) / kScanLines;
        int winding = 0;
        for (std::size_t i = 0; i + 1 < lines[k].size(); ++i) {
            winding += lines[k][i].winding;
            if (winding != 0) coverSpan(mask, y, lines[k][i].x, lines[k][i + 1].x);
        }
        mask.touch(0, y, mask.width, y + 1);
    }
}

struct Fonts {
    std::string regular, bold;  // paths; empty where there is none
};

Fonts findFonts() {
    const std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";
    std::error_code problem;
    Fonts fonts;
    if (std::filesystem::exists(dejavu / "DejaVuSans.ttf", problem)) {
        fonts.regular = (dejavu / "DejaVuSans.ttf").string();
        fonts.bold = std::filesystem::exists(dejavu / "DejaVuSans-Bold.ttf", problem)
                         ? (dejavu / "DejaVuSans-Bold.ttf").string()
                         : fonts.regular;
        return fonts;
    }
    // The first of the others by name, upright ones without serifs before the rest.
    std::string best;
    for (auto it = std::filesystem::recursive_directory_iterator("/usr/share/fonts", problem);
         !problem && it != std::filesystem::recursive_directory_iterator(); it.increment(problem)) {
        if (it->path().extension() != ".ttf") continue;
        const std::string name = it->path().filename().string();
        const bool plain =
            name.find("Sans") != std::string::npos && name.find("Regular") != std::string::npos;
        const std::string ranked = (plain ? "0" : "1") + it->path().string();
        if (best.empty() || ranked < best) best = ranked;
    }
    if (!best.empty()) fonts.regular = fonts.bold = best.substr(1);
    return fonts;
}

// OpenImageIO 2.4 decodes UTF-8 wrongly (U+00FC comes out as U+003C): accents are dropped, and what is not
// Latin is a question mark. The SVG has the text as it is.
std::string asciiText(std::string_view text) {
    static constexpr std::string_view kLatin1 =  // from U+00C0 on
        "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
    std::string ascii;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x80) ascii += byte < 0x20 ? ' ' : text[i];
        if (byte < 0xc0) continue;
        const unsigned next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) & 0x3fu : 0u;
        ascii += byte == 0xc3 ? kLatin1[next] : '?';
    }
    return ascii;
}

void coverText(Mask& mask, const DrawnText& text, const Fonts& fonts) {
    const std::string& font = text.bold ? fonts.bold : fonts.regular;
    const std::string ascii = asciiText(text.text);
    const int size = static_cast<int>(std::lround(text.size));
    if (font.empty() || ascii.empty()) return;
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(ascii, size, font);
    if (!box.defined() || box.width() <= 0 || box.height() <= 0) return;

    OIIO::ImageBuf words(OIIO::ImageSpec(box.width() + 2, box.height() + 2, 1, OIIO::TypeDesc::FLOAT));
    OIIO::ImageBufAlgo::zero(words, {}, 1);
    const int originX = 1 - box.xbegin, originY = 1 - box.ybegin;  // of the baseline's start
    const float white = 1.0f;
    OIIO::ImageBufAlgo::render_text(words, originX, originY, ascii, size, font, OIIO::cspan<float>(&white, 1),
                                    OIIO::ImageBufAlgo::TextAlignX::Left,
                                    OIIO::ImageBufAlgo::TextAlignY::Baseline, 0, {}, 1);
    const double shift = text.anchor == TextAnchor::start    ? 0.0
                         : text.anchor == TextAnchor::middle ? 0.5
                                                             : 1.0;
    const int back = static_cast<int>(std::lround(shift * box.xend));
    const int atX = static_cast<int>(std::lround(text.at.x)), atY = static_cast<int>(std::lround(text.at.y));
    for (int v = 0; v < box.height() + 2; ++v) {
        for (int u = 0; u < box.width() + 2; ++u) {
            const float cover = words.getchannel(u, v, 0, 0);
            const int along = u - originX - back, down = v - originY;
            const int x = text.upward ? atX + down : atX + along, y = text.upward ? atY - along : atY + down;
            if (cover <= 0.0f || x < 0 || y < 0 || x >= mask.width || y >= mask.height) continue;
            mask.at(x, y) = cover;
            mask.touch(x, y, x + 1, y + 1);
        }
    }
}

struct Rasteriser {
    Image& image;
    Mask& mask;
    const Fonts& fonts;

    void operator()(const DrawnLine& line) const {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            coverSegment(mask, line.points[i - 1], line.points[i], line.width);
        }
        paint(image, mask, line.colour);
    }
    void operator()(const DrawnShape& shape) const {
        coverShape(mask, shape.points);
        paint(image, mask, shape.colour);
    }
    void operator()(const DrawnText& text) const {
        coverText(mask, text, fonts);
        paint(image, mask, text.colour);
    }
};

}  // namespace

double textWidth(std::string_view text, double size, bool bold) {
    double em = 0.0;
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) {
            em += byte >= 0xc0 ? 0.8 : 0.0;  // the first byte of a character stands for it
        } else if (std::string_view("ijlI|'").find(c) != std::string_view::npos) {
            em += 0.29;
        } else if (std::string_view("frt .,:;()[]/-!").find(c) != std::string_view::npos) {
            em += 0.37;
        } else if (std::string_view("mwMW%@").find(c) != std::string_view::npos) {
            em += 0.93;
        } else {
            em += c >= 'A' && c <= 'Z' ? 0.69 : 0.61;
        }
    }
    return em * size * (bold ? 1.1 : 1.0);
}

Image rasterise(const Drawing& drawing) {
    Image image{drawing.width, drawing.height, 3, {}, true};
    image.pixels.assign(3 * std::size_t(drawing.width) * std::size_t(drawing.height), 255);
    Mask mask(drawing.width, drawing.height);
    const Fonts fonts = findFonts();
    for (const DrawnItem& item : drawing.items) std::visit(Rasteriser{image, mask, fonts}, item);
    return image;
}

}  // namespace fb
