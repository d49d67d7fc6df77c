#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <limits>

#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::faultsOf;
using test::kBlockHash;
using test::kSettingsHash;
using test::lineOf;
using test::says;
using test::TemporaryFolder;
using test::TinyBlock;

TEST(WriteScene, WritesNothingThatItCouldNotRead) {
    const TemporaryFolder folder;
    EXPECT_FALSE(writeScene(folder.path(), test::tinyInfo(), {}));
    std::vector<BuiltBlock> blocks = {test::writePack(folder.path(), 0, test::tinyBlock(1))};
    SceneInfo info = test::tinyInfo();
    info.origin.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), info, blocks)), "the origin is not finite"));
    blocks[0].nodes[1].staticBenefit = -1.0f;
    EXPECT_TRUE(
        says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)), "node 1: the benefit is negative"));
    blocks[0].nodes[1].staticBenefit = 1.0f;
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), {blocks[0], blocks[0]})),
                     "number of its pack"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "hierarchy.bin"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene.toml"));
    std::filesystem::remove(folder.path() / "blocks/00000.pack");
    EXPECT_TRUE(
        says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)), "00000.pack: cannot be opened"));
}

TEST(WriteScene, SaysWhichFileCannotBeWritten) {
    const TemporaryFolder folder;
    const std::vector<BuiltBlock> blocks = {test::writePack(folder.path(), 0, test::tinyBlock(0))};
    std::filesystem::create_directories(folder.path() / "hierarchy.bin" / "in the way");
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)),
                     "hierarchy.bin: cannot be given its name"));
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "hierarchy.bin: is not a file"));
}

// A build as build/ does it: a pack is taken up where there is one.
void buildAgain(const std::filesystem::path& folder, const std::vector<TinyBlock>& blocks) {
    std::vector<BuiltBlock> built;
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        std::optional<BuiltBlock> found = reusePack(folder, b, kSettingsHash, kBlockHash);
        built.push_back(found ? *found : test::writePack(folder, b, blocks[b]));
    }
    ASSERT_TRUE(writeScene(folder, test::tinyInfo(), built));
}

// Killed at each of these points, a build leaves no scene, and the next one ends with the bytes of an
// undisturbed one.
TEST(WriteScene, IsTakenUpAgainAfterAKillAtAnyStep) {
    const std::vector<TinyBlock> blocks = {test::tinyBlock(1), test::tinyBlock(2)};
    const TemporaryFolder undisturbed;
    test::writeTinyScene(undisturbed.path(), blocks);
    constexpr int kSteps = 5;
    for (int step = 0; step < kSteps; ++step) {
        const TemporaryFolder folder;
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            const auto killAt = [&](int here) {
                if (here == step) ::raise(SIGKILL);
            };
            killAt(0);
            PackWriter first = PackWriter::create(folder.path(), 0).value();
            killAt(1);
            (void)first.append(encodePayload(blocks[0].nodes[0].data).value());
            killAt(2);
            (void)test::writePack(folder.path(), 0, blocks[0]);
            killAt(3);
            (void)test::writePack(folder.path(), 1, blocks[1]);
            killAt(4);
            ::_exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status));
        EXPECT_FALSE(openScene(folder.path())) << step;
        buildAgain(folder.path(), blocks);
        for (const char* name : {"hierarchy.bin", "scene.toml", "blocks/00000.pack", "blocks/00001.pack"}) {
            EXPECT_EQ(test::readAll(folder.path() / name), test::readAll(undisturbed.path() / name))
                << name << step;
        }
        EXPECT_EQ(faultsOf(folder.path()), std::vector<std::string>{}) << step;
    }
}

}  // namespace
}  // namespace fb
