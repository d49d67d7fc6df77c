// Names a file by what is in it, read a megabyte at a time.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"

namespace fb {

[[nodiscard]] Result<std::uint64_t> hashFile(const std::filesystem::path& path);

}  // namespace fb
