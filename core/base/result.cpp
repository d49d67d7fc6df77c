#include "base/result.h"

namespace fb {

std::string Error::oneLine() const {
    std::string line;
    for (const std::string* part : {&file, &place, &reason}) {
        if (part->empty()) continue;
        if (!line.empty()) line += ": ";
        line += *part;
    }
    if (!hint.empty()) line += " (" + hint + ")";
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return line;
}

}  // namespace fb
