#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "measure/drawing.h"

namespace fb {

Result<std::vector<std::uint8_t>> pngBytes(const Image& image) {
    const std::size_t count =
        std::size_t(image.width) * std::size_t(image.height) * static_cast<std::size_t>(image.channels);
    if (image.width <= 0 || image.height <= 0 || image.channels < 1 || image.pixels.size() != count) {
        return failure({}, {}, "a picture without pixels cannot be a PNG");
    }
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("picture.png", &memory);
    if (!output) return failure({}, {}, "PNG cannot be written: " + OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const bool written = output->open("picture.png", spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) && output->close();
    if (!written) return failure({}, {}, "PNG cannot be written: " + output->geterror());
    return bytes;
}

}  // namespace fb
