// Reads a height map of any size row by row from the top, holding a strip of rows (of tiles, where it is tiled) at a
// time; OpenImageIO decodes. Goes to open_terrain. Pictures on it are read by texture_reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"

namespace fb {

class HeightRows {
  public:
    ~HeightRows();
    HeightRows(HeightRows&&) noexcept;

    // Checks the header against caps and against the file's length before any pixel is read.
    [[nodiscard]] static Result<HeightRows> open(const std::filesystem::path& file);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }

    // The first channel as the file has it: whole numbers are not scaled to [0, 1].
    [[nodiscard]] Result<void> readValues(
        const std::function<Result<void>(std::uint32_t firstRow, std::span<const double> rows)>& take);

  private:
    struct Input;
    HeightRows();

    std::unique_ptr<Input> input_;
    std::filesystem::path file_;
    std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace fb
