// Policies against each other on one scene: `frontbench compare` with the model clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "run_program.h"

namespace fb {
namespace {

using test::ProgramRun;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;

class Compare : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        const ProgramRun city = runProgram("city --progress none --blocks 4 --triangles 60K --texels 1M -o " + scene());
        ASSERT_EQ(city.exitCode, 0) << city.err;
    }
    static void TearDownTestSuite() { folder.reset(); }
    static std::string scene() { return (*folder / "city.fbscene").string(); }
    static ProgramRun compare(const std::string& arguments) {
        return runProgram("compare " + scene() + " " + arguments + " --out " + (*folder / "out").string());
    }
    // Fields by name, of each line.
    static std::vector<std::map<std::string, std::string>> lines() {
        std::istringstream text(readText(*folder / "out/compare.csv"));
        std::vector<std::map<std::string, std::string>> all;
        std::vector<std::string> names;
        for (std::string line; std::getline(text, line);) {
            std::vector<std::string> fields;
            std::istringstream parts(line);
            for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
            if (names.empty()) {
                names = fields;
                continue;
            }
            all.emplace_back();
            for (std::size_t i = 0; i < fields.size(); ++i) all.back()[names[i]] = fields[i];
        }
        return all;
    }
    static inline std::unique_ptr<TemporaryFolder> folder;
};

TEST_F(Compare, WalksEveryPolicyOnEveryPathAtEveryTarget) {
    const ProgramRun run = compare("--path still fly --policy coarse frontbench full --target 10 20 --frames 60 --settle");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("fly, target 20 ms"), std::string::npos) << run.out;
    const auto all = lines();
    ASSERT_EQ(all.size(), 12u);
    for (const auto& line : all) EXPECT_EQ(line.at("frames"), "60");
    for (std::size_t i = 0; i < all.size(); i += 3) {
        EXPECT_EQ(all[i].at("policy"), "coarse");
        EXPECT_EQ(all[i + 1].at("policy"), "frontbench");
        const auto number = [&](std::size_t line, const char* name) { return std::stod(all[line].at(name)); };
        EXPECT_LE(number(i + 1, "err_px_mean"), number(i, "err_px_mean"));
        EXPECT_LE(number(i + 2, "err_px_mean"), number(i + 1, "err_px_mean"));
        EXPECT_LE(number(i, "actual_ms_mean"), number(i + 1, "actual_ms_mean"));
        EXPECT_LE(number(i + 1, "actual_ms_mean"), number(i + 2, "actual_ms_mean"));
    }
}

// A walk does not know what was walked before it, nor in which round.
TEST_F(Compare, EachWalkBeginsAnew) {
    ASSERT_EQ(compare("--path walk --policy frontbench --frames 45").exitCode, 0);
    const auto alone = lines();
    ASSERT_EQ(compare("--path fly walk --policy full frontbench --frames 45 --rounds 2").exitCode, 0);
    const auto among = lines();
    ASSERT_EQ(alone.size(), 1u);
    ASSERT_EQ(among.size(), 4u);
    EXPECT_EQ(among[3].at("path"), "walk");
    EXPECT_EQ(among[3].at("frames"), "90");
    for (const char* name : {"toggles_per_frame", "err_px_mean", "actual_ms_mean", "p99_over_target"})
        EXPECT_DOUBLE_EQ(std::stod(among[3].at(name)), std::stod(alone[0].at(name))) << name;
}

TEST_F(Compare, RefusesWhatItDoesNotKnowBeforeItWalks) {
    const ProgramRun policy = compare("--policy greedy gredy");
    EXPECT_EQ(policy.exitCode, 2);
    EXPECT_NE(policy.err.find("\"gredy\" is not a value of it"), std::string::npos) << policy.err;
    EXPECT_EQ(compare("--target 20 -3").exitCode, 2);
    const ProgramRun path = compare("--path nowhere");
    EXPECT_EQ(path.exitCode, 1);
    EXPECT_NE(path.err.find("nowhere"), std::string::npos) << path.err;
    for (const ProgramRun& run : {policy, path}) EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace
}  // namespace fb
