#include "app/save_picture.h"

#include <OpenImageIO/imageio.h>

namespace fb {

Result<void> savePicture(const Image& picture, const std::filesystem::path& file) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output) return failure(file.string(), {}, "this OpenImageIO cannot write PNG");
    const OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
    const bool written = output->open(file.string(), spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, picture.pixels.data()) && output->close();
    if (!written) return failure(file.string(), {}, "cannot be written: " + output->geterror());
    return {};
}

}  // namespace fb
