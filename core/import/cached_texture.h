// How OpenImageIO's ImageCache sees a texture: as 8-bit rows or tiles, whatever the file holds, read through the
// checks of texture_reader. Used by texture_store only.
#pragma once

#include <OpenImageIO/imageio.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "import/texture_reader.h"

namespace fb {

struct DecodeCounts {
    std::atomic<std::uint64_t> texelsDecoded = 0, startedOver = 0;
};

// One texture of the store. What `open` found is written once and then only read.
struct CachedTexture {
    std::string name;
    std::filesystem::path file;
    std::vector<std::uint8_t> encoded;
    DecodeCounts* counts = nullptr;
    void* handle = nullptr;  // OIIO::ImageCache::ImageHandle
    TextureHeader header;
    std::optional<Error> refusal;
    std::once_flag opened, decoded;

    [[nodiscard]] TextureBytes bytes() const { return {name, file, encoded}; }
};

// The configuration by which cachedTextureInput() finds its texture, which must outlive the cache.
[[nodiscard]] OIIO::ImageSpec configOf(CachedTexture& texture);

// For ImageCache::add_file.
[[nodiscard]] OIIO::ImageInput* cachedTextureInput();

}  // namespace fb
