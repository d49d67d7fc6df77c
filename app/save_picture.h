// Pictures as PNG files.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "import/source_scene.h"

namespace fb {

[[nodiscard]] Result<void> savePicture(const Image& picture, const std::filesystem::path& file);

}  // namespace fb
