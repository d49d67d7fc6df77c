// The encoded textures of a build, each opened, hashed and (while the cache lasts) decoded once, whichever blocks and
// threads ask for it; blocks read the rectangles that they show. A private ImageCache of OpenImageIO keeps decoded
// tiles up to a number of bytes; what falls out of it is decoded again, so results never depend on its size.
// Owned by buildScene, used by all its threads; goes to block_textures and hash_block.
#pragma once

#include <cstdint>
#include <memory>

#include "import/source_scene.h"
#include "import/texture_reader.h"

namespace fb {

// What was done so far; for reports and tests.
struct TextureStoreCounts {
    std::uint64_t opened = 0;         // textures whose header was read, in files or encoded in memory
    std::uint64_t texelsDecoded = 0;  // once each as long as nothing falls out of the cache
    std::uint64_t startedOver = 0;    // decoders of rows that were asked for earlier rows again
    std::uint64_t filesHashed = 0;
};

// A texture whose texels can be read: either in the cache, or pixels in memory, used as they are.
struct StoredTexture {
    TextureHeader header;
    std::shared_ptr<const Image> pixels;
    struct CachedTexture* cached = nullptr;  // owned by the store
};

struct StoredRect {
    int x = 0, y = 0, width = 0, height = 0;  // inside the picture
};

class TextureStore {
  public:
    explicit TextureStore(std::uint64_t cacheBytes);
    ~TextureStore();
    TextureStore(const TextureStore&) = delete;
    TextureStore& operator=(const TextureStore&) = delete;

    // Reads and checks the header; a refusal is remembered as well.
    [[nodiscard]] Result<StoredTexture> open(const SourceTexture& texture);
    // header.channels bytes a texel, tightly packed. Cheapest from the top of a picture to its bottom.
    [[nodiscard]] Result<void> read(const StoredTexture& texture, const StoredRect& rect, std::uint8_t* into);
    // Of the file's bytes, or of why they cannot be read.
    [[nodiscard]] std::uint64_t hashFile(const std::filesystem::path& file);

    [[nodiscard]] TextureStoreCounts counts() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fb
