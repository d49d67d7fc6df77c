#include "import/parse_text.h"

#include <charconv>
#include <limits>

namespace fb {
namespace {

constexpr std::size_t kQuotedLength = 100;

std::size_t wordLength(std::string_view text) {
    std::size_t length = 0;
    while (length < text.size() && !isBlank(text[length]) && text[length] != '\n') ++length;
    return length;
}

// std::from_chars takes no plus sign; "+-1" stays refused.
const char* skipPlus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return word.data() + (plus ? 1 : 0);
}

// A number outside the range of double: too small becomes 0, too large infinite.
double outOfRange(std::string_view word) {
    const std::size_t exponent = word.find_first_of("eE");
    const bool small = exponent != std::string_view::npos ? word.substr(exponent + 1, 1) == "-"
                                                          : word.find_first_of("123456789") > word.find('.');
    if (small) return 0.0;
    return word[0] == '-' ? -std::numeric_limits<double>::infinity()
                          : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (isBlank(text.front()) || text.front() == '\n')) text.remove_prefix(1);
    while (!text.empty() && (isBlank(text.back()) || text.back() == '\n')) text.remove_suffix(1);
    return text;
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

bool startsWith(std::string_view text, std::string_view start) {
    return text.substr(0, start.size()) == start;
}

std::string_view takeWord(std::string_view& rest) {
    while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
    const std::string_view word = rest.substr(0, wordLength(rest));
    rest.remove_prefix(word.size());
    return word;
}

bool toReal(std::string_view word, double& value) {
    if (word.empty()) return false;
    const char* const end = word.data() + word.size();
    const auto [stopped, problem] = std::from_chars(skipPlus(word), end, value);
    if (stopped != end) return false;
    if (problem == std::errc::result_out_of_range) value = outOfRange(word);
    return problem == std::errc{} || problem == std::errc::result_out_of_range;
}

bool toInteger(std::string_view word, std::int64_t& value) {
    if (word.empty()) return false;
    const char* const end = word.data() + word.size();
    const auto [stopped, problem] = std::from_chars(skipPlus(word), end, value);
    return stopped == end && problem == std::errc{};
}

bool takeReal(std::string_view& rest, double& value) {
    return toReal(takeWord(rest), value);
}

std::string inQuotes(std::string_view text) {
    std::string shown = "'";
    for (char c : text.substr(0, kQuotedLength)) {
        const auto code = static_cast<unsigned char>(c);
        shown += code < 0x20 || code == 0x7f ? '?' : c;
    }
    return shown + (text.size() > kQuotedLength ? "...'" : "'");
}

TextLines::TextLines(std::string_view text) : rest_(text) {
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos) end_ = '\r';
}

bool TextLines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++number_;
    line = rest_.substr(0, rest_.find(end_));
    rest_.remove_prefix(line.size() < rest_.size() ? line.size() + 1 : line.size());
    return true;
}

void TextWords::skipSpace() {
    while (!rest_.empty() && (isBlank(rest_.front()) || rest_.front() == '\n')) {
        if (rest_.front() == '\n') ++line_;
        rest_.remove_prefix(1);
    }
}

std::string_view TextWords::next() {
    skipSpace();
    return takeWord(rest_);
}

std::string_view TextWords::restOfLine() {
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(line.size());
    return trimmed(line);
}

}  // namespace fb
