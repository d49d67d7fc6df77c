// Reads an image of any size row by row from the top, holding a strip of rows (of tiles, where it is tiled)
// at a time. For height maps and for drapes; OpenImageIO decodes. One place, so that a store of tiles can
// take its place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"

namespace fb {

class ImageRows {
  public:
    ~ImageRows();
    ImageRows(ImageRows&&) noexcept;

    // Checks the header against caps and against the file's length before any pixel is read. `what` it is
    // for: "a height map".
    [[nodiscard]] static Result<ImageRows> open(const std::filesystem::path& file, const std::string& what);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] bool isLossless() const { return lossless_; }

    // The first channel as the file has it: whole numbers are not scaled to [0, 1].
    [[nodiscard]] Result<void> readValues(
        const std::function<Result<void>(std::uint32_t firstRow, std::span<const double> rows)>& take);
    // RGB bytes; grey becomes RGB, alpha is left out, linear light is encoded as sRGB.
    [[nodiscard]] Result<void> readColours(
        const std::function<Result<void>(std::uint32_t firstRow, std::span<const std::uint8_t> rows)>& take);

  private:
    struct Input;
    ImageRows();

    std::unique_ptr<Input> input_;
    std::filesystem::path file_;
    std::uint32_t width_ = 0, height_ = 0;
    bool lossless_ = true;
};

}  // namespace fb
