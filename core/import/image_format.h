// Which decoder an encoded picture needs, by its first bytes. Goes to texture_reader.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/file_io.h"
#include "base/result.h"

namespace fb {

struct ImageFormat {
    const char* plugin;  // of OpenImageIO, chosen by us: by itself it would try every plugin it has
    bool isLossless;
    bool inflatesWithoutLimit;     // its encoding has no least size per pixel
    bool multipliesAlpha = false;  // the plugin multiplies colours with alpha, asked or not
    bool decodesByParts = false;   // and needs no memory for the rest of the picture
};

// Bytes of a file or of memory, by offset.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    [[nodiscard]] virtual std::uint64_t sizeBytes() const = 0;
    // Fills `into` from `offset`; false where that reaches beyond the end.
    [[nodiscard]] virtual bool readAt(std::uint64_t offset, std::span<std::uint8_t> into) const = 0;
};

class FileBytes final : public ByteSource {
  public:
    explicit FileBytes(FileReader&& file) : file_(std::move(file)) {}
    [[nodiscard]] std::uint64_t sizeBytes() const override { return file_.sizeBytes(); }
    [[nodiscard]] bool readAt(std::uint64_t offset, std::span<std::uint8_t> into) const override {
        return file_.readAt(offset, into).has_value();
    }

  private:
    FileReader file_;
};

// TGA, which has no mark, is recognised by the name.
[[nodiscard]] std::optional<ImageFormat> recogniseImage(const ByteSource& bytes, std::string_view name);

}  // namespace fb
