#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "base/hash.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/limits.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::Bytes;
using test::faultsOf;
using test::lineOf;
using test::says;
using test::soleFault;
using test::TemporaryFolder;
using test::TinyBlock;

TEST(OpenScene, SaysWhatIsMissing) {
    const TemporaryFolder folder;
    EXPECT_TRUE(says(lineOf(openScene(folder.path() / "none")), "none: there is no such scene"));
    EXPECT_TRUE(says(lineOf(checkScene(folder.path() / "none", {})), "none: there is no such scene"));
    test::overwrite(folder.path() / "file", {});
    EXPECT_TRUE(says(lineOf(openScene(folder.path() / "file")), "file: is not a scene"));

    test::writeTinyScene(folder.path(), {test::tinyBlock(1), test::tinyBlock(1)});
    const auto without = [&](const char* name) {
        std::filesystem::rename(folder.path() / name, folder.path() / "aside");
        const std::string line = lineOf(openScene(folder.path()));
        EXPECT_FALSE(faultsOf(folder.path()).empty());
        std::filesystem::rename(folder.path() / "aside", folder.path() / name);
        return line;
    };
    EXPECT_TRUE(says(without("hierarchy.bin"), "hierarchy.bin: is missing: the scene is not complete"));
    EXPECT_TRUE(says(without("scene.toml"), "scene.toml: cannot be opened"));
    EXPECT_TRUE(says(without("blocks/00001.pack"), "blocks/00001.pack: cannot be opened"));
    EXPECT_TRUE(openScene(folder.path()));
}

TEST(OpenScene, NamesAnotherVersion) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(0)});
    const std::string other = "made by version 5; this program reads 4 (build it again)";
    for (const char* name : {"hierarchy.bin", "blocks/00000.pack"}) {
        const Bytes good = test::readAll(folder.path() / name);
        Bytes bytes = good;
        bytes[8] = 5;
        test::overwrite(folder.path() / name, bytes);
        EXPECT_TRUE(says(soleFault(folder.path()), std::string(name) + ": header: " + other))
            << soleFault(folder.path());
        test::overwrite(folder.path() / name, good);
    }
    Bytes toml = test::readAll(folder.path() / "scene.toml");
    const std::string text(toml.begin(), toml.end());
    toml[text.find("format = 4") + 9] = '5';
    test::overwrite(folder.path() / "scene.toml", toml);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "scene.toml: line 2: " + other));
}

TEST(OpenScene, RefusesEveryPrefixOfTheHierarchy) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const std::filesystem::path path = folder.path() / "hierarchy.bin";
    Bytes bytes = test::readAll(path);
    EXPECT_EQ(bytes.size(), 48u + 56u + 2u * 124u);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        test::overwrite(path, std::span(bytes).first(length));
        EXPECT_FALSE(openScene(folder.path())) << length;
        const Bytes prefix(bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(length));  // ASan sees its end
        EXPECT_FALSE(parseHierarchyFile(prefix, "file")) << length;
    }
    bytes.push_back(0);
    test::overwrite(path, bytes);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "the tables take 304 bytes, but 305 are there"));
}

TEST(OpenScene, RefusesEveryPrefixOfAPackAndOneByteMore) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const std::filesystem::path path = folder.path() / "blocks/00000.pack";
    Bytes bytes = test::readAll(path);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        test::overwrite(path, std::span(bytes).first(length));
        EXPECT_TRUE(
            says(lineOf(openScene(folder.path())), "00000.pack: has " + std::to_string(length) + " bytes"));
    }
    bytes.push_back(0);
    test::overwrite(path, bytes);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "00000.pack: has"));
}

TEST(OpenScene, OpensMorePacksThanTheSoftLimitOfOpenFiles) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), std::vector(80, test::tinyBlock(0)));
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit low = before;
    low.rlim_cur = 60;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &low), 0);
    const Result<Scene> scene = openScene(folder.path());
    EXPECT_EQ(lineOf(scene), "no error");
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
    EXPECT_TRUE(readPayload(*scene, 79));
}

// Two builds into one folder: the packs are whole, but not those of this hierarchy.bin.
TEST(OpenScene, RefusesPacksAndTomlOfAnotherBuild) {
    const TemporaryFolder folder, other;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1), test::tinyBlock(1)});
    TinyBlock moved = test::tinyBlock(1);
    moved.grid.origin.x = 1.0;
    test::writeTinyScene(other.path(), {moved, moved});
    const auto replaced = [&](const char* name) {
        const Bytes good = test::readAll(folder.path() / name);
        test::overwrite(folder.path() / name, test::readAll(other.path() / name));
        const std::string line = lineOf(openScene(folder.path()));
        EXPECT_EQ(faultsOf(folder.path()).size(), 1u);
        test::overwrite(folder.path() / name, good);
        return line;
    };
    EXPECT_TRUE(says(replaced("blocks/00001.pack"), "00001.pack: trailer: the seal is"));
    EXPECT_TRUE(says(replaced("scene.toml"), "scene.toml: was written with another hierarchy.bin"));
    EXPECT_TRUE(openScene(folder.path()));
}

// Headers with a true checksum whose counts are at the caps, or one above.
TEST(ParseHierarchyFile, BelievesNoCountThatTheBytesCannotHold) {
    const auto verdict = [](std::uint32_t blocks, std::uint32_t nodes) {
        Bytes header(kHierarchyHeaderBytes, 0);
        std::memcpy(header.data(), "fbscene\n", 8);
        header[8] = kSceneFormatVersion;
        std::memcpy(&header[12], &blocks, 4);
        std::memcpy(&header[16], &nodes, 4);
        const std::uint64_t hash = hashBytes(header.data(), kHierarchyHeaderBytes - 8);
        std::memcpy(&header[kHierarchyHeaderBytes - 8], &hash, 8);
        return lineOf(parseHierarchyFile(header, "file"));
    };
    EXPECT_TRUE(says(verdict(kMaxBlocks, kMaxNodes), "the tables take 2085974784 bytes, but 0 are there"));
    EXPECT_TRUE(says(verdict(kMaxBlocks + 1, kMaxNodes), "cannot have 100001 blocks"));
    EXPECT_TRUE(says(verdict(kMaxBlocks, kMaxNodes + 1), "cannot have 100000 blocks and 16777217 nodes"));
    EXPECT_TRUE(says(verdict(0, 1), "cannot have"));
    EXPECT_TRUE(says(verdict(1, 0), "cannot have"));
}

}  // namespace
}  // namespace fb
