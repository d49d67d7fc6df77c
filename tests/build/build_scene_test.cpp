#include "build/build_scene.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <atomic>
#include <cmath>

#include "block_worlds.h"
#include "worlds/files_of.h"

namespace fb {
namespace {

namespace fs = std::filesystem;
using test::blockOf;
using test::filesOf;
using test::makeSheet;

// Five blocks side by side: 0, 2 and 4 textured, 1 not, 3 without any triangle when `withGap`.
class Street : public BlockSource {
  public:
    Street() {
        info_.name = "street";
        info_.origin = {5e5, 0, 6.5e6};
        info_.up = UpAxis::z;
        info_.sourceHash = 77;
        info_.walks.push_back({{{0, 0, 0}, {10, 0, 0}}});
    }
    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] std::size_t blockCount() const override { return 5; }
    [[nodiscard]] Result<SourceBlock> load(std::size_t index) const override {
        ++loads;
        if (broken == static_cast<int>(index)) return failure("street.obj", "block", "cannot be read");
        const double left = 16.0 * static_cast<double>(index);
        SourceMesh mesh =
            makeSheet({16, 16, 16.0, 8.0, [&](double x, double y) { return 0.2 * std::sin(left + x * y); }});
        for (glm::dvec3& p : mesh.positions) p.x += left;
        if (withGap && index == 3) mesh.triangles.clear();
        if (empty) mesh.triangles.clear();
        const auto image = test::paintImage(
            32, 32, [&](int x, int y) { return glm::u8vec3(x * 8, y * 8, static_cast<int>(index) * 40); });
        SourceBlock block = blockOf(std::move(mesh), index == 1 ? nullptr : image);
        block.name = "block " + std::to_string(index);
        return block;
    }

    bool withGap = false, empty = false;
    int broken = -1;
    mutable std::atomic<int> loads = 0;

  private:
    SourceInfo info_;
};

class BuildScene : public testing::Test {
  protected:
    BuildScene() {
        settings.desiredTriangles = 64;
        root_ = fs::temp_directory_path() / ("frontbench-build-" + std::to_string(getpid()));
        fs::remove_all(root_);
    }
    ~BuildScene() override { fs::remove_all(root_); }

    [[nodiscard]] fs::path folder(const std::string& name) const { return root_ / name; }
    static bool goOn(std::string_view, double) { return true; }

    BuildSettings settings;
    Street street;

  private:
    fs::path root_;
};

TEST_F(BuildScene, WritesASceneThatOpensAndPassesTheCheck) {
    const Result<BuildReport> report = buildScene(street, settings, folder("a.fbscene"), goOn);
    ASSERT_TRUE(report) << report.error().oneLine();
    EXPECT_EQ(report->blocks, 5u);
    EXPECT_EQ(report->sourceTriangles, 5u * 512u);
    EXPECT_NEAR(report->leafAreaSquareMetres, report->sourceAreaSquareMetres,
                1e-6 * report->sourceAreaSquareMetres);
    const Result<Scene> scene = openScene(folder("a.fbscene"));
    ASSERT_TRUE(scene) << scene.error().oneLine();
    EXPECT_EQ(scene->hierarchy.rootCount, 5u);
    EXPECT_EQ(scene->hierarchy.size(), report->nodes);
    EXPECT_EQ(scene->info.name, "street");
    EXPECT_EQ(scene->info.origin, glm::dvec3(5e5, 0, 6.5e6));
    EXPECT_EQ(scene->info.up, UpAxis::z);
    EXPECT_EQ(scene->info.sourceTriangles, 5u * 512u);
    EXPECT_EQ(scene->info.walks.size(), 1u);
    EXPECT_NEAR(scene->info.bounds.max.x, 80.0, 1e-4);
    const Result<SceneCheck> check = checkScene(folder("a.fbscene"), goOn);
    ASSERT_TRUE(check);
    EXPECT_TRUE(check->faults.empty()) << check->faults.front();
    EXPECT_EQ(check->payloads, report->nodes);
}

TEST_F(BuildScene, GivesTheSameBytesForAnyNumberOfThreads) {
    for (const std::size_t threads : {1u, 2u, 7u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        ASSERT_TRUE(buildScene(street, settings, folder(std::to_string(threads)), goOn));
    }
    EXPECT_EQ(filesOf(folder("1")), filesOf(folder("2")));
    EXPECT_EQ(filesOf(folder("1")), filesOf(folder("7")));
    EXPECT_EQ(filesOf(folder("1")).size(), 7u);  // hierarchy.bin, scene.toml, five packs
}

TEST_F(BuildScene, GivesTheSameBytesInParts) {
    street.withGap = true;  // a block without a pack
    ASSERT_TRUE(buildScene(street, settings, folder("whole"), goOn));
    for (const std::uint32_t parts : {1u, 2u, 3u, 8u}) {
        const fs::path here = folder(std::to_string(parts));
        std::uint64_t nodes = 0;
        for (std::uint32_t i = parts; i-- > 0;) {
            const Result<BuildReport> part = buildPart(street, settings, here, goOn, {}, {i, parts});
            ASSERT_TRUE(part) << part.error().oneLine();
            EXPECT_EQ(part->blocks, (5u + parts - 1 - i) / parts);
            nodes += part->nodes;
        }
        EXPECT_FALSE(fs::exists(here / "hierarchy.bin"));
        const Result<BuildReport> joined = joinParts(street, settings, here, goOn, {});
        ASSERT_TRUE(joined) << joined.error().oneLine();
        EXPECT_EQ(joined->nodes, nodes);
        EXPECT_EQ(joined->leafTriangles, 4u * 512u);
        EXPECT_EQ(filesOf(here), filesOf(folder("whole")));
    }
}

TEST_F(BuildScene, JoiningTakesPacksUnreadButForMissingOnes) {
    ASSERT_TRUE(buildPart(street, settings, folder("a"), goOn, {}, {0, 1}));
    street.loads = 0;
    ASSERT_TRUE(joinParts(street, settings, folder("a"), goOn, {}));
    EXPECT_EQ(street.loads, 0);
    fs::remove(folder("a") / "blocks" / "00002.pack");
    ASSERT_TRUE(joinParts(street, settings, folder("a"), goOn, {}));
    EXPECT_EQ(street.loads, 1);
}

TEST_F(BuildScene, GivesTheSameBytesWithinAMemoryLimit) {
    ASSERT_TRUE(buildScene(street, settings, folder("whole"), goOn));
    const BuildResources resources{.memoryLimitBytes = kLeastMemoryLimitBytes, .threads = 3};
    const Result<BuildReport> limited = buildScene(street, settings, folder("limited"), goOn, resources);
    ASSERT_TRUE(limited);
    EXPECT_TRUE(limited->warnings.empty());
    EXPECT_EQ(filesOf(folder("whole")), filesOf(folder("limited")));
}

TEST_F(BuildScene, ClearsAwayWhatKilledWritersHadBegun) {
    ASSERT_TRUE(buildScene(street, settings, folder("a"), goOn));
    const auto whole = filesOf(folder("a"));
    for (const char* name : {"blocks/00003.pack.aB3dE6.part", "scene.toml.zZ9yY8.part"})
        std::ofstream(folder("a") / name) << "half";
    ASSERT_TRUE(buildScene(street, settings, folder("a"), goOn));
    EXPECT_EQ(filesOf(folder("a")), whole);
    std::ofstream(folder("a") / "blocks/00001.pack.aB3dE6.part") << "half";
    ASSERT_TRUE(joinParts(street, settings, folder("a"), goOn, {}));
    EXPECT_EQ(filesOf(folder("a")), whole);
}

TEST_F(BuildScene, TakesUpAStoppedBuildWithTheSameResult) {
    ASSERT_TRUE(buildScene(street, settings, folder("whole"), goOn));
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Result<BuildReport> stopped =
        buildScene(street, settings, folder("resumed"),
                   [](std::string_view, double fraction) { return fraction < 0.5; });
    ASSERT_FALSE(stopped);
    EXPECT_NE(stopped.error().oneLine().find("stopped"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder("resumed") / "hierarchy.bin"));
    const Result<BuildReport> resumed = buildScene(street, settings, folder("resumed"), goOn);
    ASSERT_TRUE(resumed) << resumed.error().oneLine();
    EXPECT_EQ(resumed->reusedBlocks, 3u);  // three of five were done when the fraction passed one half
    EXPECT_EQ(filesOf(folder("whole")), filesOf(folder("resumed")));
}

TEST_F(BuildScene, ReusesNothingBuiltWithOtherSettingsOrFromOtherBlocks) {
    ASSERT_TRUE(buildScene(street, settings, folder("a"), goOn));
    EXPECT_EQ(buildScene(street, settings, folder("a"), goOn)->reusedBlocks, 5u);
    street.withGap = true;  // changes block 3 only
    EXPECT_EQ(buildScene(street, settings, folder("a"), goOn)->reusedBlocks, 4u);
    settings.jpegQuality = 80;
    EXPECT_EQ(buildScene(street, settings, folder("a"), goOn)->reusedBlocks, 0u);
}

TEST_F(BuildScene, ReportsReusedBlocksAsItReportsBuiltOnes) {
    const Result<BuildReport> built = buildScene(street, settings, folder("a"), goOn);
    const Result<BuildReport> reused = buildScene(street, settings, folder("a"), goOn);
    ASSERT_TRUE(built && reused);
    EXPECT_EQ(reused->nodes, built->nodes);
    EXPECT_EQ(reused->leafTriangles, built->leafTriangles);
    EXPECT_EQ(reused->sourceTriangles, built->sourceTriangles);
    EXPECT_NEAR(reused->sourceAreaSquareMetres, built->sourceAreaSquareMetres, 1e-9);
    EXPECT_NEAR(reused->leafAreaSquareMetres, built->leafAreaSquareMetres, 1e-9);
}

TEST_F(BuildScene, LeavesOutEmptyBlocksWithAWarning) {
    street.withGap = true;
    const Result<BuildReport> report = buildScene(street, settings, folder("a"), goOn);
    ASSERT_TRUE(report) << report.error().oneLine();
    ASSERT_EQ(report->warnings.size(), 1u);
    EXPECT_NE(report->warnings[0].find("block 3"), std::string::npos);
    const Result<Scene> scene = openScene(folder("a"));
    ASSERT_TRUE(scene) << scene.error().oneLine();
    EXPECT_EQ(scene->hierarchy.rootCount, 4u);
    EXPECT_TRUE(checkScene(folder("a"), goOn)->faults.empty());
}

TEST_F(BuildScene, RefusesASceneWithoutAnyTriangle) {
    street.empty = true;
    const Result<BuildReport> report = buildScene(street, settings, folder("a"), goOn);
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().oneLine().find("no triangle"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder("a") / "hierarchy.bin"));
}

TEST_F(BuildScene, PassesOnTheErrorOfABlockThatCannotBeLoaded) {
    street.broken = 2;
    const Result<BuildReport> report = buildScene(street, settings, folder("a"), goOn);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().file, "street.obj");
    EXPECT_FALSE(fs::exists(folder("a") / "hierarchy.bin"));
}

TEST_F(BuildScene, SaysWhenTheFolderCannotBeWritten) {
    std::ofstream(fs::temp_directory_path() / ("frontbench-file-" + std::to_string(getpid()))) << "a file";
    const fs::path file = fs::temp_directory_path() / ("frontbench-file-" + std::to_string(getpid()));
    EXPECT_FALSE(buildScene(street, settings, file / "scene", goOn));
    fs::remove(file);
}

TEST_F(BuildScene, TellsProgressThatNeverFalls) {
    double last = 0.0;
    std::string phase;
    int calls = 0;
    const Progress progress = [&](std::string_view now, double fraction) {
        if (now != phase) last = 0.0;
        phase = now;
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++calls;
        return true;
    };
    ASSERT_TRUE(buildScene(street, settings, folder("a"), progress));
    EXPECT_GE(calls, 7);  // the start, five blocks, writing
    EXPECT_EQ(last, 1.0);
}

TEST_F(BuildScene, WorksWithoutAProgressFunction) {
    EXPECT_TRUE(buildScene(street, settings, folder("a"), Progress()));
}

}  // namespace
}  // namespace fb
