#include "import/cached_texture.h"

#include <algorithm>
#include <cstring>

namespace fb {
namespace {

constexpr const char* kTextureAttribute = "frontbench:texture";

class CachedTextureInput final : public OIIO::ImageInput {
  public:
    [[nodiscard]] const char* format_name() const override { return "frontbench"; }

    // A configuration is needed.
    bool open(const std::string&, OIIO::ImageSpec&) override { return false; }

    bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
        void* found = nullptr;
        if (!config.getattribute(kTextureAttribute, OIIO::TypeDesc::PTR, &found) || found == nullptr) return false;
        texture_ = static_cast<CachedTexture*>(found);
        Result<std::unique_ptr<TextureReader>> reader =
            TextureReader::open(texture_->bytes(), TextureUse::byTiles);
        if (!reader) return refuse(reader.error());
        const TextureHeader& header = (*reader)->header();
        const TextureHeader& known = texture_->header;
        if (header.width != known.width || header.height != known.height || header.channels != known.channels) {
            return refuse({Error::Kind::failed, texture_->name, {}, "has changed while it was read", {}});
        }
        reader_ = std::move(*reader);
        nextRow_ = 0;
        m_spec = OIIO::ImageSpec(header.width, header.height, header.channels, OIIO::TypeDesc::UINT8);
        m_spec.tile_width = header.tileWidth;
        m_spec.tile_height = header.tileHeight;
        m_spec.tile_depth = header.tileWidth > 0 ? 1 : 0;
        spec = m_spec;
        return true;
    }

    bool close() override {
        reader_.reset();
        return true;
    }

    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
        return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
    }

    bool read_native_scanlines(int, int, int begin, int end, int, void* data) override {
        const lock_guard lock(*this);
        end = std::min(end, m_spec.height);
        if (reader_ == nullptr || begin < 0 || begin >= end) return false;
        if (begin < nextRow_) ++texture_->counts->startedOver;
        nextRow_ = end;
        texture_->counts->texelsDecoded +=
            static_cast<std::uint64_t>(m_spec.width) * static_cast<std::uint64_t>(end - begin);
        const Result<void> read = reader_->readRows(begin, end, static_cast<std::uint8_t*>(data));
        return read || refuse(read.error());
    }

    bool read_native_tile(int, int, int x, int y, int, void* data) override {
        const lock_guard lock(*this);
        if (reader_ == nullptr || m_spec.tile_width == 0) return false;
        texture_->counts->texelsDecoded +=
            static_cast<std::uint64_t>(std::min(m_spec.tile_width, m_spec.width - x)) *
            static_cast<std::uint64_t>(std::min(m_spec.tile_height, m_spec.height - y));
        std::memset(data, 0, m_spec.tile_bytes());
        const Result<void> read = reader_->readTile(x, y, static_cast<std::uint8_t*>(data));
        return read || refuse(read.error());
    }

  private:
    bool refuse(const Error& error) {
        errorfmt("{}", error.reason);
        return false;
    }

    CachedTexture* texture_ = nullptr;
    std::unique_ptr<TextureReader> reader_;
    int nextRow_ = 0;
};

}  // namespace

OIIO::ImageSpec configOf(CachedTexture& texture) {
    OIIO::ImageSpec config;
    void* self = &texture;
    config.attribute(kTextureAttribute, OIIO::TypeDesc::PTR, &self);
    return config;
}

OIIO::ImageInput* cachedTextureInput() { return new CachedTextureInput; }

}  // namespace fb
