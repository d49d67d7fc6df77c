// What the program answers to wrong input: one line on standard error, nothing on standard output, exit code 1 or 2.
#include <gtest/gtest.h>

#include <vector>

#include "run_program.h"

namespace fb {
namespace {

using test::ProgramRun;
using test::runProgram;
using test::TemporaryFolder;

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

// The smallest mesh that builds: one triangle.
void writeTriangle(const std::filesystem::path& file) { write(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

void expectOneLine(const ProgramRun& run, int exitCode, const std::string& part) {
    EXPECT_EQ(run.exitCode, exitCode) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.errLines(), 1) << run.err;
    EXPECT_TRUE(run.err.starts_with("frontbench: ")) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

TEST(CommandLine, AnUnknownOptionIsWrongUsage) { expectOneLine(runProgram("replay --out o --colour red"), 2, "--colour"); }

TEST(CommandLine, ACommandWithoutItsArgumentsIsWrongUsage) { 
    expectOneLine(runProgram("build"), 2, "--output");
    expectOneLine(runProgram("build -o nothing.fbscene"), 2, "INPUT");
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput) {
    const ProgramRun help = runProgram("--help");
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_NE(help.out.find("replay"), std::string::npos);
    EXPECT_EQ(runProgram("--version").out, "frontbench " FB_VERSION "\n");
}

TEST(CommandLine, AMissingMeshIsNamed) {
    const TemporaryFolder folder;
    expectOneLine(runProgram("build --progress none /nowhere/house.obj -o " + (folder / "s.fbscene").string()), 1,
                  "/nowhere/house.obj");
}

TEST(CommandLine, TextRenamedToPlyIsRefusedByName) {
    const TemporaryFolder folder;
    write(folder / "letter.ply", "Dear city,\nthis is no mesh.\n");
    expectOneLine(runProgram("build --progress none " + (folder / "letter.ply").string() + " -o " +
                             (folder / "s.fbscene").string()),
                  1, "letter.ply");
}

TEST(CommandLine, ATruncatedGlbIsRefusedByName) {
    const TemporaryFolder folder;
    write(folder / "tree.glb", std::string("glTF\x02\0\0\0\xff\xff\0\0\x10\0\0\0JSON{\"asset\"", 28));
    expectOneLine(runProgram("build --progress none " + (folder / "tree.glb").string() + " -o " +
                             (folder / "s.fbscene").string()),
                  1, "tree.glb");
}

TEST(CommandLine, AnUnwritableOutputIsNamed) {
    const TemporaryFolder folder;
    writeTriangle(folder / "t.obj");
    write(folder / "file", "in the way");
    expectOneLine(runProgram("build --progress none " + (folder / "t.obj").string() + " -o " +
                             (folder / "file/s.fbscene").string()),
                  1, "file");
}

TEST(CommandLine, AMissingSceneIsNamedByEveryCommandThatOpensOne) {
    const TemporaryFolder folder;
    for (const std::string& command : std::vector<std::string>{"info", "check --progress none", "replay --clock model --out " + (folder / "o").string()}) {
        expectOneLine(runProgram(command + " /nowhere/s.fbscene"), 1, "/nowhere/s.fbscene");
    }
}

TEST(CommandLine, WrongKnobsPoliciesPathsAndPresetsAreNamed) {
    const TemporaryFolder folder;
    writeTriangle(folder / "t.obj");
    const std::string scene = (folder / "t.fbscene").string();
    ASSERT_EQ(runProgram("build --progress none " + (folder / "t.obj").string() + " -o " + scene).exitCode, 0);
    const std::string real = "replay " + scene + " --frames 2 --out " + (folder / "o").string();
    const std::string replay = real + " --clock model";
    expectOneLine(runProgram(replay + " --policy best"), 2, "best");
    expectOneLine(runProgram(replay + " --set select.c_vis=nan"), 2, "select.c_vis");
    expectOneLine(runProgram(replay + " --set select.c_vis=1e39"), 2, "select.c_vis");
    expectOneLine(runProgram(replay + " --set nothing=1"), 2, "nothing");
    expectOneLine(runProgram(real + " --clock sun"), 2, "sun");
    expectOneLine(runProgram(replay + " --size 0x5"), 2, "0x5");
    expectOneLine(runProgram(replay + " --path moonwalk"), 1, "moonwalk");
    expectOneLine(runProgram(replay + " --preset mine"), 1, "mine");
}

TEST(CommandLine, ASceneOfAnotherVersionSaysSo) {
    const TemporaryFolder folder;
    writeTriangle(folder / "t.obj");
    const std::string scene = (folder / "t.fbscene").string();
    ASSERT_EQ(runProgram("build --progress none " + (folder / "t.obj").string() + " -o " + scene).exitCode, 0);
    std::fstream file(scene + "/hierarchy.bin", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8);  // the version follows the 8 bytes of magic
    file.put(99);
    file.close();
    expectOneLine(runProgram("info " + scene), 1, "version");
}

TEST(CommandLine, KnobsAndPresetsAreListedOnStandardOutput) {
    const ProgramRun knobs = runProgram("knobs --json");
    EXPECT_EQ(knobs.exitCode, 0);
    EXPECT_NE(knobs.out.find("\"select.c_vis\""), std::string::npos);
    EXPECT_EQ(knobs.err, "");
    EXPECT_NE(runProgram("presets list").out.find("lakhia2004"), std::string::npos);
    EXPECT_NE(runProgram("presets diff default lakhia2004").out.find("select.hyst_switch"), std::string::npos);
}

TEST(CommandLine, OptionsThatCannotBeMeantAreNamed) {
    const TemporaryFolder folder;
    writeTriangle(folder / "t.obj");
    const std::string mesh = (folder / "t.obj").string(), scene = (folder / "t.fbscene").string();
    const std::string build = "build --progress none " + mesh + " -o ";
    expectOneLine(runProgram(build + "''"), 2, "--output");
    expectOneLine(runProgram(build + scene + " --set select.policy=full"), 2, "select.policy=full");
    expectOneLine(runProgram(build + scene + " --texture " + (folder / "no.png").string()), 1, "no.png");
    expectOneLine(runProgram("build " + mesh + " -o " + scene + " --progress often"), 2, "--progress");
    expectOneLine(runProgram("city --progress none -o " + scene + " --blocks x"), 2, "--blocks x");
    ASSERT_EQ(runProgram(build + scene).exitCode, 0);
    const std::string replay = "replay " + scene + " --clock model --out ";
    expectOneLine(runProgram(replay + "''"), 2, "--out");
    expectOneLine(runProgram(replay + (folder / "o").string() + " --frames -1"), 2, "--frames");
    expectOneLine(runProgram(replay + (folder / "o").string() + " --policy best"), 2, "--policy");
    expectOneLine(runProgram(scene + " " + mesh), 2, "one scene");
}

}  // namespace
}  // namespace fb
