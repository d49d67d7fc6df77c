// From a mesh to a report: build, check, replay with the model clock.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "run_program.h"

namespace fb {
namespace {

using test::readText;
using test::ProgramRun;
using test::runProgram;
using test::TemporaryFolder;

// A hilly square of 2 * side^2 triangles.
void writeHills(const std::filesystem::path& file, int side) {
    std::ofstream out(file);
    for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) out << "v " << x << ' ' << std::sin(0.3 * x) * std::cos(0.2 * y) << ' ' << y << '\n';
    }
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x + 1;
            out << "f " << a << ' ' << a + side + 1 << ' ' << a + 1 << '\n';
            out << "f " << a + 1 << ' ' << a + side + 1 << ' ' << a + side + 2 << '\n';
        }
    }
}

class Replay : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        writeHills(*folder / "hills.obj", 60);
        const ProgramRun build = runProgram("build --progress none " + (*folder / "hills.obj").string() + " -o " + scene() +
                                     " --block-triangles 1500 --split grid --set build.desired_triangles=100");
        ASSERT_EQ(build.exitCode, 0) << build.err;
    }
    static void TearDownTestSuite() { folder.reset(); }
    static std::string scene() { return (*folder / "hills.fbscene").string(); }
    static nlohmann::json summaryOf(const std::string& out) {
        return nlohmann::json::parse(readText(*folder / (out + "/summary.json")));
    }
    static ProgramRun replay(const std::string& arguments, const std::string& out, const std::string& program = FB_PROGRAM) {
        return runProgram("replay " + scene() + " " + arguments + " --out " + (*folder / out).string(), program);
    }

    static inline std::unique_ptr<TemporaryFolder> folder;
};

TEST_F(Replay, TheBuiltSceneIsSound) {
    const ProgramRun check = runProgram("check --progress none " + scene());
    EXPECT_EQ(check.exitCode, 0) << check.out << check.err;
    const nlohmann::json info = nlohmann::json::parse(runProgram("info --json " + scene()).out);
    EXPECT_EQ(info["source_triangles"], 2 * 60 * 60);
    EXPECT_GE(info["blocks"], 3);
    EXPECT_GE(info["levels"].size(), 2u);
}

TEST_F(Replay, TheModelClockGivesTheSameFrontsEachTime) {
    const std::string walk = "--path walk-to-fly --clock model --frames 200 --set control.target_ms=3";
    ASSERT_EQ(replay(walk, "a").exitCode, 0);
    ASSERT_EQ(replay(walk, "b").exitCode, 0);
    EXPECT_EQ(summaryOf("a")["front_hash"], summaryOf("b")["front_hash"]);
    EXPECT_EQ(readText(*folder / "a/frames.csv").size() > 200, true);
    ASSERT_EQ(replay(walk + " --set control.target_ms=4", "c").exitCode, 0);
    EXPECT_NE(summaryOf("a")["front_hash"], summaryOf("c")["front_hash"]);
}

TEST_F(Replay, TheModelClockGivesTheSameFrontsInAnOptimisedBuild) {
    const char* release = std::getenv("FB_RELEASE_PROGRAM");
    if (!release) GTEST_SKIP() << "FB_RELEASE_PROGRAM does not name an optimised program";
    for (const std::string path : {"walk", "fly", "jump"}) {
        const std::string walk = "--path " + path + " --clock model --frames 150 --set control.target_ms=3";
        ASSERT_EQ(replay(walk, "debug").exitCode, 0);
        ASSERT_EQ(replay(walk, "release", release).exitCode, 0);
        EXPECT_EQ(summaryOf("debug")["front_hash"], summaryOf("release")["front_hash"]) << path;
    }
}

TEST_F(Replay, MoreTimeGivesMoreTrianglesAndLessError) {
    const auto at = [&](const std::string& ms) {
        const std::string out = "t" + ms;
        EXPECT_EQ(replay("--path still --settle --clock model --frames 300 --set control.target_ms=" + ms, out).exitCode, 0);
        return summaryOf(out);
    };
    const nlohmann::json little = at("2.3");
    const nlohmann::json much = at("6");
    EXPECT_LT(little["triangles"]["mean"], much["triangles"]["mean"]);
    EXPECT_GT(little["err_px"]["mean"], much["err_px"]["mean"]);
}

TEST_F(Replay, APictureIsSavedForEachFrameAskedFor) {
    ASSERT_EQ(replay("--path fly --clock model --frames 9 --screenshot 3 --size 160x120", "p").exitCode, 0);
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder / "p")) {
        pictures += entry.path().extension() == ".png" ? 1 : 0;
    }
    EXPECT_EQ(pictures, 3);
    EXPECT_TRUE(std::filesystem::exists(*folder / "p/frame000008.png"));
}

TEST_F(Replay, TheRealClockMeasuresDrawing) {
    ASSERT_EQ(replay("--path walk --clock real --frames 20 --size 160x120", "r").exitCode, 0);
    const nlohmann::json summary = summaryOf("r");
    EXPECT_EQ(summary["frames"], 20);
    EXPECT_GT(summary["actual_ms"]["mean"], 0.0);
    EXPECT_EQ(summary["memory"]["over_budget_frames"], 0);
}

TEST_F(Replay, WhatWasLoadedBeforeTheWalkIsNotCounted) {
    ASSERT_EQ(replay("--path still --settle --clock model --frames 5", "s").exitCode, 0);
    const nlohmann::json settled = summaryOf("s");
    EXPECT_EQ(settled["loads"]["completed"], 0);
    EXPECT_EQ(settled["loads"]["bytes"], 0);
    ASSERT_EQ(replay("--path still --clock model --frames 100", "u").exitCode, 0);
    EXPECT_GT(summaryOf("u")["loads"]["completed"], 0);
}

TEST_F(Replay, AnAbsurdNumberOfFramesIsNotRefusedByCrashing) {
    // Far more frames than memory would hold: it is stopped, as by Ctrl-C.
    const ProgramRun run = runProgram(std::string("-s INT --preserve-status 3 ") + FB_PROGRAM + " replay " + scene() +
                                          " --clock model --frames 18446744073709551615 --out " + (*folder / "long").string(),
                                      "timeout");
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_EQ(run.errLines(), 1) << run.err;
    EXPECT_NE(run.err.find("stopped"), std::string::npos) << run.err;
}

TEST_F(Replay, ABudgetTooSmallForTheRootsNamesTheNumberNeeded) {
    // One root that keeps all 80,000 triangles: 960,000 bytes of indices and as many of vertices.
    writeHills(*folder / "large.obj", 200);
    const std::string large = (*folder / "large.fbscene").string();
    ASSERT_EQ(runProgram("build --progress none " + (*folder / "large.obj").string() + " -o " + large +
                         " --split none --set build.desired_triangles=100000")
                  .exitCode,
              0);
    const ProgramRun run = runProgram("replay " + large + " --clock model --frames 2 --set load.budget=1 --out " +
                               (*folder / "o").string());
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_EQ(run.errLines(), 1) << run.err;
    EXPECT_NE(run.err.find("budget"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace fb
