#include "import/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "import/parse_text.h"

namespace fb {
namespace {

constexpr std::size_t kMaxHeaderLines = 10000;

bool typeOf(std::string_view word, PlyType& type) {
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{{{"char", PlyType::int8},
                                                                           {"int8", PlyType::int8},
                                                                           {"uchar", PlyType::uint8},
                                                                           {"uint8", PlyType::uint8},
                                                                           {"short", PlyType::int16},
                                                                           {"int16", PlyType::int16},
                                                                           {"ushort", PlyType::uint16},
                                                                           {"uint16", PlyType::uint16},
                                                                           {"int", PlyType::int32},
                                                                           {"int32", PlyType::int32},
                                                                           {"uint", PlyType::uint32},
                                                                           {"uint32", PlyType::uint32},
                                                                           {"float", PlyType::float32},
                                                                           {"float32", PlyType::float32},
                                                                           {"double", PlyType::float64},
                                                                           {"float64", PlyType::float64}}};
    const auto* const found =
        std::find_if(kNames.begin(), kNames.end(), [&](const auto& name) { return name.first == word; });
    if (found == kNames.end()) return false;
    type = found->second;
    return true;
}

class HeaderParser {
  public:
    explicit HeaderParser(const MeshBytes& input) : input_(input), rest_(input.text()) {}

    Result<PlyHeader> parse() {
        bool hasFormat = false;
        while (true) {
            std::string_view line;
            if (!takeLine(line)) return wrong("the file ends inside the header: it is cut off or not PLY");
            if (header_.lines > kMaxHeaderLines) return wrong("the header does not end");
            const std::string_view word = takeWord(line);
            if (header_.lines == 1) {
                if (word != "ply") return wrong("a PLY file begins with the word 'ply'");
            } else if (word == "format") {
                if (Result<void> taken = takeFormat(line); !taken) return passOn(taken);
                hasFormat = true;
            } else if (word == "element") {
                if (Result<void> taken = takeElement(line); !taken) return passOn(taken);
            } else if (word == "property") {
                if (Result<void> taken = takeProperty(line); !taken) return passOn(taken);
            } else if (word == "comment") {
                if (lowerCase(takeWord(line)) == "texturefile")
                    header_.textureFiles.emplace_back(trimmed(line));
            } else if (word == "end_header") {
                break;
            } else if (!word.empty() && word != "obj_info") {
                return wrong(inQuotes(word) + " has no meaning in a PLY header");
            }
        }
        if (!hasFormat) return wrong("the header names no format");
        header_.bodyOffset = static_cast<std::size_t>(rest_.data() - input_.text().data());
        return std::move(header_);
    }

  private:
    // Lines end with LF, CR LF or CR, all as the first one does: what follows the last one may be binary.
    bool takeLine(std::string_view& line) {
        const std::size_t end = rest_.find_first_of("\r\n");
        if (end == std::string_view::npos) return false;
        line = rest_.substr(0, end);
        const bool isPair = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
        if (header_.lines == 0) endsWithPair_ = isPair;
        rest_.remove_prefix(end + (isPair && endsWithPair_ ? 2 : 1));
        ++header_.lines;
        return true;
    }

    [[nodiscard]] tl::unexpected<Error> wrong(std::string reason) const {
        return input_.failure("line " + std::to_string(header_.lines), std::move(reason));
    }

    Result<void> takeFormat(std::string_view line) {
        const std::string_view word = takeWord(line);
        if (word == "ascii") {
            header_.format = PlyFormat::ascii;
        } else if (word == "binary_little_endian") {
            header_.format = PlyFormat::littleEndian;
        } else if (word == "binary_big_endian") {
            header_.format = PlyFormat::bigEndian;
        } else {
            return wrong("the format " + inQuotes(word) + " is not known");
        }
        return {};
    }

    Result<void> takeElement(std::string_view line) {
        PlyElement element;
        element.name = takeWord(line);
        std::int64_t count = 0;
        if (element.name.empty() || !toInteger(takeWord(line), count) || count < 0) {
            return wrong("an element has a name and a count");
        }
        element.count = static_cast<std::uint64_t>(count);
        header_.elements.push_back(std::move(element));
        return {};
    }

    Result<void> takeProperty(std::string_view line) {
        if (header_.elements.empty()) return wrong("a property stands before the first element");
        PlyProperty property;
        std::string_view word = takeWord(line);
        property.isList = word == "list";
        if (property.isList) {
            word = takeWord(line);
            if (!typeOf(word, property.countType) || isReal(property.countType)) {
                return wrong(inQuotes(word) + " is not a type that can count a list");
            }
            word = takeWord(line);
        }
        if (!typeOf(word, property.type)) return wrong("the type " + inQuotes(word) + " is not known");
        property.name = takeWord(line);
        if (property.name.empty()) return wrong("a property has no name");
        header_.elements.back().properties.push_back(std::move(property));
        return {};
    }

    const MeshBytes& input_;
    std::string_view rest_;
    PlyHeader header_;
    bool endsWithPair_ = false;
};

}  // namespace

std::size_t sizeOf(PlyType type) {
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> parsePlyHeader(const MeshBytes& input) {
    return HeaderParser(input).parse();
}

}  // namespace fb
