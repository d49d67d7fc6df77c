#include "import/parse_obj_text.h"

#include <algorithm>
#include <array>
#include <map>

#include "import/import_limits.h"
#include "import/parse_text.h"

namespace fb {
namespace {

constexpr std::array<std::string_view, 30> kSkipped{
    "s",   "vp",   "lod",  "bevel",  "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech",
    "deg", "bmat", "step", "cstype", "parm",     "trim",     "hole",       "scrv",      "sp",    "end",
    "con", "call", "csh",  "usemap", "maplib",   "mg",       "bsp",        "bzp",       "cdc",   "res"};
constexpr std::array<std::string_view, 5> kCurves{"l", "p", "curv", "curv2", "surf"};

template <std::size_t N>
bool isOneOf(std::string_view word, const std::array<std::string_view, N>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Numbers names in order of first appearance.
class Names {
  public:
    explicit Names(std::vector<std::string>& list) : list_(list) {}
    std::uint32_t numberOf(const std::string& name) {
        const auto [at, isNew] = numbers_.try_emplace(name, static_cast<std::uint32_t>(list_.size()));
        if (isNew) list_.push_back(name);
        return at->second;
    }

  private:
    std::vector<std::string>& list_;
    std::map<std::string, std::uint32_t> numbers_;
};

class ObjParser {
  public:
    ObjParser(const MeshBytes& input, ImportReport& report)
        : input_(input),
          report_(report),
          lines_(input.text()),
          materials_(text_.materialNames),
          groups_(text_.groupNames) {}

    Result<ObjText> parse() {
        std::string_view line;
        while (lines_.next(line)) {
            std::string whole;  // outlives `line`
            if (isContinued(line)) line = whole = joined(line);
            if (Result<void> taken = takeLine(line); !taken) return passOn(taken);
        }
        if (unknownLines_ > 0) {
            report_.warnings.push_back(input_.file.filename().string() + ": " +
                                       std::to_string(unknownLines_) +
                                       " lines are not OBJ and were left out; the first is " + firstUnknown_);
        }
        return std::move(text_);
    }

  private:
    static bool isContinued(std::string_view line) {
        if (line.find('\\') == std::string_view::npos) return false;
        line = trimmed(line);
        return !line.empty() && line.back() == '\\' && line.front() != '#';
    }

    // The line and those that follow it as long as each ends with a backslash.
    std::string joined(std::string_view line) {
        std::string whole;
        while (isContinued(line)) {
            line = trimmed(line);
            whole.append(line.substr(0, line.size() - 1)) += ' ';
            if (!lines_.next(line)) return whole;
        }
        return whole.append(line);
    }

    [[nodiscard]] tl::unexpected<Error> wrong(std::string reason) const {
        return input_.failure(lines_.place(), std::move(reason));
    }

    Result<void> takeLine(std::string_view line) {
        const std::string_view word = takeWord(line);
        if (word.empty() || word[0] == '#') return {};
        if (word == "v") return takePosition(line);
        if (word == "vt") return takeUv(line);
        if (word == "vn") return takeNormal(line);
        if (word == "f" || word == "fo") return takeFace(line);
        if (word == "usemtl") {
            material_ = materials_.numberOf(std::string(trimmed(line)));
        } else if (word == "g" || word == "o") {
            (word == "g" ? groupName_ : objectName_) = trimmed(line);
            groupKnown_ = false;
        } else if (word == "mtllib") {
            text_.materialLibraries.emplace_back(trimmed(line));
        } else if (isOneOf(word, kCurves)) {
            ++report_.ignoredElements;
        } else if (!isOneOf(word, kSkipped)) {
            if (unknownLines_++ == 0) firstUnknown_ = lines_.place() + ", " + inQuotes(word);
        }
        return {};
    }

    // Up to `numbers.size()` numbers, at least `least`; returns how many there were.
    template <std::size_t N>
    Result<std::size_t> takeNumbers(std::string_view line, std::size_t least,
                                    std::array<double, N>& numbers) const {
        std::size_t count = 0;
        for (; count < N; ++count) {
            const std::string_view word = takeWord(line);
            if (word.empty() || word[0] == '#') break;
            if (!toReal(word, numbers[count])) return wrong(inQuotes(word) + " is not a number");
        }
        if (count < least) {
            return wrong("has " + std::to_string(count) + " numbers instead of " + std::to_string(least));
        }
        return count;
    }

    Result<void> takePosition(std::string_view line) {
        std::array<double, 8> n{};
        const Result<std::size_t> count = takeNumbers(line, 3, n);
        if (!count) return tl::make_unexpected(count.error());
        text_.positions.emplace_back(n[0], n[1], n[2]);
        const bool coloured = *count >= 6;  // x y z r g b; 4 numbers are x y z and a weight
        if (coloured && text_.colours.empty())
            text_.colours.resize(text_.positions.size() - 1, glm::vec3(-1.0f));
        if (coloured) {
            text_.colours.push_back(glm::max(glm::vec3(glm::dvec3(n[3], n[4], n[5])), glm::vec3(0.0f)));
        } else if (!text_.colours.empty()) {
            text_.colours.emplace_back(-1.0f);
        }
        return {};
    }

    Result<void> takeUv(std::string_view line) {
        std::array<double, 3> n{};
        const Result<std::size_t> count = takeNumbers(line, 1, n);
        if (!count) return tl::make_unexpected(count.error());
        text_.uvs.emplace_back(glm::dvec2(n[0], 1.0 - n[1]));
        return {};
    }

    Result<void> takeNormal(std::string_view line) {
        std::array<double, 3> n{};
        const Result<std::size_t> count = takeNumbers(line, 3, n);
        if (!count) return tl::make_unexpected(count.error());
        text_.normals.emplace_back(glm::dvec3(n[0], n[1], n[2]));
        return {};
    }

    Result<void> takeFace(std::string_view line) {
        if (!groupKnown_) {
            const bool both = !objectName_.empty() && !groupName_.empty();
            group_ = groups_.numberOf(objectName_ + (both ? "/" : "") + groupName_);
            groupKnown_ = true;
        }
        text_.faces.push_back({text_.corners.size(), material_, group_, lines_.number()});
        for (std::string_view word = takeWord(line); !word.empty() && word[0] != '#'; word = takeWord(line)) {
            ObjText::Corner corner;
            if (Result<void> taken = takeCorner(word, corner); !taken) return taken;
            text_.corners.push_back(corner);
        }
        return {};
    }

    // i, i/j, i//k, i/j/k; also i/j/ and i/ as some programs write them.
    Result<void> takeCorner(std::string_view word, ObjText::Corner& corner) const {
        const std::string_view whole = word;
        const std::array counts{text_.positions.size(), text_.uvs.size(), text_.normals.size()};
        const std::array places{&corner.position, &corner.uv, &corner.normal};
        for (std::size_t part = 0; part < 3; ++part) {
            const std::string_view number = word.substr(0, word.find('/'));
            if (part == 0 || !number.empty()) {
                std::int64_t index = 0;
                if (!toInteger(number, index))
                    return wrong(inQuotes(whole) + " is not a corner such as 1/2/3");
                // Negative: counted back from the last one so far.
                const std::int64_t at =
                    index > 0 ? index - 1 : static_cast<std::int64_t>(counts[part]) + index;
                if (index == 0 || at < 0 || at > static_cast<std::int64_t>(kMaxVertices)) {
                    return wrong(inQuotes(whole) + " refers to nothing: indices begin at 1 or -1");
                }
                *places[part] = static_cast<std::uint32_t>(at);
            }
            if (number.size() == word.size()) return {};
            word.remove_prefix(number.size() + 1);
        }
        return wrong(inQuotes(whole) + " is not a corner such as 1/2/3");
    }

    const MeshBytes& input_;
    ImportReport& report_;
    TextLines lines_;
    ObjText text_;
    Names materials_, groups_;
    std::string objectName_, groupName_, firstUnknown_;
    std::uint32_t material_ = ObjText::kAbsent, group_ = 0;
    bool groupKnown_ = false;
    std::uint64_t unknownLines_ = 0;
};

}  // namespace

Result<ObjText> parseObjText(const MeshBytes& input, ImportReport& report) {
    return ObjParser(input, report).parse();
}

}  // namespace fb
