#include <array>
#include <bit>
#include <cmath>

#include "import/first_appearance.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/parse_text.h"

namespace fb {
namespace {

// [ST][C][N]OFF: which attributes stand behind the coordinates of a vertex, in the order normal, colour,
// texture.
struct Layout {
    bool uvs = false, colours = false, normals = false;
    [[nodiscard]] std::size_t numbersBeforeColour() const { return normals ? 6 : 3; }
};

// Colours are 0 to 255 as integers or 0 to 1 as reals; which, one cannot tell from one number such as 1.
struct Colour {
    glm::dvec4 value{0.0};
    bool present = false;
};

struct OffText {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<Colour> colours;  // one a vertex, or empty
    std::vector<std::uint32_t> corners;
    std::vector<std::uint64_t> firstCorner;  // one a face
    std::vector<Colour> faceColours;         // one a face
    bool coloursAreReal = false;
    bool facesAreColoured = false;
};

class OffParser {
  public:
    explicit OffParser(const MeshBytes& input)
        : input_(input), lines_(input.text()), bytesLeft_(input.bytes.size()) {}

    Result<OffText> parse() {
        std::string_view line;
        if (!takeLine(line)) return cutOff("the counts");
        if (Result<void> taken = takeKeyword(line); !taken) return passOn(taken);
        if (line.empty() && !takeLine(line)) return cutOff("the counts");
        std::array<std::uint64_t, 2> counts{};
        for (std::uint64_t& count : counts) {
            std::int64_t value = 0;
            const std::string_view word = takeWord(line);
            if (!toInteger(word, value) || value < 0) return wrong(inQuotes(word) + " is not a count");
            count = static_cast<std::uint64_t>(value);
        }
        // "0 0 0\n" and "0\n" are the shortest rows; the last one needs no line end.
        if (counts[0] > kMaxVertices || counts[0] > (bytesLeft_ + 1) / 6 ||
            counts[1] > (bytesLeft_ + 1) / 2) {
            return input_.failure(lines_.place(),
                                  "the header promises " + std::to_string(counts[0]) + " vertices and " +
                                      std::to_string(counts[1]) + " faces, more than the file can hold",
                                  "the file is cut off or damaged");
        }
        if (Result<void> taken = takeVertices(counts[0]); !taken) return passOn(taken);
        if (Result<void> taken = takeFaces(counts[1]); !taken) return passOn(taken);
        return std::move(text_);
    }

  private:
    [[nodiscard]] tl::unexpected<Error> wrong(std::string reason) const {
        return input_.failure(lines_.place(), std::move(reason));
    }
    [[nodiscard]] tl::unexpected<Error> cutOff(const std::string& what) const {
        return input_.failure(lines_.place(), "the file ends before " + what, "the file is cut off");
    }

    // The next line with something on it, without comment and blanks around it.
    bool takeLine(std::string_view& line) {
        while (lines_.next(line)) {
            bytesLeft_ -= std::min<std::size_t>(bytesLeft_, line.size());
            line = trimmed(line.substr(0, line.find('#')));
            if (!line.empty()) return true;
        }
        return false;
    }

    Result<void> takeKeyword(std::string_view& line) {
        std::string_view rest = line;
        std::string_view word = takeWord(rest);
        if (word.find_first_not_of("0123456789") == std::string_view::npos)
            return {};  // the keyword may be missing
        const std::string_view keyword = word;
        const auto strip = [&](std::string_view prefix) {
            const bool has = startsWith(word, prefix);
            if (has) word.remove_prefix(prefix.size());
            return has;
        };
        layout_.uvs = strip("ST");
        layout_.colours = strip("C");
        layout_.normals = strip("N");
        if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
            return wrong(inQuotes(keyword) + ": only three dimensions can be read");
        }
        if (word != "OFF") return wrong(inQuotes(keyword) + " stands where 'OFF' should");
        line = trimmed(rest);
        if (startsWith(line, "BINARY")) return wrong("binary OFF cannot be read: save it as text");
        return {};
    }

    Result<void> takeNumbers(std::string_view& line, double* into, std::size_t count,
                             const char* what) const {
        for (std::size_t i = 0; i < count; ++i) {
            const std::string_view word = takeWord(line);
            if (word.empty()) return wrong("a number of " + std::string(what) + " is missing");
            if (!toReal(word, into[i])) return wrong(inQuotes(word) + " in " + what + " is not a number");
        }
        return {};
    }

    Result<void> takeVertices(std::uint64_t count) {
        text_.positions.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            std::string_view line;
            if (!takeLine(line)) return cutOff("vertex " + std::to_string(i));
            std::array<double, 6> n{};
            if (Result<void> taken = takeNumbers(line, n.data(), layout_.numbersBeforeColour(), "a vertex");
                !taken) {
                return taken;
            }
            text_.positions.emplace_back(n[0], n[1], n[2]);
            if (layout_.normals) text_.normals.emplace_back(glm::dvec3(n[3], n[4], n[5]));
            if (layout_.colours) {
                Result<Colour> colour = takeColour(line, layout_.uvs ? 2 : 0);
                if (!colour) return passOn(colour);
                text_.colours.push_back(*colour);
            }
            if (layout_.uvs) {
                std::array<double, 2> uv{};
                if (Result<void> taken = takeNumbers(line, uv.data(), 2, "a texture coordinate"); !taken)
                    return taken;
                text_.uvs.emplace_back(glm::dvec2(uv[0], 1.0 - uv[1]));
            }
        }
        return {};
    }

    // 3 or 4 numbers; 1 (an index into a table that is not in the file) and 0 are no colour. `behind`: how
    // many numbers follow the colour.
    Result<Colour> takeColour(std::string_view& line, std::size_t behind) {
        std::size_t words = 0;
        for (std::string_view ahead = line; !takeWord(ahead).empty();) ++words;
        Colour colour;
        if (words < 3 + behind) return colour;
        const std::size_t count = std::min<std::size_t>(words - behind, 4);
        colour.value.w = -1.0;  // opaque, whatever the scale
        for (std::size_t i = 0; i < count; ++i) {
            const std::string_view word = takeWord(line);
            double value = 0.0;
            if (!toReal(word, value)) return wrong(inQuotes(word) + ", a colour, is not a number");
            colour.value[static_cast<int>(i)] = value;
            if (word.find_first_of(".eE") != std::string_view::npos) text_.coloursAreReal = true;
        }
        colour.present = true;
        return colour;
    }

    Result<void> takeFaces(std::uint64_t count) {
        text_.firstCorner.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            std::string_view line;
            if (!takeLine(line)) return cutOff("face " + std::to_string(i));
            std::int64_t corners = 0;
            const std::string_view word = takeWord(line);
            if (!toInteger(word, corners) || corners < 0)
                return wrong(inQuotes(word) + " is not a number of corners");
            text_.firstCorner.push_back(text_.corners.size());
            for (std::int64_t c = 0; c < corners; ++c) {
                const std::string_view index = takeWord(line);
                std::int64_t vertex = -1;
                if (index.empty()) return wrong("the face has fewer corners than it says");
                if (!toInteger(index, vertex) || vertex < 0 ||
                    vertex >= static_cast<std::int64_t>(text_.positions.size())) {
                    return wrong("the face refers to vertex " + inQuotes(index) + " of " +
                                 std::to_string(text_.positions.size()));
                }
                text_.corners.push_back(static_cast<std::uint32_t>(vertex));
            }
            Result<Colour> colour = takeColour(line, 0);
            if (!colour) return passOn(colour);
            text_.facesAreColoured = text_.facesAreColoured || colour->present;
            text_.faceColours.push_back(*colour);
        }
        return {};
    }

    const MeshBytes& input_;
    TextLines lines_;
    std::size_t bytesLeft_;
    Layout layout_;
    OffText text_;
};

glm::u8vec4 toBytes(const Colour& colour, bool isReal) {
    if (!colour.present) return glm::u8vec4(255);
    const double scale = isReal ? 1.0 : 1.0 / 255.0;
    const glm::dvec4 v = colour.value;
    return {toByte(v.x * scale), toByte(v.y * scale), toByte(v.z * scale),
            v.w < 0.0 ? std::uint8_t{255} : toByte(v.w * scale)};
}

}  // namespace

Result<MeshFile> readOff(const MeshBytes& input, ImportReport& report) {
    Result<OffText> parsed = OffParser(input).parse();
    if (!parsed) return passOn(parsed);
    const OffText& text = *parsed;
    MeshFile file;
    SourceMesh& mesh = file.block.mesh;
    // A vertex in faces of different colours becomes several.
    FirstAppearance<2> numbers(text.positions.size());
    std::vector<std::uint32_t> corners;
    for (std::size_t f = 0; f < text.firstCorner.size(); ++f) {
        const std::uint64_t end =
            f + 1 < text.firstCorner.size() ? text.firstCorner[f + 1] : text.corners.size();
        const glm::u8vec4 faceColour = toBytes(text.faceColours[f], text.coloursAreReal);
        corners.clear();
        for (std::uint64_t c = text.firstCorner[f]; c < end; ++c) {
            const std::uint32_t vertex = text.corners[c];
            const bool ownColour = text.faceColours[f].present || text.colours.empty();
            const glm::u8vec4 colour =
                ownColour ? faceColour : toBytes(text.colours[vertex], text.coloursAreReal);
            const std::uint32_t number = numbers.numberOf({vertex, std::bit_cast<std::uint32_t>(colour)});
            corners.push_back(number);
            if (number < mesh.positions.size()) continue;
            mesh.positions.push_back(text.positions[vertex]);
            if (!text.normals.empty()) mesh.normals.push_back(text.normals[vertex]);
            if (!text.uvs.empty()) mesh.uvs.push_back(text.uvs[vertex]);
            if (!text.colours.empty() || text.facesAreColoured) mesh.colours.push_back(colour);
        }
        addPolygon(file, corners, kNoMaterial, 0, report);
    }
    file.groups.clear();
    return file;
}

}  // namespace fb
