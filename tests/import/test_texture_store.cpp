#include <cstring>
#include <thread>

#include "base/random.h"
#include "import/image_format.h"
#include "import/texture_store.h"
#include "temp_folder.h"
#include "worlds/picture_files.h"

namespace fb::test {
namespace {

constexpr std::uint64_t kLargeCache = std::uint64_t{64} << 20;

SourceTexture fileTexture(const std::filesystem::path& file) { return {file.filename().string(), file, {}, {}}; }

std::vector<std::uint8_t> cutOut(const Image& image, const StoredRect& rect) {
    std::vector<std::uint8_t> texels;
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        const auto row = image.pixels.begin() +
                         static_cast<std::ptrdiff_t>((y * image.width + rect.x)) * image.channels;
        texels.insert(texels.end(), row, row + static_cast<std::ptrdiff_t>(rect.width) * image.channels);
    }
    return texels;
}

std::vector<std::uint8_t> readRect(TextureStore& store, const StoredTexture& texture, const StoredRect& rect) {
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(rect.width) * rect.height * texture.header.channels);
    const Result<void> read = store.read(texture, rect, texels.data());
    EXPECT_TRUE(read) << read.error().oneLine();
    return texels;
}

StoredRect randomRect(Random& random, int width, int height) {
    StoredRect rect;
    rect.x = static_cast<int>(random.index(static_cast<std::uint64_t>(width)));
    rect.y = static_cast<int>(random.index(static_cast<std::uint64_t>(height)));
    rect.width = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(std::min(width - rect.x, 90))));
    rect.height = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(std::min(height - rect.y, 90))));
    return rect;
}

// Every kind of file, at any cache size: rectangles have the texels that the whole picture has.
TEST(TextureStore, ReadsWhatDecodingTheWholePictureGives) {
    const TempFolder folder;
    const PictureKind rgb{300, 170, 3}, rgba{300, 170, 4}, greyAlpha{300, 170, 2}, grey{300, 170, 1};
    std::vector<std::filesystem::path> files;
    const auto add = [&](const char* name, const PictureKind& kind, const auto& numbers) {
        if (writePicture(folder.path() / name, kind, numbers)) files.push_back(folder.path() / name);
    };
    add("rgb.png", rgb, mixedBytes(rgb));
    add("rgba.png", rgba, mixedBytes(rgba));
    add("ga.png", greyAlpha, mixedBytes(greyAlpha));
    add("photo.jpg", rgb, mixedBytes(rgb));
    add("rows.tif", rgba, mixedBytes(rgba));
    PictureKind tiled = rgba;
    tiled.tile = 48;  // not the cache's own
    add("tiles.tif", tiled, mixedBytes(tiled));
    PictureKind deep = rgb;
    deep.type = OIIO::TypeDesc::UINT16;
    std::vector<std::uint16_t> deepNumbers;
    for (const std::uint8_t byte : mixedBytes(deep)) deepNumbers.push_back(static_cast<std::uint16_t>(byte * 257 + 40));
    add("deep.png", deep, deepNumbers);
    PictureKind deepGrey = grey;
    deepGrey.type = OIIO::TypeDesc::UINT16;
    deepNumbers.resize(300 * 170);
    add("deepgrey.png", deepGrey, deepNumbers);
    PictureKind linear = rgb;
    linear.type = OIIO::TypeDesc::FLOAT;
    std::vector<float> light;
    for (const std::uint8_t byte : mixedBytes(linear)) light.push_back(static_cast<float>(byte) / 200.0f);
    add("light.exr", linear, light);
    linear.tile = 32;
    add("lighttiles.exr", linear, light);
    ASSERT_GE(files.size(), 8u);  // those of OpenEXR where its plugin is there
    for (const std::uint64_t cacheBytes : {std::uint64_t{0}, kLargeCache}) {
        TextureStore store(cacheBytes);
        Random random(7);
        for (const std::filesystem::path& file : files) {
            const Result<Image> whole = loadTexture(fileTexture(file));
            ASSERT_TRUE(whole) << whole.error().oneLine();
            const Result<StoredTexture> stored = store.open(fileTexture(file));
            ASSERT_TRUE(stored) << stored.error().oneLine();
            EXPECT_EQ(stored->header.width, whole->width);
            EXPECT_EQ(stored->header.height, whole->height);
            EXPECT_EQ(stored->header.channels, whole->channels);
            EXPECT_EQ(stored->header.lossless, whole->lossless);
            for (int i = 0; i < 12; ++i) {
                const StoredRect rect = randomRect(random, whole->width, whole->height);
                ASSERT_EQ(readRect(store, *stored, rect), cutOut(*whole, rect)) << file;
            }
        }
    }
}

// Four threads, rectangles in any order: each texture is opened once and each of its texels decoded once.
TEST(TextureStore, DecodesEveryTextureOnceAsLongAsTheCacheHoldsIt) {
    const TempFolder folder;
    const PictureKind rows{500, 700, 3}, tiles{512, 640, 3, OIIO::TypeDesc::UINT8, 64};
    ASSERT_TRUE(writePicture(folder.path() / "a.png", rows, mixedBytes(rows)));
    ASSERT_TRUE(writePicture(folder.path() / "b.tif", tiles, mixedBytes(tiles)));
    TextureStore store(kLargeCache);
    std::vector<std::thread> threads;
    for (std::uint64_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            Random random(t);
            for (int i = 0; i < 40; ++i) {
                const char* const name = random.index(2) == 0 ? "a.png" : "b.tif";
                const Result<StoredTexture> stored = store.open(fileTexture(folder.path() / name));
                ASSERT_TRUE(stored);
                (void)readRect(store, *stored, randomRect(random, stored->header.width, stored->header.height));
            }
            const Result<StoredTexture> all = store.open(fileTexture(folder.path() / "b.tif"));
            (void)readRect(store, *all, {0, 0, 512, 640});
        });
    }
    for (std::thread& thread : threads) thread.join();
    const TextureStoreCounts counts = store.counts();
    EXPECT_EQ(counts.opened, 2u);
    EXPECT_EQ(counts.texelsDecoded, 500u * 700u + 512u * 640u);
    EXPECT_EQ(counts.startedOver, 0u);
}

// 4 MB of texels, 256 KB of cache.
TEST(TextureStore, ReadsPicturesLargerThanItsCache) {
    const TempFolder folder;
    for (const int tile : {0, 64}) {
        const PictureKind kind{2048, 2048, 1, OIIO::TypeDesc::UINT8, tile};
        const Image image{2048, 2048, 1, mixedBytes(kind), true};
        const std::filesystem::path file = folder.path() / ("large" + std::to_string(tile) + ".tif");
        ASSERT_TRUE(writePicture(file, kind, image.pixels));
        TextureStore store(std::uint64_t{1} << 18);
        const Result<StoredTexture> stored = store.open(fileTexture(file));
        ASSERT_TRUE(stored) << stored.error().oneLine();
        for (int round = 0; round < 2; ++round) {
            for (int y = 0; y < 2048; y += 256) {
                const StoredRect rect{y % 1300, y, 700, 200};
                ASSERT_EQ(readRect(store, *stored, rect), cutOut(image, rect));
            }
        }
        // The second round finds nothing of the first one's beginning.
        EXPECT_GT(store.counts().texelsDecoded, tile == 0 ? 2048u * 2048u : 2u * 8u * 700u * 200u);
    }
}

TEST(TextureStore, SharesEqualBytesInMemoryAndUsesPixelsAsTheyAre) {
    const TempFolder folder;
    const PictureKind kind{20, 10, 3};
    ASSERT_TRUE(writePicture(folder.path() / "a.png", kind, mixedBytes(kind)));
    std::ifstream stream(folder.path() / "a.png", std::ios::binary);
    const std::vector<std::uint8_t> png{std::istreambuf_iterator<char>(stream), {}};
    TextureStore store(kLargeCache);
    for (const char* name : {"image 0", "image 0 of another block"}) {
        const Result<StoredTexture> stored = store.open({name, {}, png, {}});
        ASSERT_TRUE(stored) << stored.error().oneLine();
        EXPECT_EQ(readRect(store, *stored, {0, 0, 20, 10}), mixedBytes(kind));
    }
    EXPECT_EQ(store.counts().opened, 1u);
    EXPECT_EQ(store.counts().texelsDecoded, 200u);
    const auto pixels = std::make_shared<const Image>(Image{20, 10, 3, mixedBytes(kind), true});
    const Result<StoredTexture> made = store.open({"made", {}, {}, pixels});
    ASSERT_TRUE(made);
    EXPECT_EQ(made->pixels, pixels);
    EXPECT_EQ(readRect(store, *made, {3, 2, 5, 4}), cutOut(*pixels, {3, 2, 5, 4}));
    auto broken = std::make_shared<Image>(*pixels);
    broken->pixels.pop_back();
    EXPECT_FALSE(store.open({"broken", {}, {}, broken}));
    EXPECT_EQ(store.counts().opened, 1u);
}

TEST(TextureStore, RemembersRefusals) {
    const TempFolder folder;
    TextureStore store(kLargeCache);
    for (int i = 0; i < 2; ++i) {
        const Result<StoredTexture> gone = store.open(fileTexture(folder.path() / "gone.png"));
        ASSERT_FALSE(gone);
        EXPECT_TRUE(contains(gone.error().oneLine(), "gone.png"));
        const Result<StoredTexture> text = store.open(fileTexture(folder.write("text.png", "hello")));
        ASSERT_FALSE(text);
        EXPECT_TRUE(contains(text.error().oneLine(), "is not an image that can be read"));
    }
    EXPECT_EQ(store.counts().opened, 2u);
}

TEST(TextureStore, ReadsLongerSidesThanFitWhenDecodedWhole) {
    const TempFolder folder;
    const PictureKind kind{40000, 3, 1};
    const std::filesystem::path file = folder.path() / "long.png";
    ASSERT_TRUE(writePicture(file, kind, mixedBytes(kind)));
    EXPECT_FALSE(loadTexture(fileTexture(file)));
    TextureStore store(kLargeCache);
    const Result<StoredTexture> stored = store.open(fileTexture(file));
    ASSERT_TRUE(stored) << stored.error().oneLine();
    const Image image{40000, 3, 1, mixedBytes(kind), true};
    EXPECT_EQ(readRect(store, *stored, {39900, 1, 100, 2}), cutOut(image, {39900, 1, 100, 2}));
}

TEST(TextureStore, HashesAFileOnceAndByItsContent) {
    const TempFolder folder;
    const std::string megabytes(std::size_t{3} << 20, 'x');
    const auto a = folder.write("a", megabytes), same = folder.write("same", megabytes),
               other = folder.write("other", megabytes + "y");
    TextureStore store(kLargeCache);
    const std::uint64_t hash = store.hashFile(a);
    EXPECT_EQ(store.hashFile(same), hash);
    EXPECT_NE(store.hashFile(other), hash);
    EXPECT_NE(store.hashFile(folder.path() / "gone"), hash);
    folder.write("a", "changed");
    EXPECT_EQ(store.hashFile(a), hash);
    EXPECT_EQ(store.counts().filesHashed, 4u);
    EXPECT_NE(TextureStore(0).hashFile(a), hash);
}

class Bytes8 final : public ByteSource {
  public:
    explicit Bytes8(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
    [[nodiscard]] std::uint64_t sizeBytes() const override { return bytes_.size(); }
    [[nodiscard]] bool readAt(std::uint64_t offset, std::span<std::uint8_t> into) const override {
        if (offset + into.size() > bytes_.size()) return false;
        std::memcpy(into.data(), bytes_.data() + offset, into.size());
        return true;
    }

  private:
    std::vector<std::uint8_t> bytes_;
};

TEST(RecogniseImage, KnowsWhichFilesAreDecodedByParts) {
    // Start of image, a comment of two bytes, then the frame: baseline or progressive.
    const auto jpeg = [](std::uint8_t frame) {
        return Bytes8({0xff, 0xd8, 0xff, 0xfe, 0, 4, 'a', 'b', 0xff, frame, 0, 17, 8, 0, 1, 0, 1});
    };
    EXPECT_TRUE(recogniseImage(jpeg(0xc0), "")->decodesByParts);
    EXPECT_FALSE(recogniseImage(jpeg(0xc2), "")->decodesByParts);
    const auto png = [](std::uint8_t interlace) {
        std::vector<std::uint8_t> bytes{0x89, 'P', 'N', 'G'};
        bytes.resize(40);
        bytes[28] = interlace;
        return Bytes8(bytes);
    };
    EXPECT_TRUE(recogniseImage(png(0), "")->decodesByParts);
    EXPECT_FALSE(recogniseImage(png(1), "")->decodesByParts);
    EXPECT_FALSE(recogniseImage(Bytes8({'G', 'I', 'F', '8'}), "")->decodesByParts);
    EXPECT_FALSE(recogniseImage(Bytes8({'h', 'e', 'l', 'l', 'o'}), "a.png"));
    EXPECT_TRUE(recogniseImage(Bytes8({'h', 'e', 'l', 'l', 'o'}), "a.TGA"));
}

}  // namespace
}  // namespace fb::test
