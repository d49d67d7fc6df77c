// Textures that blocks share are read once a build, whatever the threads and the cache.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "block_worlds.h"
#include "build/build_scene.h"
#include "worlds/files_of.h"
#include "worlds/picture_files.h"
#include "worlds/scratch_folder.h"

namespace fb {
namespace {

using test::addSquare;
using test::emptyBlock;
using test::filesOf;
using test::mixedBytes;
using test::PictureKind;
using test::writePicture;

// Six blocks of one row of tiles each that share two textures in files.
class TwoTextures : public BlockSource {
  public:
    TwoTextures(std::vector<SourceTexture> textures, const glm::vec2& size)
        : textures_(std::move(textures)), size_(size) {
        info_.name = "shared";
    }
    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return 6; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t index) const override {
        SourceBlock block = emptyBlock(textures_);
        block.name = "block " + std::to_string(index);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const auto x = static_cast<float>(i * 120 + 5), y = static_cast<float>(5 - static_cast<int>(index)) * 80.0f;
            addSquare(block, i % 2, {x, y}, 70, size_);
        }
        return block;
    }

  private:
    std::vector<SourceTexture> textures_;
    glm::vec2 size_;
    SourceInfo info_;
};

TEST(SharedTextures, AreDecodedAndHashedOnceABuildAndDoNotDependOnThreadsOrCache) {
    const ScratchFolder folder;
    const PictureKind rows{512, 512, 3}, tiles{512, 512, 3, OIIO::TypeDesc::UINT8, 64};
    ASSERT_TRUE(writePicture(folder / "a.png", rows, mixedBytes(rows)));
    ASSERT_TRUE(writePicture(folder / "b.tif", tiles, mixedBytes(tiles)));
    const TwoTextures source({{"a", folder / "a.png", {}, {}}, {"b", folder / "b.tif", {}, {}}}, {512, 512});
    const Result<BuildReport> large = buildScene(source, BuildSettings{}, folder / "large", nullptr);
    ASSERT_TRUE(large) << large.error().oneLine();
    EXPECT_TRUE(large->warnings.empty());
    EXPECT_EQ(large->textures.opened, 2u);
    EXPECT_EQ(large->textures.filesHashed, 2u);
    EXPECT_EQ(large->textures.startedOver, 0u);
    // Of the file in rows everything, of the file in tiles what the squares touch: in each row of squares, columns 125
    // to 195 and 365 to 435 are tiles 1, 2, 3 and 5, 6; rows 5 to 475 are all eight.
    EXPECT_EQ(large->textures.texelsDecoded, 512u * 512u + 5u * 8u * 64u * 64u);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Result<BuildReport> small = buildScene(source, BuildSettings{}, folder / "small", nullptr, {.textureCacheBytes = 0});
    ASSERT_TRUE(small) << small.error().oneLine();
    EXPECT_EQ(small->textures.opened, 2u);
    EXPECT_EQ(filesOf(folder / "large"), filesOf(folder / "small"));
    EXPECT_EQ(filesOf(folder / "large").size(), 8u);
}

}  // namespace
}  // namespace fb
