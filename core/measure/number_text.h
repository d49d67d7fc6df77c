// Numbers as text for files: the shortest decimal that reads back as the same number, whatever the locale.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace fb {

// 1.5, 3, 1e+30. Nothing for what is not finite.
template <class Number>
void appendNumber(std::string& text, Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(value)) return;
    }
    std::array<char, 32> digits{};
    const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem == std::errc()) text.append(digits.data(), end);
}

// 1.5e+07, with exactly `decimals` digits after the point.
[[nodiscard]] inline std::string exponentText(double value, int decimals) {
    std::array<char, 64> digits{};
    const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                              std::chars_format::scientific, decimals);
    return problem == std::errc() ? std::string(digits.data(), end) : std::string();
}

// With exactly `decimals` digits after the point.
[[nodiscard]] inline std::string fixedText(double value, int decimals) {
    std::array<char, 400> digits{};
    const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                              std::chars_format::fixed, decimals);
    return problem == std::errc() ? std::string(digits.data(), end) : std::string();
}

}  // namespace fb
