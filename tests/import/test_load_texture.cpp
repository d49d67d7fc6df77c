#include <OpenImageIO/imageio.h>

#include <cmath>

#include "temp_folder.h"

// OpenImageIO 2.4 loses about 30 bytes of error text for each damaged PNG that it reads (libpng leaves the
// decoder by longjmp); this program reads many.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOpenImageIO\n";
}

namespace fb::test {
namespace {

std::vector<std::uint8_t> fromHex(std::string_view hex) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    }
    return bytes;
}

// Writes an image with OpenImageIO; `numbers` row by row, as `type`.
template <class T>
std::filesystem::path writeImage(const TempFolder& folder, const std::string& name, int width, int height,
                                 int channels, OIIO::TypeDesc type, const std::vector<T>& numbers) {
    const std::filesystem::path file = folder.path() / name;
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output) << name;
    OIIO::ImageSpec spec(width, height, channels, type);
    if (channels % 2 == 0) spec.alpha_channel = channels - 1;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    EXPECT_TRUE(output->open(file.string(), spec)) << output->geterror();
    EXPECT_TRUE(output->write_image(type, numbers.data()));
    EXPECT_TRUE(output->close());
    return file;
}

Result<Image> loadFile(const std::filesystem::path& file) {
    SourceTexture texture;
    texture.name = file.filename().string();
    texture.file = file;
    return loadTexture(texture);
}

Result<Image> loadBytes(const std::vector<std::uint8_t>& bytes) {
    SourceTexture texture;
    texture.name = "image 0";
    texture.encoded = bytes;
    return loadTexture(texture);
}

std::vector<std::uint8_t> bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

const std::vector<std::uint8_t> kRgb{200, 10, 20, 0, 255, 3, 1, 2, 3, 90, 91, 92, 4, 5, 6, 7, 8, 9};

TEST(LoadTexture, ReadsLosslessFilesTopRowFirst) {
    const TempFolder folder;
    for (const char* name : {"t.png", "t.tif", "t.bmp", "t.tga", "t.ppm"}) {
        const Result<Image> image = loadFile(writeImage(folder, name, 3, 2, 3, OIIO::TypeUInt8, kRgb));
        ASSERT_TRUE(image) << name << image.error().oneLine();
        EXPECT_EQ(image->width, 3);
        EXPECT_EQ(image->height, 2);
        EXPECT_EQ(image->channels, 3);
        EXPECT_EQ(image->pixels, kRgb) << name;
        EXPECT_TRUE(image->lossless) << name;
    }
}

TEST(LoadTexture, ReadsEncodedBytesInMemoryAndFilesWithTheWrongExtension) {
    const TempFolder folder;
    const auto png = writeImage(folder, "t.png", 3, 2, 3, OIIO::TypeUInt8, kRgb);
    const Result<Image> inMemory = loadBytes(bytesOf(png));
    ASSERT_TRUE(inMemory);
    EXPECT_EQ(inMemory->pixels, kRgb);
    std::filesystem::rename(png, folder.path() / "t.jpg");
    EXPECT_EQ(loadFile(folder.path() / "t.jpg")->pixels, kRgb);
}

TEST(LoadTexture, KeepsAlphaAndTheColoursUnderIt) {
    const TempFolder folder;
    const std::vector<std::uint8_t> rgba{200, 100, 50, 128, 40, 80, 120, 0};
    for (const char* name : {"t.png", "t.tif", "t.tga"}) {
        const Result<Image> image = loadFile(writeImage(folder, name, 2, 1, 4, OIIO::TypeUInt8, rgba));
        ASSERT_TRUE(image) << name;
        EXPECT_EQ(image->channels, 4);
        EXPECT_EQ(image->pixels, rgba) << name;
    }
}

TEST(LoadTexture, UndoesTheMultiplicationWithAlphaThatTheWebpPluginDoes) {
    // 8 x 8 lossless WebP of (204,102,51) at alpha 128.
    const Result<Image> image =
        loadBytes(fromHex("524946461e000000574542505650384c110000002f07c001100750b33277a6808188e87f0000"));
    ASSERT_TRUE(image) << image.error().oneLine();
    EXPECT_TRUE(image->lossless);
    ASSERT_EQ(image->channels, 4);
    EXPECT_NEAR(image->pixels[0], 204, 1);
    EXPECT_NEAR(image->pixels[1], 102, 1);
    EXPECT_NEAR(image->pixels[2], 51, 1);
    EXPECT_EQ(image->pixels[3], 128);
}

TEST(LoadTexture, ReadsGreyGreyWithAlphaAndSixteenBits) {
    const TempFolder folder;
    const Result<Image> grey = loadFile(
        writeImage(folder, "g.png", 3, 1, 1, OIIO::TypeUInt8, std::vector<std::uint8_t>{0, 77, 255}));
    EXPECT_EQ(grey->channels, 1);
    EXPECT_EQ(grey->pixels, (std::vector<std::uint8_t>{0, 77, 255}));
    const Result<Image> greyAlpha = loadFile(
        writeImage(folder, "ga.png", 2, 1, 2, OIIO::TypeUInt8, std::vector<std::uint8_t>{9, 255, 200, 64}));
    EXPECT_EQ(greyAlpha->channels, 2);
    EXPECT_EQ(greyAlpha->pixels, (std::vector<std::uint8_t>{9, 255, 200, 64}));
    // 257 is 1/255 of 65535.
    const Result<Image> deep =
        loadFile(writeImage(folder, "d.png", 2, 1, 3, OIIO::TypeUInt16,
                            std::vector<std::uint16_t>{0, 257, 65535, 128 * 257, 200 * 257, 3 * 257}));
    EXPECT_EQ(deep->channels, 3);
    EXPECT_EQ(deep->pixels, (std::vector<std::uint8_t>{0, 1, 255, 128, 200, 3}));
}

TEST(LoadTexture, EncodesLinearFloatsAsSrgbAndClipsThem) {
    const TempFolder folder;
    const Result<Image> image =
        loadFile(writeImage(folder, "h.exr", 2, 1, 3, OIIO::TypeFloat,
                            std::vector<float>{0.0f, 0.5f, 1.0f, 7.0f, -1.0f, 0.001f}));
    ASSERT_TRUE(image) << image.error().oneLine();
    // 0.5 is 0.735357 in sRGB, times 255 is 187.5; half floats hold 0.5 exactly. 0.001 * 12.92 * 255 is 3.3.
    EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{0, 188, 255, 255, 0, 3}));
    const Result<Image> tiff =
        loadFile(writeImage(folder, "f.tif", 2, 1, 1, OIIO::TypeFloat, std::vector<float>{0.0f, 1.0f}));
    ASSERT_TRUE(tiff);
    EXPECT_EQ(tiff->pixels, (std::vector<std::uint8_t>{0, 255}));
}

TEST(LoadTexture, ReadsPalettesAndCmyk) {
    // 2 x 1 PNG with the palette (200,10,20), (30,40,250 at alpha 128).
    const Result<Image> palette =
        loadBytes(fromHex("89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c5445"
                          "c80a141e28fadb9ac6ad"
                          "0000000274524e53ff80080fb36a0000000b49444154789c636060040000040002bf7a3f4a00000000"
                          "49454e44ae426082"));
    ASSERT_TRUE(palette) << palette.error().oneLine();
    EXPECT_EQ(palette->channels, 4);
    EXPECT_EQ(palette->pixels, (std::vector<std::uint8_t>{200, 10, 20, 255, 30, 40, 250, 128}));
    // 8 x 8 JPEG of four inks, magenta and yellow full: red.
    const Result<Image> cmyk =
        loadBytes(fromHex("ffd8ffee000e41646f626500640000000002ffdb004300100b0c0e0c0a100e0d0e1211101318281a18"
                          "1616183123251d283a333d3c39"
                          "33383740485c4e404457453738506d51575f626768673e4d71797064785c656763ffdb004301111212"
                          "1815182f1a1a2f634238426363"
                          "6363636363636363636363636363636363636363636363636363636363636363636363636363636363"
                          "63636363636363ffc000140800"
                          "08000804012200021101031101042200ffc400160001010100000000000000000000000000000507ff"
                          "c4001410010000000000000000"
                          "0000000000000000ffc4001501010100000000000000000000000000000506ffc40014110100000000"
                          "000000000000000000000000ff"
                          "da000e040100021103110400003f00b401441b4001ffd9"));
    ASSERT_TRUE(cmyk) << cmyk.error().oneLine();
    ASSERT_EQ(cmyk->channels, 3);
    EXPECT_FALSE(cmyk->lossless);
    EXPECT_GT(cmyk->pixels[0], 240);
    EXPECT_LT(cmyk->pixels[1], 10);
    EXPECT_LT(cmyk->pixels[2], 10);
}

TEST(LoadTexture, TakesTheFirstThreeOfManyChannels) {
    const TempFolder folder;
    const auto file = folder.path() / "many.tif";
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    OIIO::ImageSpec spec(1, 1, 5, OIIO::TypeUInt8);
    spec.channelnames = {"R", "G", "B", "near", "far"};
    spec.alpha_channel = -1;
    ASSERT_TRUE(output->open(file.string(), spec));
    const std::uint8_t pixel[5]{1, 2, 3, 4, 5};
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixel));
    ASSERT_TRUE(output->close());
    const Result<Image> image = loadFile(file);
    ASSERT_TRUE(image) << image.error().oneLine();
    EXPECT_EQ(image->channels, 3);
    EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{1, 2, 3}));
}

TEST(LoadTexture, TellsLosslessFromLossyJpeg) {
    const TempFolder folder;
    const std::vector<std::uint8_t> flat(16 * 16 * 3, 120);
    const Result<Image> jpeg = loadFile(writeImage(folder, "t.jpg", 16, 16, 3, OIIO::TypeUInt8, flat));
    ASSERT_TRUE(jpeg);
    EXPECT_FALSE(jpeg->lossless);
    EXPECT_NEAR(jpeg->pixels[100], 120, 2);
}

TEST(LoadTexture, RefusesHeadersThatPromiseMorePixelsThanThereCanBe) {
    // TGA: uncompressed true colour, 65535 x 65535 x 32 bits are 16 GB, in 26 bytes.
    Bytes tga;
    tga.add(std::uint8_t{0}).add(std::uint8_t{0}).add(std::uint8_t{2});
    for (int i = 0; i < 9; ++i) tga.add(std::uint8_t{0});
    tga.add(std::uint16_t{65535}).add(std::uint16_t{65535}).add(std::uint8_t{32}).add(std::uint8_t{8});
    tga.add("12345678");
    ASSERT_EQ(tga.text().size(), 26u);
    const TempFolder folder;
    const Result<Image> bomb = loadFile(folder.write("bomb.tga", tga.text()));
    ASSERT_FALSE(bomb);
    EXPECT_TRUE(contains(bomb.error().oneLine(), "bomb.tga: header: has 65535 x 65535 pixels"))
        << bomb.error().oneLine();
    // PNG of 66 bytes: 60000 x 60000 in RGBA are above the cap, 16000 x 16000 are not, but 66 bytes cannot
    // hold them.
    const Result<Image> large =
        loadBytes(fromHex("89504e470d0a1a0a0000000d494844520000ea600000ea60080600000080d275420000000949444154"
                          "789c630000000100015eff7df9"
                          "0000000049454e44ae426082"));
    ASSERT_FALSE(large);
    EXPECT_TRUE(contains(large.error().oneLine(), "60000 x 60000")) << large.error().oneLine();
    const Result<Image> empty =
        loadBytes(fromHex("89504e470d0a1a0a0000000d4948445200003e8000003e800806000000417edfde0000000949444154"
                          "789c630000000100015eff7df9"
                          "0000000049454e44ae426082"));
    ASSERT_FALSE(empty);
    EXPECT_TRUE(contains(empty.error().oneLine(), "promises 16000 x 16000 pixels in 66 bytes"))
        << empty.error().oneLine();
}

TEST(LoadTexture, SaysWhatIsWrongWithFilesThatAreNoImage) {
    const TempFolder folder;
    EXPECT_TRUE(contains(loadFile(folder.path() / "gone.png").error().oneLine(), "gone.png"));
    EXPECT_TRUE(contains(loadFile(folder.write("a.png", "")).error().oneLine(), "is empty"));
    EXPECT_TRUE(contains(loadFile(folder.write("b.png", "hello")).error().oneLine(),
                         "is not an image that can be read"));
    SourceTexture nothing;
    nothing.name = "nothing";
    EXPECT_FALSE(loadTexture(nothing));
}

TEST(LoadTexture, NeverCrashesOnPrefixesOfAnImage) {
    const TempFolder folder;
    for (const char* name : {"t.png", "t.jpg", "t.tif", "t.bmp"}) {
        std::vector<std::uint8_t> numbers(16 * 16 * 3);
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i * 7);
        const std::vector<std::uint8_t> whole =
            bytesOf(writeImage(folder, name, 16, 16, 3, OIIO::TypeUInt8, numbers));
        ASSERT_TRUE(loadBytes(whole)) << name;
        for (std::size_t size = 0; size < whole.size(); size += whole.size() / 40 + 1) {
            // Some libraries fill up what is missing; what comes back must have the size that it says.
            const Result<Image> image =
                loadBytes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
            if (!image) continue;
            EXPECT_EQ(image->pixels.size(), 16u * 16u * static_cast<std::size_t>(image->channels));
        }
    }
}

TEST(LoadTexture, GivesPixelsInMemoryBackIfTheyMatchTheirSize) {
    SourceTexture texture;
    texture.name = "made";
    Image image{2, 1, 3, {1, 2, 3, 4, 5, 6}, true};
    texture.image = std::make_shared<Image>(image);
    EXPECT_EQ(loadTexture(texture)->pixels, image.pixels);
    image.pixels.pop_back();
    texture.image = std::make_shared<Image>(image);
    EXPECT_FALSE(loadTexture(texture));
}

}  // namespace
}  // namespace fb::test
