// What policy `full` draws is what the source is: from a mesh to pixels, through build, scene file, loading and drawing.
#include <gtest/gtest.h>

#include "build/build_scene.h"
#include "import/city.h"
#include "run_program.h"
#include "worlds/compare_with_source.h"

namespace fb {
namespace {

BuildReport buildInto(const BlockSource& source, const std::filesystem::path& folder, TextureCodec codec) {
    BuildSettings settings;
    settings.textureCodec = codec;
    const Result<BuildReport> report = buildScene(source, settings, folder, nullptr);
    EXPECT_TRUE(report) << report.error().oneLine();
    return report.value_or(BuildReport{});
}

// One block of the city: facades, roofs, ground, textured and grey.
class FullAgainstSource : public ::testing::TestWithParam<std::pair<TextureCodec, double>> {};

TEST_P(FullAgainstSource, ShowsTheSamePictureOfTheSameTriangles) {
    const auto [codec, leastDb] = GetParam();
    const test::TemporaryFolder folder;
    const auto city = makeCity({1, 30000, 1500000, 3});
    ASSERT_TRUE(city);
    const BuildReport report = buildInto(**city, folder / "city.fbscene", codec);
    EXPECT_EQ(report.sourceTriangles, (*city)->info().report.keptTriangles);
    EXPECT_NEAR(report.leafAreaSquareMetres / report.sourceAreaSquareMetres, 1.0, 1e-6);
    for (const char* path : {"fly", "walk"}) {
        const auto views = test::compareWithSource({**city, folder / "city.fbscene", path, 2});
        ASSERT_TRUE(views) << views.error().oneLine();
        for (const test::ComparedView& view : *views) {
            EXPECT_GE(view.error.psnrDb, leastDb) << path;
            EXPECT_GE(view.full.pixels.size(), 1280u * 720u * 3u);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Codecs, FullAgainstSource,
                         ::testing::Values(std::pair(TextureCodec::jpeg, 35.0),
                                           std::pair(TextureCodec::lossless, 45.0)),
                         [](const auto& codec) { return codec.param.first == TextureCodec::jpeg ? "Jpeg" : "Lossless"; });

}  // namespace
}  // namespace fb
