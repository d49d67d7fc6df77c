// Textures on the GPU: one array texture per page, all layers of one size, each with all its mip levels. In:
// sizes (few classes, see atlasSide). Out: page and layer. Pages of a class double in number of layers up to
// a bound in bytes, so that a class of one node takes one small page and a large class few; a page that runs
// empty is deleted. The bytes are sRGB and are drawn as they are: filtering and light work on them directly,
// as most viewers did before linear light, so that an unlit pixel shows exactly its texel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "draw/gl_objects.h"
#include "draw/mesh_pages.h"
#include "draw/upload_staging.h"

namespace fb {

struct TextureSlot {
    std::uint32_t page = kNoPage;  // kNoPage: no texture
    std::uint32_t layer = 0;
};

class TexturePages {
  public:
    // smallestBytes: of the first page of a class; largestBytes: of any page of more than one layer.
    TexturePages(std::uint64_t smallestBytes, std::uint64_t largestBytes, bool anisotropic);

    // Error: larger than the driver takes, or the GPU has no memory for another page; nothing has changed
    // then.
    [[nodiscard]] Result<TextureSlot> allocate(std::uint32_t width, std::uint32_t height);
    void write(const TextureSlot& slot, std::span<const std::uint8_t> texels, UploadStaging& staging);
    void release(const TextureSlot& slot);

    [[nodiscard]] unsigned texture(std::uint32_t page) const { return pages_[page]->texture.name(); }
    [[nodiscard]] unsigned sampler() const { return sampler_.name(); }
    [[nodiscard]] std::uint64_t allocatedBytes() const;
    [[nodiscard]] std::size_t pageCount() const;

  private:
    struct Page {
        GlTexture texture;
        std::uint32_t width = 0, height = 0, levels = 0, layers = 0;
        std::uint64_t layerBytes = 0;
        std::vector<std::uint32_t> freeLayers;  // a stack
    };
    [[nodiscard]] Result<Page> makePage(std::uint32_t width, std::uint32_t height,
                                        std::uint32_t layers) const;

    std::uint64_t smallestBytes_, largestBytes_;
    std::uint32_t largestSide_ = 0, mostLayers_ = 0;
    GlSampler sampler_;
    std::vector<std::optional<Page>> pages_;  // numbers of pages stay while they live
};

}  // namespace fb
