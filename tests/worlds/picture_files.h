// Writes pictures of every kind for the tests of textures.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace fb::test {

struct PictureKind {
    int width = 0, height = 0, channels = 3;
    OIIO::TypeDesc type = OIIO::TypeDesc::UINT8;
    int tile = 0;  // side of the tiles; 0: rows
};

// `numbers` row by row, as `kind.type`. False where the format cannot be written here.
template <class T>
bool writePicture(const std::filesystem::path& file, const PictureKind& kind, const std::vector<T>& numbers) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    if (!output) return false;
    OIIO::ImageSpec spec(kind.width, kind.height, kind.channels, kind.type);
    if (kind.channels % 2 == 0) spec.alpha_channel = kind.channels - 1;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (kind.tile > 0) spec.tile_width = spec.tile_height = kind.tile;
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(kind.type, numbers.data())) << output->geterror();
    EXPECT_TRUE(output->close());
    return true;
}

// Numbers that differ between neighbours and between the corners of the picture.
[[nodiscard]] inline std::vector<std::uint8_t> mixedBytes(const PictureKind& kind) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(static_cast<std::size_t>(kind.width) * kind.height * kind.channels);
    for (int y = 0; y < kind.height; ++y) {
        for (int x = 0; x < kind.width; ++x) {
            for (int c = 0; c < kind.channels; ++c) {
                const int tiles = (x / 64) * 31 + (y / 64) * 57;
                bytes.push_back(static_cast<std::uint8_t>((x * 7 + y * 13 + tiles + c * 90) % 251));
            }
        }
    }
    return bytes;
}

}  // namespace fb::test
