// Builds by several processes, builds that are killed, and builds within limits end with the same bytes.
#include <gtest/gtest.h>

#include <map>

#include "run_program.h"
#include "worlds/files_of.h"

namespace fb {
namespace {

namespace fs = std::filesystem;
using test::filesOf;
using test::ProgramRun;
using test::runProgram;
using test::TemporaryFolder;

std::string cityInto(const fs::path& folder) {
    return "city --progress none --blocks 6 --triangles 24K --texels 400K -o '" + folder.string() + "'";
}

class SharedBuild : public ::testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(runProgram(cityInto(folder / "alone") + " --threads 1").exitCode, 0);
        alone = filesOf(folder / "alone");
        ASSERT_EQ(alone.size(), 8u);  // scene.toml, hierarchy.bin, six packs
    }

    TemporaryFolder folder;
    std::map<std::string, std::string> alone;
};

// By `ranks` processes under mpirun; its libraries leak a little at the end.
ProgramRun runRanks(int ranks, const std::string& arguments) {
    return runProgram("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ASAN_OPTIONS=detect_leaks=0 "
                      "mpirun --oversubscribe -np " +
                          std::to_string(ranks) + " '" FB_PROGRAM "' " + arguments,
                      "/usr/bin/env");
}

bool hasMpi() { return std::system("command -v mpirun >/dev/null") == 0; }

TEST_F(SharedBuild, ByManyThreadsOrWithinLittleMemoryHasTheSameBytes) {
    ASSERT_EQ(runProgram(cityInto(folder / "threads") + " --threads 5 --memory-limit 256M").exitCode, 0);
    EXPECT_EQ(filesOf(folder / "threads"), alone);
}

TEST_F(SharedBuild, BySeveralRanksHasTheSameBytes) {
    if (!hasMpi()) GTEST_SKIP() << "mpirun is not installed";
    const ProgramRun run = runRanks(3, cityInto(folder / "ranks"));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.err.find("in 6 blocks became"), std::string::npos) << run.err;
    EXPECT_EQ(filesOf(folder / "ranks"), alone);
    const ProgramRun again = runRanks(2, cityInto(folder / "ranks"));
    EXPECT_NE(again.err.find("6 blocks taken over"), std::string::npos) << again.err;
    EXPECT_EQ(filesOf(folder / "ranks"), alone);
}

TEST_F(SharedBuild, OneErrorOfAllRanksIsToldOnce) {
    if (!hasMpi()) GTEST_SKIP() << "mpirun is not installed";
    std::ofstream(folder / "file") << "no folder";
    const ProgramRun run = runRanks(2, cityInto(folder / "file" / "scene"));
    EXPECT_NE(run.exitCode, 0);
    const std::size_t first = run.err.find("frontbench: ");
    EXPECT_NE(first, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("frontbench: ", first + 1), std::string::npos) << run.err;
}

TEST_F(SharedBuild, KilledAtAnyMomentGoesOnToTheSameBytes) {
    double seconds = 0.2;
    ProgramRun run;
    int kills = 0;
    do {  // each time a little later, so that it ends at last
        const std::string kill = "timeout -s KILL " + std::to_string(seconds) + " '" FB_PROGRAM "' ";
        run = runProgram(kill + cityInto(folder / "killed"), "/usr/bin/env");
        kills += run.exitCode == 0 ? 0 : 1;
        seconds *= 1.5;
    } while (run.exitCode != 0 && seconds < 600.0);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_GT(kills, 0);
    EXPECT_EQ(filesOf(folder / "killed"), alone);
}

TEST(BuildLimits, ThatCannotBeAreWrongUsage) {
    const TemporaryFolder folder;
    const std::string city = cityInto(folder / "scene");
    for (const char* option : {"--memory-limit 10M", "--memory-limit much", "--threads 100000", "--threads -1"}) {
        const ProgramRun run = runProgram(city + " " + option);
        EXPECT_EQ(run.exitCode, 2) << option;
        EXPECT_EQ(run.errLines(), 1) << run.err;
    }
}

}  // namespace
}  // namespace fb
