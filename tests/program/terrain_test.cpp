// `build --terrain` and `city --terrain` as a user runs them: what info and check say, and answers to wrong
// options.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"

namespace fb {
namespace {

using test::ProgramRun;
using test::runProgram;
using test::TemporaryFolder;

std::string writeHills(const std::filesystem::path& file, int side) {
    std::vector<float> heights(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>((i * 7) % 11) * 0.25f;
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(output->open(file.string(), OIIO::ImageSpec(side, side, 1, OIIO::TypeDesc::FLOAT)));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, heights.data()) && output->close());
    return file.string();
}

void expectUsage(const ProgramRun& run, const std::string& part) {
    EXPECT_EQ(run.exitCode, 2) << run.err;
    EXPECT_EQ(run.errLines(), 1) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

TEST(TerrainProgram, BuildsChecksDescribesAndWalksAHeightMapAlone) {
    const TemporaryFolder folder;
    const std::string map = writeHills(folder / "hills.exr", 70), scene = (folder / "hills.fbscene").string();
    const ProgramRun built =
        runProgram("build --progress none --terrain " + map + " --cell-size 2 -o " + scene);
    ASSERT_EQ(built.exitCode, 0) << built.err;
    EXPECT_NE(built.err.find("9522 triangles in 1 block"), std::string::npos) << built.err;
    EXPECT_EQ(runProgram("check --progress none " + scene).exitCode, 0);
    const auto info = nlohmann::json::parse(runProgram("info --json " + scene).out);
    EXPECT_TRUE(info["levels"].empty());
    ASSERT_EQ(info["terrain_levels"].size(), 4u);  // 69 cells, leaves of 16
    EXPECT_EQ(info["terrain_levels"][3]["leaves"], 25);
    EXPECT_EQ(info["terrain_levels"][0]["nodes"], 1);
    EXPECT_NE(runProgram("info " + scene).out.find("\nterrain\nlevel"), std::string::npos);
    for (const char* path : {"walk", "fly"}) {
        EXPECT_EQ(runProgram("replay " + scene + " --clock model --frames 3 --path " + path + " --out " +
                             (folder / path).string())
                      .exitCode,
                  0);
    }
}

TEST(TerrainProgram, PutsAHeightMapUnderMeshes) {
    const TemporaryFolder folder;
    std::ofstream(folder / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string map = writeHills(folder / "hills.exr", 20), scene = (folder / "both.fbscene").string();
    const ProgramRun built = runProgram("build --progress none " + (folder / "t.obj").string() +
                                        " --terrain " + map + " -o " + scene);
    ASSERT_EQ(built.exitCode, 0) << built.err;
    const auto info = nlohmann::json::parse(runProgram("info --json " + scene).out);
    EXPECT_EQ(info["levels"].size(), 1u);
    EXPECT_EQ(info["terrain_levels"].size(), 2u);  // 19 cells, leaves of 16
    EXPECT_EQ(info["source_files"].size(), 2u);
    EXPECT_EQ(runProgram("check --progress none " + scene).exitCode, 0);
}

TEST(TerrainProgram, OptionsOfTerrainsNeedOneAndMustBeNumbers) {
    const TemporaryFolder folder;
    const std::string map = writeHills(folder / "hills.exr", 4), out = " -o " + (folder / "s").string();
    expectUsage(runProgram("build" + out), "INPUT: no mesh file is given, and no --terrain");
    expectUsage(runProgram("build x.obj --no-data -9999" + out), "--no-data: needs --terrain");
    expectUsage(runProgram("build x.obj --drape d.png" + out), "--drape: needs --terrain");
    expectUsage(runProgram("build --terrain " + map + " --cell-size nan" + out), "--cell-size nan");
    expectUsage(runProgram("build --terrain " + map + " --height-scale 2m" + out), "--height-scale 2m");
    EXPECT_EQ(runProgram("build --progress none --terrain " + map + " --no-data -9999" + out).exitCode, 0);
    const ProgramRun missing = runProgram("build --progress none --terrain /nowhere/map.tif" + out);
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_NE(missing.err.find("/nowhere/map.tif"), std::string::npos);
}

TEST(TerrainProgram, TheCityOnHillsHasBothHierarchies) {
    const TemporaryFolder folder;
    const std::string scene = (folder / "city.fbscene").string();
    ASSERT_EQ(runProgram("city --terrain --progress none --blocks 2 --triangles 6K --texels 40K -o " + scene)
                  .exitCode,
              0);
    const auto info = nlohmann::json::parse(runProgram("info --json " + scene).out);
    EXPECT_EQ(info["blocks"], 3);
    EXPECT_EQ(info["levels"][0]["nodes"], 2);
    EXPECT_EQ(info["terrain_levels"][0]["nodes"], 1);
    EXPECT_EQ(runProgram("check --progress none " + scene).exitCode, 0);
    EXPECT_EQ(runProgram("replay " + scene + " --clock model --frames 3 --path walk --out " +
                         (folder / "o").string())
                  .exitCode,
              0);
}

}  // namespace
}  // namespace fb
