#include "import/read_mtl.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "import/parse_text.h"

namespace fb {
namespace {

float clamped(double value) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 0.0f;
}

// Takes up to three numbers, as many as there are: -s 2 leaves the others as they are, and the file's name
// follows.
void takeNumbers(std::string_view& rest, glm::vec2& into) {
    for (int i = 0; i < 3; ++i) {
        std::string_view ahead = rest;
        double value = 0.0;
        if (!takeReal(ahead, value)) return;
        rest = ahead;
        if (i < 2 && std::isfinite(value)) into[i] = static_cast<float>(value);
    }
}

// Options first, then the file's name, which may contain blanks.
std::string takeTexture(std::string_view rest, MtlMaterial& material, bool laysOn) {
    constexpr std::array<std::string_view, 9> kOneWord{"-blendu", "-blendv", "-cc",      "-clamp", "-texres",
                                                       "-bm",     "-boost",  "-imfchan", "-type"};
    while (true) {
        std::string_view ahead = rest;
        const std::string option = lowerCase(takeWord(ahead));
        glm::vec2 unused(0.0f);
        if (std::find(kOneWord.begin(), kOneWord.end(), option) != kOneWord.end()) {
            (void)takeWord(ahead);
        } else if (option == "-s") {
            takeNumbers(ahead, laysOn ? material.uvScale : unused);
        } else if (option == "-o") {
            takeNumbers(ahead, laysOn ? material.uvOffset : unused);
        } else if (option == "-t" || option == "-mm") {
            takeNumbers(ahead, unused);
        } else {
            return std::string(trimmed(rest));
        }
        rest = ahead;
    }
}

void takeLine(std::string_view word, std::string_view rest, MtlMaterial& material) {
    if (word == "kd") {
        glm::dvec3 colour;
        if (takeReal(rest, colour.x)) {
            // One number stands for grey; 'spectral' and 'xyz' colours are left out.
            if (!takeReal(rest, colour.y) || !takeReal(rest, colour.z)) colour.y = colour.z = colour.x;
            for (int i = 0; i < 3; ++i) material.colour[i] = clamped(colour[i]);
        }
    } else if (word == "d" || word == "tr") {
        double value = 0.0;
        if (takeReal(rest, value)) material.colour.w = clamped(word == "d" ? value : 1.0 - value);
    } else if (word == "map_kd") {
        material.texture = takeTexture(rest, material, true);
    } else if (word == "map_d") {
        material.alphaTexture = takeTexture(rest, material, false);
    }
}

}  // namespace

std::vector<MtlMaterial> parseMtl(std::string_view text) {
    std::vector<MtlMaterial> materials;
    TextLines lines(text);
    std::string_view line;
    while (lines.next(line)) {
        const std::string word = lowerCase(takeWord(line));
        if (word == "newmtl") {
            materials.emplace_back();
            materials.back().name = trimmed(line);
        } else if (!materials.empty()) {
            takeLine(word, line, materials.back());
        }
    }
    return materials;
}

}  // namespace fb
