// Reads one encoded picture as 8-bit texels, row by row or tile by tile: the format is recognised by content and not
// by name, header and caps are checked before any pixel is read, linear and deeper sources become sRGB bytes, alpha
// stays unassociated. Comes from SourceTexture; goes to load_texture (whole) and texture_store (by tiles).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"

namespace fb {

// Where the encoded bytes are: in a file, or in memory that outlives the reader.
struct TextureBytes {
    std::string name;
    std::filesystem::path file;             // used when not empty
    std::span<const std::uint8_t> encoded;  // else these
};

struct TextureHeader {
    int width = 0, height = 0;
    int channels = 0;  // as taken: colour with alpha, colour, grey with alpha, grey
    bool lossless = false;
    int tileWidth = 0, tileHeight = 0;  // of the file; 0: it has rows, which are cheap in their order only
};

// How much of it is to be in memory at once; decides which caps hold.
enum class TextureUse : std::uint8_t { whole, byTiles };

class TextureReader {
  public:
    ~TextureReader();
    TextureReader(const TextureReader&) = delete;
    TextureReader& operator=(const TextureReader&) = delete;

    [[nodiscard]] static Result<std::unique_ptr<TextureReader>> open(const TextureBytes& bytes, TextureUse use);
    [[nodiscard]] const TextureHeader& header() const { return header_; }

    // Rows [begin, end) into width * channels bytes each. Of a tiled file `begin` is a multiple of tileHeight.
    [[nodiscard]] Result<void> readRows(int begin, int end, std::uint8_t* into);
    // The tile with its corner at (x, y) into rows of tileWidth texels; what lies outside the picture stays as it is.
    [[nodiscard]] Result<void> readTile(int x, int y, std::uint8_t* into);

  private:
    struct Decoder;  // OpenImageIO's
    TextureReader();

    std::unique_ptr<Decoder> decoder_;
    TextureHeader header_;
    std::string name_;
};

}  // namespace fb
