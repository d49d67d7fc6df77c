#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "base/check.h"
#include "build/make_atlas.h"

namespace fb {

Result<NodeTexture> encodeTexture(const Image& image, PayloadCodec codec, int jpegQuality) {
    const bool jpeg = codec == PayloadCodec::jpeg;
    FB_CHECK((jpeg || codec == PayloadCodec::png));
    FB_CHECK((!jpeg || image.channels == 3));
    const char* name = jpeg ? "atlas.jpg" : "atlas.png";
    NodeTexture texture;
    texture.codec = codec;
    texture.width = static_cast<std::uint16_t>(image.width);
    texture.height = static_cast<std::uint16_t>(image.height);
    texture.channels = static_cast<std::uint8_t>(image.channels);

    OIIO::Filesystem::IOVecOutput memory(texture.encoded);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name, &memory);
    if (!output) return failure("", name, "OpenImageIO cannot write it: " + OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    if (jpeg) {
        spec.attribute("Compression", "jpeg:" + std::to_string(jpegQuality));
        // Halved chroma shows at sharp edges of colour; not worth it where quality is asked for.
        spec.attribute("jpeg:subsampling", jpegQuality >= 90 ? "4:4:4" : "4:2:0");
    } else {
        spec.attribute("png:compressionLevel", 6);
        spec.attribute("oiio:UnassociatedAlpha", 1);  // colours as they are, not multiplied with alpha
    }
    if (!output->open(name, spec) || !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) ||
        !output->close()) {
        return failure("", name, "the texture cannot be encoded: " + output->geterror());
    }
    return texture;
}

}  // namespace fb
