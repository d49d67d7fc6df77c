// Strings and numbers as TOML writes them, the same in every locale.
#pragma once

#include <string>
#include <string_view>

namespace fb {

// In quotes, escaped; bytes that are not UTF-8 (file names may hold any) become '?', else nobody could read
// it back.
[[nodiscard]] std::string tomlString(std::string_view text);
// 17 significant digits: reading it back gives the same double.
[[nodiscard]] std::string tomlReal(double value);

}  // namespace fb
