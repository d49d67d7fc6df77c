#include <new>

#include "import/source_scene.h"
#include "import/texture_reader.h"

namespace fb {
namespace {

Result<Image> readWhole(const TextureBytes& bytes) {
    Result<std::unique_ptr<TextureReader>> reader = TextureReader::open(bytes, TextureUse::whole);
    if (!reader) return passOn(reader);
    const TextureHeader& header = (*reader)->header();
    Image image{header.width, header.height, header.channels, {}, header.lossless};
    const std::size_t row = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.channels);
    image.pixels.resize(row * static_cast<std::size_t>(header.height));
    const int step = header.tileHeight > 0 ? header.tileHeight : 64;
    for (int y = 0; y < header.height; y += step) {
        const int end = std::min(y + step, header.height);
        std::uint8_t* const into = image.pixels.data() + static_cast<std::size_t>(y) * row;
        if (Result<void> read = (*reader)->readRows(y, end, into); !read) return passOn(read);
    }
    return image;
}

}  // namespace

Result<void> checkPixels(const SourceTexture& texture) {
    const Image& image = *texture.image;
    const auto side = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
    if (image.channels < 1 || image.channels > 4 || image.width < 1 || image.height < 1 ||
        image.pixels.size() != side(image.width) * side(image.height) * side(image.channels)) {
        return failure(texture.name, {}, "has pixels that do not match its size");
    }
    return {};
}

Result<Image> loadTexture(const SourceTexture& texture) {
    try {
        if (texture.file.empty() && texture.image) {
            if (Result<void> sound = checkPixels(texture); !sound) return passOn(sound);
            return *texture.image;
        }
        return readWhole({texture.name, texture.file, texture.encoded});
    } catch (const std::bad_alloc&) {
        return failure(texture.name, {}, "needs more memory than there is");
    }
}

}  // namespace fb
