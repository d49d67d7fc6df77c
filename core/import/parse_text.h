// Text of mesh files as lines, words and numbers. Locale-free (std::from_chars), never beyond the end of the
// text. Used by the readers of OBJ, MTL, PLY, STL and OFF.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fb {

// Space, tab, vertical tab, form feed and carriage return: what separates words within a line.
[[nodiscard]] constexpr bool isBlank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n');
}

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lowerCase(std::string_view text);  // ASCII only
[[nodiscard]] bool startsWith(std::string_view text, std::string_view start);

// The word at the front of `rest`, which is moved behind it; empty at the end.
[[nodiscard]] std::string_view takeWord(std::string_view& rest);

// The whole word as a number. A real may be infinite or not a number, where the text says so or is too large;
// one too small becomes 0. False: the word is no number.
[[nodiscard]] bool toReal(std::string_view word, double& value);
[[nodiscard]] bool toInteger(std::string_view word, std::int64_t& value);

// takeWord and toReal in one.
[[nodiscard]] bool takeReal(std::string_view& rest, double& value);

// "'1,5'", shortened and with control characters replaced: for messages.
[[nodiscard]] std::string inQuotes(std::string_view text);

// Lines end with LF, CR LF, or, in a file without any LF, CR.
class TextLines {
  public:
    explicit TextLines(std::string_view text);
    [[nodiscard]] bool next(std::string_view& line);
    [[nodiscard]] std::uint64_t number() const { return number_; }  // of the line last taken, from 1
    [[nodiscard]] std::string place() const { return "line " + std::to_string(number_); }

  private:
    std::string_view rest_;
    std::uint64_t number_ = 0;
    char end_ = '\n';
};

// Words whatever lines they are on; counts the lines for messages.
class TextWords {
  public:
    explicit TextWords(std::string_view text) : rest_(text) {}
    [[nodiscard]] std::string_view next();  // empty at the end
    [[nodiscard]] std::string_view restOfLine();
    [[nodiscard]] std::size_t bytesLeft() const { return rest_.size(); }
    [[nodiscard]] std::uint64_t line() const { return line_; }  // of the word last taken, from 1
    [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }

  private:
    void skipSpace();

    std::string_view rest_;
    std::uint64_t line_ = 1;
};

}  // namespace fb
