// `frontbench calibrate`: with the model clock the constants of the simulated device, exactly; with the real clock what
// can be said of any machine.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.h"
#include "settings/preset.h"

namespace fb {
namespace {

using test::ProgramRun;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;

class Calibrate : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        ASSERT_EQ(runProgram("city --progress none -o " + scene() + " --blocks 2 --triangles 12K --texels 200K").exitCode, 0);
        std::ofstream(*folder / "square.obj") << "v 0 0 0\nv 9 0 0\nv 9 0 9\nv 0 0 9\nf 1 2 3\nf 1 3 4\n";
        ASSERT_EQ(runProgram("build --progress none " + path("square.obj") + " -o " + path("square.fbscene")).exitCode, 0);
    }
    static void TearDownTestSuite() { folder.reset(); }

    static std::string path(const std::string& name) { return (*folder / name).string(); }
    static std::string scene() { return path("city.fbscene"); }
    static ProgramRun calibrate(const std::string& arguments, const std::string& out) {
        return runProgram("calibrate " + arguments + " --out " + path(out));
    }
    static Settings settingsOf(const std::string& name) {
        Result<Preset> preset = loadPreset(path(name));
        EXPECT_TRUE(preset) << (preset ? "" : preset.error().oneLine());
        return preset ? preset->settings : Settings{};
    }
    static void expectOneLine(const ProgramRun& run, int exitCode, const std::string& part) {
        EXPECT_EQ(run.exitCode, exitCode) << run.err;
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(run.errLines(), 1) << run.err;
        EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    }

    static inline std::unique_ptr<TemporaryFolder> folder;
};

TEST_F(Calibrate, WithTheModelClockGivesTheConstantsOfTheSimulatedDevice) {
    const ProgramRun run = calibrate(scene() + " --clock model --set model.node=0 --set model.overhead=1.5", "exact.toml");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("exact.toml"), std::string::npos) << run.out;
    const Settings s = settingsOf("exact.toml");
    EXPECT_EQ(s.select.cTextured, 0.21 / (0.21 + 0.17));
    EXPECT_NEAR(s.control.vTimeStartMs, 0.38e-3, 1e-15);
    EXPECT_EQ(s.control.overheadMs, 1.5);
    EXPECT_EQ(s.model.nodeUs, 0.0) << "what --set says is part of the preset";
}

TEST_F(Calibrate, CountsNodesAndBytesPerUnitOfCost) {
    ASSERT_EQ(calibrate(scene() + " --clock model --set model.textured=0.5 --set model.untextured=0.5", "half.toml").exitCode, 0);
    const Settings s = settingsOf("half.toml");
    EXPECT_EQ(s.select.cTextured, 0.5);
    const nlohmann::json levels = nlohmann::json::parse(runProgram("info --json " + scene()).out)["levels"];
    const auto count = [&](std::size_t level, const char* name) { return levels[level][name].get<double>(); };
    const double roots = count(0, "textured_triangles") + count(0, "untextured_triangles");
    EXPECT_NEAR(s.control.vTimeStartMs, (0.5 * roots + 12.0 * count(0, "nodes")) / 1000.0 / (0.5 * roots), 1e-15);
    double bytes = 0.0, cost = 0.0;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        bytes += count(level, "resident_bytes");
        cost += 0.5 * (count(level, "textured_triangles") + count(level, "untextured_triangles"));
    }
    EXPECT_NEAR(s.load.cMemory, bytes / cost, 5e-4 * bytes / cost) << "four digits";
}

TEST_F(Calibrate, WritesTheSameBytesEachTime) {
    ASSERT_EQ(calibrate(scene() + " --clock model", "same.toml").exitCode, 0);
    const std::string first = readText(path("same.toml"));
    ASSERT_EQ(calibrate(scene() + " --clock model", "same.toml").exitCode, 0);
    EXPECT_EQ(readText(path("same.toml")), first);
    EXPECT_NE(first.find("# scene: city, 2 blocks"), std::string::npos) << first;
    EXPECT_NE(first.find("# device: simulated"), std::string::npos) << first;
}

// Other starts than the simulated device would measure, so that they can only come from the preset.
TEST_F(Calibrate, ReplayStartsFromTheCalibratedConstants) {
    ASSERT_EQ(calibrate(scene() + " --clock model --from lakhia2004", "start.toml").exitCode, 0);
    EXPECT_EQ(settingsOf("start.toml").select.hystSwitch, 1500.0) << "the rest is lakhia2004's";
    const Settings s = settingsOf("start.toml");
    const ProgramRun replay = runProgram("replay " + scene() + " --clock model --frames 3 --path still --preset " +
                                         path("start.toml") + " --set model.overhead=7 --set model.untextured=0.3 --out " + path("walk"));
    ASSERT_EQ(replay.exitCode, 0) << replay.err;
    std::istringstream csv(readText(path("walk/frames.csv")));
    std::string names, values;
    std::getline(csv, names);
    std::getline(csv, values);
    const auto column = [&](const std::string& wanted) {
        std::istringstream n(names), v(values);
        for (std::string name, value; std::getline(n, name, ',') && std::getline(v, value, ',');) {
            if (name == wanted) return std::stod(value);
        }
        return -1.0;
    };
    EXPECT_NEAR(column("v_time"), s.control.vTimeStartMs, 1e-5 * s.control.vTimeStartMs);
    EXPECT_EQ(column("overhead_ms"), 2.0);
    EXPECT_EQ(nlohmann::json::parse(readText(path("walk/summary.json")))["preset"], path("start.toml"));
}

TEST_F(Calibrate, GoesToTheUsersPresetsWhereNoFileIsNamed) {
    const ProgramRun run = runProgram(std::string("XDG_CONFIG_HOME=") + path("config") + " " + FB_PROGRAM + " calibrate " +
                                          scene() + " --clock model",
                                      "env");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("saved " + path("config/frontbench/presets/calibrated.toml")), std::string::npos) << run.out;
    const ProgramRun shown = runProgram(std::string("XDG_CONFIG_HOME=") + path("config") + " " + FB_PROGRAM + " presets show calibrated", "env");
    EXPECT_NE(shown.out.find("c_textured"), std::string::npos) << shown.err;
}

TEST_F(Calibrate, KeepsWhatCannotBeMeasuredAndSaysWhy) {
    for (const std::string clock : {"model", "real --size 160x120"}) {
        const ProgramRun run = calibrate(path("square.fbscene") + " --clock " + clock + " --set select.c_textured=0.25", "kept.toml");
        ASSERT_EQ(run.exitCode, 0) << run.err;
        EXPECT_NE(run.out.find("the scene has no textured triangle"), std::string::npos) << run.out;
        EXPECT_EQ(settingsOf("kept.toml").select.cTextured, 0.25);
        EXPECT_NE(readText(path("kept.toml")).find("# select.c_textured: kept"), std::string::npos);
    }
}

TEST_F(Calibrate, TheRealClockMeasuresThisMachine) {
    const ProgramRun run = calibrate(scene() + " --clock real --size 160x120", "real.toml");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Settings s = settingsOf("real.toml");
    EXPECT_NE(s.select.cTextured, 0.5) << run.out;
    EXPECT_GT(s.control.vTimeStartMs, 0.0) << run.out;
    EXPECT_GT(s.control.overheadMs, 0.0) << run.out;
    EXPECT_NE(readText(path("real.toml")).find("picture: 160x120"), std::string::npos);
}

TEST_F(Calibrate, WrongInputIsOneLine) {
    const std::string model = scene() + " --clock model";
    expectOneLine(calibrate("/nowhere/s.fbscene --clock model", "x.toml"), 1, "/nowhere/s.fbscene");
    expectOneLine(calibrate(model, "missing/x.toml"), 1, path("missing") + ": there is no such folder");
    expectOneLine(calibrate(model, "x.txt"), 2, "x.txt");
    expectOneLine(calibrate(model, ".toml"), 2, ".toml");
    expectOneLine(calibrate(scene() + " --clock sun", "x.toml"), 2, "sun");
    expectOneLine(calibrate(model + " --size 7", "x.toml"), 2, "--size 7");
    expectOneLine(calibrate(model + " --from mine", "x.toml"), 1, "mine");
    expectOneLine(calibrate(model + " --set nothing=1", "x.toml"), 2, "nothing");
    std::filesystem::create_directory(path("folder.toml"));
    expectOneLine(calibrate(model, "folder.toml"), 1, "is a folder");
    EXPECT_FALSE(std::filesystem::exists(path("x.toml")));
}

TEST_F(Calibrate, ABudgetTooSmallForTheRootsNamesTheNumberNeeded) {
    ASSERT_EQ(runProgram("city --progress none -o " + path("large.fbscene") +
                         " --blocks 1 --triangles 50K --texels 100K --set build.desired_triangles=40000")
                  .exitCode,
              0);
    expectOneLine(calibrate(path("large.fbscene") + " --clock model --set load.budget=1", "x.toml"), 1, "load.budget");
}

TEST_F(Calibrate, CtrlCLeavesNothingBehind) {
    std::filesystem::create_directory(path("stopped"));
    const ProgramRun run = runProgram(std::string("-s INT --preserve-status 8 ") + FB_PROGRAM + " calibrate " + scene() +
                                          " --size 4096x4096 --out " + path("stopped/x.toml"),
                                      "timeout");
    expectOneLine(run, 1, "stopped");
    EXPECT_TRUE(std::filesystem::is_empty(path("stopped")));
}

}  // namespace
}  // namespace fb
