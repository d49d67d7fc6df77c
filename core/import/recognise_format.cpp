#include <algorithm>
#include <array>
#include <cstring>

#include "import/mesh_file.h"
#include "import/parse_text.h"
#include "import/stl_layout.h"

namespace fb {
namespace {

constexpr const char* kReadable = "OBJ, PLY, STL, OFF, glTF and GLB can be read";

struct Known {
    const char* extension;
    MeshFormat format;
    const char* begins;
};
constexpr std::array kKnown{
    Known{".obj", MeshFormat::obj, "lines such as 'v 1 2 3' and 'f 1 2 3'"},
    Known{".ply", MeshFormat::ply, "the word 'ply'"},
    Known{".stl", MeshFormat::stl,
          "the word 'solid', or 80 bytes and a count that fits the size of the file"},
    Known{".off", MeshFormat::off, "the word 'OFF'"},
    Known{".gltf", MeshFormat::gltf, "'{'"},
    Known{".glb", MeshFormat::glb, "'glTF'"},
};

// Prefixes of the keyword: [ST][C][N][4][n]OFF.
bool isOffKeyword(std::string_view word) {
    if (!startsWith(word.substr(word.size() < 3 ? 0 : word.size() - 3), "OFF") || word.size() > 8)
        return false;
    return word.substr(0, word.size() - 3).find_first_not_of("STCN4n") == std::string_view::npos;
}

// The first lines that are no comments begin with words of OBJ, and one of them says something about
// geometry.
bool looksLikeObj(std::string_view text) {
    constexpr std::array kWords{"v", "vt", "vn", "vp", "f", "g", "o", "s", "l", "p", "usemtl", "mtllib"};
    constexpr int kLinesToSee = 5;
    TextLines lines(text);
    std::string_view line;
    int seen = 0;
    while (seen < kLinesToSee && lines.next(line)) {
        const std::string_view word = takeWord(line);
        if (word.empty() || word[0] == '#') continue;
        if (std::find(kWords.begin(), kWords.end(), word) == kWords.end()) return false;
        ++seen;
    }
    return seen > 0;
}

}  // namespace

Result<MeshFormat> recogniseFormat(const MeshBytes& input) {
    const std::string_view text = input.text();
    if (text.empty()) return input.failure({}, "is empty", "copy or export it again");
    if (startsWith(text, "glTF")) return MeshFormat::glb;
    TextWords words(text);
    const std::string_view word = words.next();
    if (text.front() == 'p' && word == "ply") return MeshFormat::ply;
    if (isBinaryStl(input.bytes)) return MeshFormat::stl;
    if (word == "solid") return MeshFormat::stl;
    if (isOffKeyword(word)) return MeshFormat::off;
    if (!word.empty() && word.front() == '{') return MeshFormat::gltf;

    const std::string extension = lowerCase(input.file.extension().string());
    const auto* const known =
        std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return extension == k.extension; });
    if (known == kKnown.end()) {
        if (looksLikeObj(text)) return MeshFormat::obj;
        return input.failure("byte 0", "is not a mesh in a format that can be read", kReadable);
    }
    // OBJ and OFF may begin with anything; STL may be binary and cut off. Their readers say what is wrong.
    if (known->format == MeshFormat::obj || known->format == MeshFormat::off ||
        known->format == MeshFormat::stl) {
        return known->format;
    }
    if (looksLikeObj(text)) return MeshFormat::obj;
    return input.failure("byte 0", "is not " + extension.substr(1) + ": that begins with " + known->begins,
                         kReadable);
}

}  // namespace fb
