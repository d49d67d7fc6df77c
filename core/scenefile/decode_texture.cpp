#include "scenefile/decode_texture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <vector>

#include "base/check.h"

namespace fb {
namespace {

constexpr int kRowsAtOnce = 64;  // stays in the second-level cache while it is widened

std::string sizeText(int width, int height, int channels, const char* type) {
    return std::to_string(width) + " x " + std::to_string(height) + " x " + std::to_string(channels) + " " +
           type;
}

// Texels of 1 to 4 channels -> RGBA.
void widen(const std::uint8_t* from, std::size_t texels, int channels, std::uint8_t* into) {
    switch (channels) {
        case 1:
            for (std::size_t i = 0; i < texels; ++i, from += 1, into += 4) {
                into[0] = into[1] = into[2] = from[0];
                into[3] = 255;
            }
            break;
        case 2:
            for (std::size_t i = 0; i < texels; ++i, from += 2, into += 4) {
                into[0] = into[1] = into[2] = from[0];
                into[3] = from[1];
            }
            break;
        case 3:
            for (std::size_t i = 0; i < texels; ++i, from += 3, into += 4) {
                into[0] = from[0];
                into[1] = from[1];
                into[2] = from[2];
                into[3] = 255;
            }
            break;
        default:
            std::copy_n(from, texels * 4, into);
    }
}

// The native call: the one that converts takes 64 MiB of scratch memory for the smallest image
// (OpenImageIO 2.4).
bool readRows(OIIO::ImageInput& input, const NodeTexture& texture, std::uint8_t* into) {
    const std::size_t rowTexels = texture.width;
    std::vector<std::uint8_t> rows(rowTexels * texture.channels * kRowsAtOnce);
    for (int y = 0; y < texture.height; y += kRowsAtOnce) {
        const int end = std::min<int>(y + kRowsAtOnce, texture.height);
        if (!input.read_native_scanlines(0, 0, y, end, 0, rows.data())) return false;
        const std::size_t texels = rowTexels * static_cast<std::size_t>(end - y);
        widen(rows.data(), texels, texture.channels, into);
        into += texels * 4;
    }
    return true;
}

}  // namespace

Result<void> decodeTexture(const NodeTexture& texture, std::span<std::uint8_t> into,
                           const std::string& what) {
    FB_CHECK(into.size() == std::size_t{texture.width} * texture.height * 4);
    const bool jpeg = texture.codec == PayloadCodec::jpeg;
    // The format is given by name: opening by content would let any of OpenImageIO's readers at the bytes.
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(jpeg ? "jpeg" : "png");
    if (!input) return failure(what, "texture", "this OpenImageIO cannot read it: " + OIIO::geterror());
    input->threads(1);

    OIIO::Filesystem::IOMemReader memory(texture.encoded.data(), texture.encoded.size());
    if (!input->set_ioproxy(&memory))
        return failure(what, "texture", "this OpenImageIO cannot read from memory");
    OIIO::ImageSpec wish, found;
    wish.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied with alpha
    if (!input->open(jpeg ? "texture.jpg" : "texture.png", found, wish)) {
        return failure(what, "texture", "cannot be opened: " + input->geterror());
    }
    if (found.width != texture.width || found.height != texture.height ||
        found.nchannels != texture.channels || found.depth != 1 || found.format != OIIO::TypeUInt8) {
        return failure(what, "texture",
                       "is " + sizeText(found.width, found.height, found.nchannels, found.format.c_str()) +
                           " instead of " +
                           sizeText(texture.width, texture.height, texture.channels, "uint8"));
    }
    if (!readRows(*input, texture, into.data())) {
        return failure(what, "texture", "cannot be decoded: " + input->geterror());
    }
    return {};
}

}  // namespace fb
