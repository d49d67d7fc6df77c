// Where the program's own files lie: shaders/, presets/ and resources/.
#pragma once

#include <filesystem>

namespace fb {

[[nodiscard]] std::filesystem::path programFolder();

}  // namespace fb
