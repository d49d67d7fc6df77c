#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <span>

#include "base/file_io.h"
#include "import/import_limits.h"
#include "import/parse_text.h"
#include "import/source_scene.h"

namespace fb {
namespace {

struct ImageFormat {
    const char* plugin;  // of OpenImageIO, chosen by us: by itself it would try every plugin it has
    bool isLossless;
    bool inflatesWithoutLimit;     // its encoding has no least size per pixel
    bool multipliesAlpha = false;  // the plugin multiplies colours with alpha, asked or not
};

std::string_view textOf(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// By the first bytes; TGA, which has no mark, by the name.
std::optional<ImageFormat> recognise(std::span<const std::uint8_t> bytes, std::string_view name) {
    const std::string_view text = textOf(bytes.subspan(0, std::min<std::size_t>(bytes.size(), 32)));
    if (startsWith(text, "\x89PNG")) return ImageFormat{"png", true, false};
    if (startsWith(text, "\xff\xd8\xff")) return ImageFormat{"jpeg", false, false};
    if (startsWith(text, std::string_view("II*\0", 4)) || startsWith(text, std::string_view("MM\0*", 4))) {
        return ImageFormat{"tiff", true, false};
    }
    if (startsWith(text, "RIFF") && text.substr(8, 4) == "WEBP") {
        return ImageFormat{"webp", text.substr(12, 4) == "VP8L", true, true};
    }
    if (startsWith(text, "BM")) return ImageFormat{"bmp", true, false};
    if (startsWith(text, "GIF8")) return ImageFormat{"gif", true, false};
    if (startsWith(text, "#?RADIANCE") || startsWith(text, "#?RGBE")) return ImageFormat{"hdr", true, false};
    if (startsWith(text, "\x76\x2f\x31\x01")) return ImageFormat{"openexr", true, false};
    if (startsWith(text, "DDS ")) return ImageFormat{"dds", false, false};
    if (startsWith(text, "8BPS")) return ImageFormat{"psd", true, false};
    if (startsWith(text, std::string_view("\0\0\0\x0cjP", 6))) return ImageFormat{"jpeg2000", false, true};
    if (text.size() > 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6')
        return ImageFormat{"pnm", true, false};
    const std::string lower = lowerCase(name);
    if (lower.size() > 4 && lower.substr(lower.size() - 4) == ".tga")
        return ImageFormat{"targa", true, false};
    return std::nullopt;
}

// How many channels to take: colour with alpha, colour, grey with alpha or grey; other channels are not
// colour.
int channelsToTake(const OIIO::ImageSpec& spec) {
    if (spec.nchannels <= 1) return 1;
    if (spec.nchannels == 2) return spec.alpha_channel == 1 ? 2 : 1;
    return spec.nchannels > 3 && spec.alpha_channel == 3 ? 4 : 3;
}

std::uint8_t encodedByte(float linear) {
    if (!(linear > 0.0f)) return 0;
    const double value = std::min(static_cast<double>(linear), 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(encoded * 255.0 + 0.5);
}

class Decoder {
  public:
    Decoder(std::span<const std::uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

    Result<Image> decode() {
        if (bytes_.empty()) return failure(name_, {}, "is empty");
        const std::optional<ImageFormat> format = recognise(bytes_, name_);
        if (!format)
            return failure(name_, "byte 0", "is not an image that can be read", "use PNG, JPEG or TIFF");
        OIIO::Filesystem::IOMemReader reader(bytes_.data(), bytes_.size());
        std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format->plugin);
        if (!input)
            return failure(name_, {},
                           std::string("needs the plugin '") + format->plugin + "' of OpenImageIO");
        OIIO::ImageSpec config, spec;
        void* proxy = &reader;
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        config.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied with alpha
        if (!input->open(name_, spec, config)) return broken(*input);
        if (Result<void> checked = check(spec, *format); !checked) return passOn(checked);
        Image image;
        image.width = spec.width;
        image.height = spec.height;
        image.channels = channelsToTake(spec);
        image.lossless = format->isLossless && spec.get_string_attribute("compression") != "jpeg";
        image.pixels.resize(pixelBytes(spec, image.channels));
        const bool isLinear = spec.get_string_attribute("oiio:ColorSpace") == "Linear";
        const bool read = isLinear ? readLinear(*input, spec, image) : readBytes(*input, image);
        if (!read) return broken(*input);
        if (format->multipliesAlpha && image.channels == 4) divideByAlpha(image);
        return image;
    }

  private:
    static std::size_t pixelBytes(const OIIO::ImageSpec& spec, int channels) {
        return static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
               static_cast<std::size_t>(channels);
    }

    // Before any pixel is read or any memory for them taken.
    [[nodiscard]] Result<void> check(const OIIO::ImageSpec& spec, const ImageFormat& format) const {
        const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
        if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
            return failure(name_, "header",
                           "has " + size + " of " + std::to_string(spec.nchannels) + " channels");
        }
        const std::uint64_t pixels =
            static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
        if (spec.width > kMaxTextureSide || spec.height > kMaxTextureSide || pixels > kMaxTexturePixels) {
            return failure(name_, "header", "has " + size,
                           "textures may have " + std::to_string(kMaxTextureSide) + " pixels a side and " +
                               std::to_string(kMaxTexturePixels) + " in all");
        }
        const std::uint64_t decodedBytes =
            pixels * static_cast<std::uint64_t>(spec.nchannels) * spec.format.size();
        const std::uint64_t most = (bytes_.size() + 64) * kMaxTextureInflation;
        if (!format.inflatesWithoutLimit && decodedBytes > most) {
            return failure(name_, "header",
                           "promises " + size + " in " + std::to_string(bytes_.size()) + " bytes",
                           "the file is cut off or damaged");
        }
        return {};
    }

    static bool readBytes(OIIO::ImageInput& input, Image& image) {
        return input.read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, image.pixels.data());
    }

    // High dynamic range: linear light, clipped at 1, stored as sRGB; row by row, as it takes four bytes a
    // channel.
    static bool readLinear(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, Image& image) {
        const std::size_t rowLength =
            static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(image.channels);
        std::vector<float> row(rowLength);
        const bool hasAlpha = image.channels % 2 == 0;
        for (int y = 0; y < spec.height; ++y) {
            if (!input.read_scanlines(0, 0, spec.y + y, spec.y + y + 1, 0, 0, image.channels,
                                      OIIO::TypeDesc::FLOAT, row.data())) {
                return false;
            }
            std::uint8_t* const out = image.pixels.data() + static_cast<std::size_t>(y) * rowLength;
            for (std::size_t i = 0; i < rowLength; ++i) {
                const bool isAlpha = hasAlpha && (i + 1) % static_cast<std::size_t>(image.channels) == 0;
                out[i] = isAlpha ? static_cast<std::uint8_t>(std::clamp(row[i], 0.0f, 1.0f) * 255.0f + 0.5f)
                                 : encodedByte(row[i]);
            }
        }
        return true;
    }

    // Exact to 1 of 255 above half opacity; what is invisible stays black.
    static void divideByAlpha(Image& image) {
        for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
            const unsigned alpha = image.pixels[i + 3];
            for (std::size_t c = i; alpha > 0 && c < i + 3; ++c) {
                image.pixels[c] =
                    static_cast<std::uint8_t>(std::min((image.pixels[c] * 255u + alpha / 2) / alpha, 255u));
            }
        }
    }

    [[nodiscard]] tl::unexpected<Error> broken(const OIIO::ImageInput& input) const {
        std::string reason = std::string(trimmed(input.geterror()));
        return failure(name_, {}, reason.empty() ? "cannot be decoded" : "cannot be decoded: " + reason,
                       "the file is damaged, or a variant that is not supported");
    }

    std::span<const std::uint8_t> bytes_;
    std::string name_;
};

Result<Image> checkedCopy(const SourceTexture& texture) {
    const Image& image = *texture.image;
    const auto side = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
    if (image.channels < 1 || image.channels > 4 || image.width < 1 || image.height < 1 ||
        image.pixels.size() != side(image.width) * side(image.height) * side(image.channels)) {
        return failure(texture.name, {}, "has pixels that do not match its size");
    }
    return image;
}

}  // namespace

Result<Image> loadTexture(const SourceTexture& texture) {
    try {
        if (!texture.file.empty()) {
            Result<std::vector<std::uint8_t>> bytes = readFile(texture.file, kMaxTextureFileBytes);
            if (!bytes) return passOn(bytes);
            return Decoder(*bytes, texture.file.string()).decode();
        }
        if (texture.image) return checkedCopy(texture);
        return Decoder(texture.encoded, texture.name).decode();
    } catch (const std::bad_alloc&) {
        return failure(texture.name, {}, "needs more memory than there is");
    }
}

}  // namespace fb
