#include "import/texture_reader.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "base/file_io.h"
#include "import/image_format.h"
#include "import/import_limits.h"
#include "import/parse_text.h"
#include "import/srgb.h"

namespace fb {
namespace {

class MemoryBytes final : public ByteSource {
  public:
    explicit MemoryBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    [[nodiscard]] std::uint64_t sizeBytes() const override { return bytes_.size(); }
    [[nodiscard]] bool readAt(std::uint64_t offset, std::span<std::uint8_t> into) const override {
        if (offset > bytes_.size() || into.size() > bytes_.size() - offset) return false;
        if (!into.empty()) std::memcpy(into.data(), bytes_.data() + offset, into.size());
        return true;
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

// How many channels to take: colour with alpha, colour, grey with alpha or grey; other channels are not
// colour.
int channelsToTake(const OIIO::ImageSpec& spec) {
    if (spec.nchannels <= 1) return 1;
    if (spec.nchannels == 2) return spec.alpha_channel == 1 ? 2 : 1;
    return spec.nchannels > 3 && spec.alpha_channel == 3 ? 4 : 3;
}

std::uint8_t encodedByte(float linear) {
    if (!(linear > 0.0f)) return 0;
    return static_cast<std::uint8_t>(encodeSrgb(std::min(static_cast<double>(linear), 1.0)) * 255.0 + 0.5);
}

// High dynamic range: linear light, clipped at 1, stored as sRGB.
void encodeLinear(std::span<const float> from, int channels, std::uint8_t* into) {
    const auto count = static_cast<std::size_t>(channels);
    const bool hasAlpha = channels % 2 == 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const bool isAlpha = hasAlpha && (i + 1) % count == 0;
        into[i] = isAlpha ? static_cast<std::uint8_t>(std::clamp(from[i], 0.0f, 1.0f) * 255.0f + 0.5f)
                          : encodedByte(from[i]);
    }
}

// Exact to 1 of 255 above half opacity; what is invisible stays black.
void divideByAlpha(std::span<std::uint8_t> rgba) {
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const unsigned alpha = rgba[i + 3];
        for (std::size_t c = i; alpha > 0 && c < i + 3; ++c) {
            rgba[c] = static_cast<std::uint8_t>(std::min((rgba[c] * 255u + alpha / 2) / alpha, 255u));
        }
    }
}

// Before any pixel is read or any memory for them taken.
Result<void> checkHeader(const OIIO::ImageSpec& spec, const ImageFormat& format, std::uint64_t encodedBytes,
                         TextureUse use, const std::string& name) {
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
        return failure(name, "header", "has " + size + " of " + std::to_string(spec.nchannels) + " channels");
    }
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
    const bool byParts = use == TextureUse::byTiles && format.decodesByParts;
    const int mostSide = byParts ? kMaxTiledTextureSide : kMaxTextureSide;
    const std::uint64_t mostPixels = byParts ? kMaxTiledTexturePixels : kMaxTexturePixels;
    if (spec.width > mostSide || spec.height > mostSide || pixels > mostPixels) {
        return failure(name, "header", "has " + size,
                       "textures of this kind may have " + std::to_string(mostSide) + " pixels a side and " +
                           std::to_string(mostPixels) + " in all");
    }
    if (static_cast<std::uint64_t>(spec.tile_width) * static_cast<std::uint64_t>(spec.tile_height) >
        kMaxTexturePixels) {
        return failure(name, "header",
                       "has tiles of " + std::to_string(spec.tile_width) + " x " +
                           std::to_string(spec.tile_height) + " pixels");
    }
    const std::uint64_t decodedBytes =
        pixels * static_cast<std::uint64_t>(spec.nchannels) * spec.format.size();
    if (!format.inflatesWithoutLimit && decodedBytes / kMaxTextureInflation > encodedBytes + 64) {
        return failure(name, "header",
                       "promises " + size + " in " + std::to_string(encodedBytes) + " bytes",
                       "the file is cut off or damaged");
    }
    return {};
}

}  // namespace

struct TextureReader::Decoder {
    std::optional<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    bool isLinear = false, multipliesAlpha = false;
    std::vector<float> linear;  // scratch
    std::vector<std::uint8_t> part;

    // The columns and rows, counted from the picture's corner, as UINT8 or FLOAT; tightly packed.
    bool read(int x0, int x1, int y0, int y1, int channels, OIIO::TypeDesc type, void* into) {
        const int left = spec.x + x0, right = spec.x + x1, top = spec.y + y0, bottom = spec.y + y1;
        if (spec.tile_width > 0) {
            return input->read_tiles(0, 0, left, right, top, bottom, 0, 1, 0, channels, type, into);
        }
        return input->read_scanlines(0, 0, top, bottom, 0, 0, channels, type, into);
    }

    bool readBytes(int x0, int x1, int y0, int y1, int channels, std::uint8_t* into) {
        const std::size_t count =
            static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0) * static_cast<std::size_t>(channels);
        if (!isLinear) {
            if (!read(x0, x1, y0, y1, channels, OIIO::TypeDesc::UINT8, into)) return false;
        } else {
            linear.resize(count);
            if (!read(x0, x1, y0, y1, channels, OIIO::TypeDesc::FLOAT, linear.data())) return false;
            encodeLinear(linear, channels, into);
        }
        if (multipliesAlpha && channels == 4) divideByAlpha({into, count});
        return true;
    }

    [[nodiscard]] tl::unexpected<Error> broken(const std::string& name) const {
        std::string reason = std::string(trimmed(input->geterror()));
        return failure(name, {}, reason.empty() ? "cannot be decoded" : "cannot be decoded: " + reason,
                       "the file is damaged, or a variant that is not supported");
    }
};

TextureReader::TextureReader() : decoder_(std::make_unique<Decoder>()) {}
TextureReader::~TextureReader() = default;

Result<std::unique_ptr<TextureReader>> TextureReader::open(const TextureBytes& bytes, TextureUse use) {
    std::unique_ptr<TextureReader> reader(new TextureReader());
    reader->name_ = bytes.file.empty() ? bytes.name : bytes.file.string();
    const std::string& name = reader->name_;
    std::unique_ptr<ByteSource> source = std::make_unique<MemoryBytes>(bytes.encoded);
    if (!bytes.file.empty()) {
        Result<FileReader> file = FileReader::open(bytes.file);
        if (!file) return passOn(file);
        source = std::make_unique<FileBytes>(std::move(*file));
    }
    const std::uint64_t size = source->sizeBytes();
    if (size == 0) return failure(name, {}, "is empty");
    const std::optional<ImageFormat> format = recogniseImage(*source, name);
    if (!format) return failure(name, "byte 0", "is not an image that can be read", "use PNG, JPEG or TIFF");
    if (size > kMaxTextureFileBytes && !(use == TextureUse::byTiles && format->decodesByParts)) {
        return failure(name, {},
                       "has " + std::to_string(size) + " bytes; the limit for its kind is " +
                           std::to_string(kMaxTextureFileBytes));
    }
    Decoder& decoder = *reader->decoder_;
    decoder.input = OIIO::ImageInput::create(format->plugin);
    if (!decoder.input)
        return failure(name, {}, std::string("needs the plugin '") + format->plugin + "' of OpenImageIO");
    decoder.input->threads(1);  // whole blocks are the tasks
    OIIO::ImageSpec config;
    void* proxy = nullptr;
    if (bytes.file.empty()) {
        proxy = &decoder.memory.emplace(bytes.encoded.data(), bytes.encoded.size());
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied with alpha
    OIIO::ImageSpec& spec = decoder.spec;
    if (!decoder.input->open(name, spec, config)) return decoder.broken(name);
    if (Result<void> checked = checkHeader(spec, *format, size, use, name); !checked) return passOn(checked);
    TextureHeader& header = reader->header_;
    header.width = spec.width;
    header.height = spec.height;
    header.channels = channelsToTake(spec);
    header.lossless = format->isLossless && spec.get_string_attribute("compression") != "jpeg";
    header.tileWidth = spec.tile_width;
    header.tileHeight = spec.tile_height;
    decoder.isLinear = spec.get_string_attribute("oiio:ColorSpace") == "Linear";
    decoder.multipliesAlpha = format->multipliesAlpha;
    return reader;
}

Result<void> TextureReader::readRows(int begin, int end, std::uint8_t* into) {
    if (!decoder_->readBytes(0, header_.width, begin, end, header_.channels, into)) return decoder_->broken(name_);
    return {};
}

Result<void> TextureReader::readTile(int x, int y, std::uint8_t* into) {
    const int right = std::min(x + header_.tileWidth, header_.width);
    const int bottom = std::min(y + header_.tileHeight, header_.height);
    const auto channels = static_cast<std::size_t>(header_.channels);
    const auto row = static_cast<std::size_t>(right - x) * channels;
    decoder_->part.resize(row * static_cast<std::size_t>(bottom - y));
    if (!decoder_->readBytes(x, right, y, bottom, header_.channels, decoder_->part.data()))
        return decoder_->broken(name_);
    for (int j = 0; j < bottom - y; ++j) {
        std::memcpy(into + static_cast<std::size_t>(j) * static_cast<std::size_t>(header_.tileWidth) * channels,
                    decoder_->part.data() + static_cast<std::size_t>(j) * row, row);
    }
    return {};
}

}  // namespace fb
