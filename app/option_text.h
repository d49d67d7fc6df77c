// Texts of command-line options that several commands share, turned into values; errors are usage errors.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "settings/settings.h"

namespace fb {

// "NAME=VALUE" each, through the knob gate; the order does not matter for rules between knobs.
[[nodiscard]] Result<void> applySets(Settings& settings, const std::vector<std::string>& sets);
// A policy's name, as select.policy takes it.
[[nodiscard]] Result<void> takePolicy(Settings& settings, const std::string& name);
// "1280x720", each side from 1 to 16384.
[[nodiscard]] Result<glm::ivec2> parseSize(const std::string& text);
// "480000", "480K", "8.95M", "1G".
[[nodiscard]] Result<std::uint64_t> parseCount(const std::string& text);
// A finite number; `option` is named in the error.
[[nodiscard]] Result<double> parseReal(const std::string& option, const std::string& text);

}  // namespace fb
