#include "import/height_rows.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/file_io.h"
#include "import/image_format.h"
#include "import/import_limits.h"
#include "import/parse_text.h"

namespace fb {
namespace {

constexpr std::uint32_t kStripRows = 64;

}  // namespace

struct HeightRows::Input {
    std::unique_ptr<OIIO::ImageInput> image;
    OIIO::ImageSpec spec;

    [[nodiscard]] std::uint32_t stripRows() const {
        return spec.tile_width > 0 ? static_cast<std::uint32_t>(std::max(1, spec.tile_height)) : kStripRows;
    }
    bool read(std::uint32_t first, std::uint32_t end, int channels, OIIO::TypeDesc type, void* into) {
        const int from = spec.y + static_cast<int>(first), to = spec.y + static_cast<int>(end);
        if (spec.tile_width > 0) {
            return image->read_tiles(0, 0, spec.x, spec.x + spec.width, from, to, spec.z, spec.z + 1, 0,
                                     channels, type, into);
        }
        return image->read_scanlines(0, 0, from, to, spec.z, 0, channels, type, into);
    }
};

HeightRows::HeightRows() = default;
HeightRows::~HeightRows() = default;
HeightRows::HeightRows(HeightRows&&) noexcept = default;

namespace {

tl::unexpected<Error> brokenImage(const std::filesystem::path& file, const OIIO::ImageInput& input) {
    const std::string reason(trimmed(input.geterror()));
    return failure(file.string(), {}, reason.empty() ? "cannot be decoded" : "cannot be decoded: " + reason,
                   "the file is damaged, or a variant that is not supported");
}

template <class T>
void toDoubles(const std::vector<std::uint8_t>& bytes, std::span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        T value;
        std::memcpy(&value, &bytes[i * sizeof(T)], sizeof(T));
        out[i] = static_cast<double>(value);
    }
}

// What OpenImageIO reads without scaling it; half floats are widened.
OIIO::TypeDesc plainType(const OIIO::ImageSpec& spec) {
    const OIIO::TypeDesc type = spec.channelformat(0);
    return type.basetype == OIIO::TypeDesc::HALF ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : type;
}

bool convert(OIIO::TypeDesc type, const std::vector<std::uint8_t>& bytes, std::span<double> out) {
    switch (type.basetype) {
        case OIIO::TypeDesc::UINT8:
            toDoubles<std::uint8_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::INT8:
            toDoubles<std::int8_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::UINT16:
            toDoubles<std::uint16_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::INT16:
            toDoubles<std::int16_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::UINT32:
            toDoubles<std::uint32_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::INT32:
            toDoubles<std::int32_t>(bytes, out);
            return true;
        case OIIO::TypeDesc::FLOAT:
            toDoubles<float>(bytes, out);
            return true;
        case OIIO::TypeDesc::DOUBLE:
            toDoubles<double>(bytes, out);
            return true;
        default:
            return false;
    }
}

}  // namespace

Result<HeightRows> HeightRows::open(const std::filesystem::path& file) {
    Result<FileReader> reader = FileReader::open(file);
    if (!reader) return passOn(reader);
    const FileBytes bytes(std::move(*reader));
    const std::optional<ImageFormat> format = recogniseImage(bytes, file.string());
    if (!format) {
        return failure(file.string(), "byte 0", "is not an image that can be read as a height map",
                       "use TIFF, PNG or OpenEXR");
    }
    HeightRows rows;
    rows.file_ = file;
    rows.input_ = std::make_unique<Input>();
    rows.input_->image = OIIO::ImageInput::create(format->plugin);
    if (!rows.input_->image) {
        return failure(file.string(), {},
                       std::string("needs the plugin '") + format->plugin + "' of OpenImageIO");
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec& spec = rows.input_->spec;
    if (!rows.input_->image->open(file.string(), spec, config)) return brokenImage(file, *rows.input_->image);
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
        return failure(file.string(), "header",
                       "has " + size + " of " + std::to_string(spec.nchannels) + " channels");
    }
    if (spec.width > kMaxRowsSide || spec.height > kMaxRowsSide) {
        return failure(file.string(), "header", "has " + size,
                       "height maps may have " + std::to_string(kMaxRowsSide) + " pixels a side");
    }
    const double decoded = static_cast<double>(spec.width) * spec.height * spec.nchannels *
                           static_cast<double>(spec.format.size());
    if (decoded >
        (static_cast<double>(bytes.sizeBytes()) + 64.0) * static_cast<double>(kMaxTextureInflation)) {
        return failure(file.string(), "header",
                       "promises " + size + " in " + std::to_string(bytes.sizeBytes()) + " bytes",
                       "the file is cut off or damaged");
    }
    rows.width_ = static_cast<std::uint32_t>(spec.width);
    rows.height_ = static_cast<std::uint32_t>(spec.height);
    return rows;
}

Result<void> HeightRows::readValues(
    const std::function<Result<void>(std::uint32_t, std::span<const double>)>& take) {
    const OIIO::TypeDesc type = plainType(input_->spec);
    const std::uint32_t strip = input_->stripRows();
    std::vector<std::uint8_t> bytes(std::size_t{strip} * width_ * type.size());
    std::vector<double> values(std::size_t{strip} * width_);
    for (std::uint32_t row = 0; row < height_; row += strip) {
        const std::uint32_t end = std::min(height_, row + strip);
        if (!input_->read(row, end, 1, type, bytes.data())) return brokenImage(file_, *input_->image);
        const std::span<double> out = std::span(values).first(std::size_t{end - row} * width_);
        if (!convert(type, bytes, out)) {
            return failure(file_.string(), "header",
                           std::string("has pixels of a type that holds no heights: ") + type.c_str());
        }
        if (Result<void> taken = take(row, out); !taken) return taken;
    }
    return {};
}

}  // namespace fb
