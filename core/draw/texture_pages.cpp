#include "draw/texture_pages.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "base/check.h"
#include "draw/gl_messages.h"

namespace fb {

namespace {

constexpr float kAnisotropy = 8.0f;

std::uint32_t limitOf(GLenum which) {
    GLint value = 0;
    glGetIntegerv(which, &value);
    return static_cast<std::uint32_t>(std::max(value, 1));
}

}  // namespace

TexturePages::TexturePages(std::uint64_t smallestBytes, std::uint64_t largestBytes, bool anisotropic)
    : smallestBytes_(smallestBytes),
      largestBytes_(largestBytes),
      largestSide_(limitOf(GL_MAX_TEXTURE_SIZE)),
      mostLayers_(limitOf(GL_MAX_ARRAY_TEXTURE_LAYERS)),
      sampler_(GlSampler::make()) {
    const unsigned name = sampler_.name();
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (anisotropic && (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") ||
                        epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic"))) {
        GLfloat most = 1.0f;
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
        glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, kAnisotropy));
    }
}

Result<TexturePages::Page> TexturePages::makePage(std::uint32_t width, std::uint32_t height,
                                                  std::uint32_t layers) const {
    Page page;
    page.texture = GlTexture::make(unsigned{GL_TEXTURE_2D_ARRAY});
    page.width = width;
    page.height = height;
    page.levels = mipLevelCount(width, height);
    page.layers = layers;
    page.layerBytes = mippedBytes(width, height);
    clearGlErrors();
    glTextureStorage3D(page.texture.name(), static_cast<GLsizei>(page.levels), GL_RGBA8,
                       static_cast<GLsizei>(width), static_cast<GLsizei>(height),
                       static_cast<GLsizei>(layers));
    const std::string what = "making a texture page of " + std::to_string(width) + " x " +
                             std::to_string(height) + " x " + std::to_string(layers) + " texels";
    if (auto made = takeGlError(what); !made) return passOn(made);
    page.freeLayers.resize(layers);
    for (std::uint32_t i = 0; i < layers; ++i) page.freeLayers[i] = layers - 1 - i;
    return page;
}

Result<TextureSlot> TexturePages::allocate(std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return TextureSlot{};
    if (std::max(width, height) > largestSide_) {
        return failure("", "",
                       "a texture of " + std::to_string(width) + " x " + std::to_string(height) +
                           " texels is larger than the driver takes (" + std::to_string(largestSide_) + ")",
                       "build with a lower build.max_texture_side");
    }
    std::size_t hole = pages_.size();
    std::uint64_t classLayers = 0;
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        if (!pages_[i]) {
            hole = std::min(hole, i);
            continue;
        }
        Page& page = *pages_[i];
        if (page.width != width || page.height != height) continue;
        classLayers += page.layers;
        if (page.freeLayers.empty()) continue;
        const TextureSlot slot{static_cast<std::uint32_t>(i), page.freeLayers.back()};
        page.freeLayers.pop_back();
        return slot;
    }
    const std::uint64_t layerBytes = mippedBytes(width, height);
    const std::uint64_t wanted = std::max(smallestBytes_ / layerBytes, classLayers);
    const std::uint64_t most = std::clamp<std::uint64_t>(largestBytes_ / layerBytes, 1, mostLayers_);
    auto page =
        makePage(width, height, static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, 1, most)));
    if (!page) return passOn(page);
    if (hole == pages_.size()) pages_.emplace_back();
    pages_[hole].emplace(std::move(*page));
    const TextureSlot slot{static_cast<std::uint32_t>(hole), pages_[hole]->freeLayers.back()};
    pages_[hole]->freeLayers.pop_back();
    return slot;
}

void TexturePages::write(const TextureSlot& slot, std::span<const std::uint8_t> texels,
                         UploadStaging& staging) {
    if (slot.page == kNoPage) return;
    const Page& page = *pages_[slot.page];
    FB_CHECK(texels.size() == page.layerBytes);
    staging.copyToTexture({page.texture.name(), slot.layer, page.width, page.height, page.levels}, texels);
}

void TexturePages::release(const TextureSlot& slot) {
    if (slot.page == kNoPage) return;
    FB_CHECK(slot.page < pages_.size());
    FB_CHECK(pages_[slot.page].has_value());
    Page& page = *pages_[slot.page];
    FB_CHECK(slot.layer < page.layers);
    FB_CHECK(std::ranges::count(page.freeLayers, slot.layer) == 0);
    page.freeLayers.push_back(slot.layer);
    if (page.freeLayers.size() == page.layers) pages_[slot.page].reset();
}

std::uint64_t TexturePages::allocatedBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& page : pages_) bytes += page ? page->layerBytes * page->layers : 0;
    return bytes;
}

std::size_t TexturePages::pageCount() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(pages_, [](const auto& page) { return page.has_value(); }));
}

}  // namespace fb
