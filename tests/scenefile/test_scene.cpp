#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>

#include "base/hash.h"
#include "base/random.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/limits.h"
#include "scenefile/pack_format.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::Bytes;
using test::kBlockHash;
using test::kSettingsHash;
using test::lineOf;
using test::says;
using test::TemporaryFolder;
using test::TinyBlock;

std::vector<std::string> faultsOf(const std::filesystem::path& folder) {
    Result<SceneCheck> check = checkScene(folder, {});
    return check ? check->faults : std::vector<std::string>{check.error().oneLine()};
}

std::string soleFault(const std::filesystem::path& folder) {
    const std::vector<std::string> faults = faultsOf(folder);
    return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
}

bool same(const Hierarchy& a, const Hierarchy& b) {
    const auto sameBounds = [&] {
        for (NodeId n = 0; n < a.size(); ++n) {
            if (a.bounds[n].min != b.bounds[n].min || a.bounds[n].max != b.bounds[n].max) return false;
        }
        return true;
    };
    const auto samePayloads = [&] {
        for (NodeId n = 0; n < a.size(); ++n) {
            const PayloadRef &p = a.payload[n], &q = b.payload[n];
            if (p.pack != q.pack || p.offset != q.offset || p.sizeBytes != q.sizeBytes || p.checksum != q.checksum) {
                return false;
            }
        }
        return true;
    };
    const auto sameGrids = [&] {
        for (std::size_t i = 0; i < a.grids.size(); ++i) {
            if (a.grids[i].origin != b.grids[i].origin || a.grids[i].step != b.grids[i].step) return false;
        }
        return a.grids.size() == b.grids.size();
    };
    return a.rootCount == b.rootCount && a.parent == b.parent && a.firstChild == b.firstChild &&
           a.childCount == b.childCount && a.level == b.level && a.block == b.block &&
           a.texturedTriangles == b.texturedTriangles && a.untexturedTriangles == b.untexturedTriangles &&
           a.vertices == b.vertices && a.staticBenefit == b.staticBenefit && a.averageNormal == b.averageNormal &&
           a.normalCoherence == b.normalCoherence && a.areaSquareMetres == b.areaSquareMetres &&
           a.geometricErrorMetres == b.geometricErrorMetres && a.textureWidth == b.textureWidth &&
           a.textureHeight == b.textureHeight && a.residentBytes == b.residentBytes && sameBounds() && samePayloads() &&
           sameGrids();
}

// A tree of up to 40 nodes with random numbers that keep the rules; payloads are random bytes.
BuiltBlock randomBlock(const std::filesystem::path& folder, std::uint32_t number, Random& random, std::size_t wanted) {
    BuiltBlock block;
    block.grid = {{random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), 0.0},
                  std::ldexp(1.0, static_cast<int>(random.index(20)) - 16)};
    block.nodes.resize(1);
    block.nodes[0].bounds = {glm::vec3(-1000.0f), glm::vec3(1000.0f)};
    block.nodes[0].geometricErrorMetres = 100.0f;
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
        const std::size_t children = block.nodes.size() < wanted ? random.index(5) + (i == 0 ? 1 : 0) : 0;
        block.nodes[i].childCount = static_cast<std::uint32_t>(children);
        if (children == 0) block.nodes[i].geometricErrorMetres = 0.0f;
        for (std::size_t c = 0; c < children; ++c) {
            const BuiltNode parent = block.nodes[i];
            BuiltNode& child = block.nodes.emplace_back();
            child.parentInBlock = static_cast<std::uint32_t>(i);
            child.level = static_cast<std::uint8_t>(parent.level + 1);
            child.bounds = {parent.bounds.min + static_cast<float>(random.uniform()), parent.bounds.max};
            child.geometricErrorMetres = parent.geometricErrorMetres * static_cast<float>(random.uniform());
        }
    }
    PackWriter pack = PackWriter::create(folder, number).value();
    for (BuiltNode& node : block.nodes) {
        node.texturedTriangles = static_cast<std::uint32_t>(random.index(5000));
        node.untexturedTriangles = static_cast<std::uint32_t>(random.index(5000));
        node.vertices = static_cast<std::uint32_t>(random.index(9000));
        node.staticBenefit = static_cast<float>(random.uniform(0.0, 1e6));
        node.normalCoherence = static_cast<float>(random.uniform());
        node.areaSquareMetres = static_cast<float>(random.uniform(0.0, 1e6));
        const double turn = random.uniform(0.0, 6.28);
        node.averageNormal = {static_cast<float>(std::cos(turn)), 0.0f, static_cast<float>(std::sin(turn))};
        node.textureWidth = static_cast<std::uint16_t>(atlasSide(static_cast<std::uint32_t>(random.index(4096))));
        node.textureHeight = static_cast<std::uint16_t>(atlasSide(static_cast<std::uint32_t>(random.index(4096))));
        Bytes payload(1 + random.index(50));
        for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random.bits());
        node.payload = pack.append(payload).value();
    }
    EXPECT_TRUE(pack.finish(block, kSettingsHash, kBlockHash));
    return block;
}

RC_GTEST_PROP(Scene, GivesBackTheHierarchyThatWasWritten, ()) {
    const TemporaryFolder folder;
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto blockCount = *rc::gen::inRange<std::uint32_t>(1, 5);
    const auto wanted = *rc::gen::inRange<std::size_t>(1, 40);
    std::vector<BuiltBlock> blocks;
    for (std::uint32_t b = 0; b < blockCount; ++b) blocks.push_back(randomBlock(folder.path(), b * 2, random, wanted));
    const Result<void> written = writeScene(folder.path(), test::tinyInfo(), blocks);
    RC_ASSERT(lineOf(written) == "no error");
    const Result<Scene> scene = openScene(folder.path());
    RC_ASSERT(lineOf(scene) == "no error");
    RC_ASSERT(same(scene->hierarchy, joinBlocks(blocks)));
    RC_ASSERT(scene->packs.size() == blockCount * 2 - 1);
    RC_ASSERT(readPayload(*scene, scene->hierarchy.size() - 1).has_value());
}

// Meshes, textures and records together: what build/ will write must pass the check without a fault.
TEST(Scene, PassesItsCheckWithTexturesMasksAndNone) {
    const TemporaryFolder folder;
    TinyBlock masked = test::tinyBlock(0, test::makeTexture(PayloadCodec::png, 12, 8, 4, 3));
    masked.nodes[0].data.mesh.flags.alphaMask = true;
    masked.grid = {{-0.5, 100.0, 3.0}, 0.0625};
    test::writeTinyScene(folder.path(), {test::tinyBlock(3, test::makeTexture(PayloadCodec::jpeg, 16, 6, 3, 2)), masked,
                                         test::tinyBlock(1)});
    EXPECT_EQ(faultsOf(folder.path()), std::vector<std::string>{});
    const Scene scene = openScene(folder.path()).value();
    ASSERT_EQ(scene.hierarchy.size(), 7u);
    const std::string what = "node";
    const NodeData node = parsePayload(readPayload(scene, 1).value(), what).value();
    EXPECT_TRUE(node.mesh.flags.alphaMask);
    const DecodedNode decoded = decodeNode(node, scene.hierarchy.grids[1], what).value();
    EXPECT_EQ(decoded.sizeBytes(), scene.hierarchy.residentBytes[1]);
    EXPECT_EQ(decoded.vertices[0].position[0], 0.5f);  // 8 * 0.0625
}

TEST(Scene, NamesItselfByTheHashOfItsHierarchy) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const Bytes bytes = test::readAll(folder.path() / "hierarchy.bin");
    EXPECT_EQ(openScene(folder.path())->sceneHash, hashBytes(bytes.data(), bytes.size()));
}

TEST(Scene, HasTheSameBytesWhenItIsWrittenAgain) {
    const TemporaryFolder once, twice;
    for (const TemporaryFolder* folder : {&once, &twice}) {
        test::writeTinyScene(folder->path(), {test::tinyBlock(2, test::makeTexture(PayloadCodec::jpeg, 8, 8, 3, 1))});
    }
    for (const char* name : {"hierarchy.bin", "scene.toml", "blocks/00000.pack"}) {
        EXPECT_EQ(test::readAll(once.path() / name), test::readAll(twice.path() / name)) << name;
    }
}

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
    const std::string other = "made by version 2; this program reads 1 (build it again)";
    for (const char* name : {"hierarchy.bin", "blocks/00000.pack"}) {
        const Bytes good = test::readAll(folder.path() / name);
        Bytes bytes = good;
        bytes[8] = 2;
        test::overwrite(folder.path() / name, bytes);
        EXPECT_TRUE(says(soleFault(folder.path()), std::string(name) + ": header: " + other)) << soleFault(folder.path());
        test::overwrite(folder.path() / name, good);
    }
    Bytes toml = test::readAll(folder.path() / "scene.toml");
    const std::string text(toml.begin(), toml.end());
    toml[text.find("format = 1") + 9] = '2';
    test::overwrite(folder.path() / "scene.toml", toml);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "scene.toml: line 2: " + other));
}

TEST(OpenScene, RefusesEveryPrefixOfTheHierarchy) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const std::filesystem::path path = folder.path() / "hierarchy.bin";
    Bytes bytes = test::readAll(path);
    EXPECT_EQ(bytes.size(), 48u + 56u + 2u * 116u);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        test::overwrite(path, std::span(bytes).first(length));
        EXPECT_FALSE(openScene(folder.path())) << length;
        const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));  // ASan sees its end
        EXPECT_FALSE(parseHierarchyFile(prefix, "file")) << length;
    }
    bytes.push_back(0);
    test::overwrite(path, bytes);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "the tables take 288 bytes, but 289 are there"));
}

TEST(OpenScene, RefusesEveryPrefixOfAPackAndOneByteMore) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const std::filesystem::path path = folder.path() / "blocks/00000.pack";
    Bytes bytes = test::readAll(path);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        test::overwrite(path, std::span(bytes).first(length));
        EXPECT_FALSE(openScene(folder.path())) << length;
    }
    bytes.push_back(0);
    test::overwrite(path, bytes);
    EXPECT_TRUE(says(lineOf(openScene(folder.path())), "00000.pack: has"));
}

// The smallest scene: one node, one textured triangle.
TEST(CheckScene, FindsEverySingleFlippedBit) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(0, test::makeTexture(PayloadCodec::png, 4, 4, 3, 1))});
    ASSERT_EQ(faultsOf(folder.path()), std::vector<std::string>{});
    std::size_t flips = 0;
    for (const char* name : {"hierarchy.bin", "blocks/00000.pack"}) {
        const std::filesystem::path path = folder.path() / name;
        const Bytes good = test::readAll(path);
        for (std::size_t bit = 0; bit < good.size() * 8; ++bit, ++flips) {
            Bytes bytes = good;
            bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
            test::overwrite(path, bytes);
            const std::vector<std::string> faults = faultsOf(folder.path());
            ASSERT_FALSE(faults.empty()) << name << ": byte " << bit / 8 << ", bit " << bit % 8;
            ASSERT_TRUE(faults[0].starts_with(name)) << faults[0];
            ASSERT_TRUE(name != std::string("hierarchy.bin") || !openScene(folder.path()));
        }
        test::overwrite(path, good);
    }
    EXPECT_GT(flips, 3000u);
    EXPECT_EQ(faultsOf(folder.path()), std::vector<std::string>{});
}

TEST(CheckScene, SaysWhichNodeOfWhichPackIsDamaged) {
    const TemporaryFolder folder;
    const std::vector<BuiltBlock> built = test::writeTinyScene(folder.path(), {test::tinyBlock(1), test::tinyBlock(2)});
    const std::filesystem::path path = folder.path() / "blocks/00001.pack";
    Bytes bytes = test::readAll(path);
    const PayloadRef& payload = built[1].nodes[1].payload;  // joined: roots 0 1, then 2, then 3 and 4
    const std::string was = hashText(payload.checksum);
    bytes[payload.offset + 20] ^= 1;
    test::overwrite(path, bytes);
    const std::string is = hashText(hashBytes(&bytes[payload.offset], payload.sizeBytes));
    EXPECT_EQ(soleFault(folder.path()), "blocks/00001.pack: node 3 at byte " + std::to_string(payload.offset) +
                                            ": checksum does not match: " + is + " instead of " + was +
                                            " (the file is damaged: build it again)");
    const Scene scene = openScene(folder.path()).value();
    EXPECT_TRUE(readPayload(scene, 2));
    EXPECT_TRUE(says(lineOf(readPayload(scene, 3)), "00001.pack: node 3 at byte"));
}

TEST(CheckScene, FindsAFileThatShrinksAfterOpening) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(1)});
    const Scene scene = openScene(folder.path()).value();
    std::filesystem::resize_file(folder.path() / "blocks/00000.pack", 40);
    EXPECT_TRUE(says(lineOf(readPayload(scene, 1)), "the file ends too early"));
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

// A writer's bug: payloads, packs and records whole, but not in agreement.
TEST(CheckScene, HoldsPayloadsAgainstTheirRecords) {
    const TemporaryFolder folder;
    const auto written = [&](auto damage) {
        TinyBlock block = test::tinyBlock(1, test::makeTexture(PayloadCodec::png, 4, 4, 3, 1));
        BuiltBlock built = test::writePack(folder.path(), 0, block);
        damage(built.nodes[1]);
        PackWriter pack = PackWriter::create(folder.path(), 0).value();
        for (std::size_t i = 0; i < 2; ++i) built.nodes[i].payload = pack.append(encodePayload(block.nodes[i].data).value()).value();
        EXPECT_TRUE(pack.finish(built, kSettingsHash, kBlockHash));
        EXPECT_TRUE(writeScene(folder.path(), test::tinyInfo(), {built}));
        return soleFault(folder.path());
    };
    EXPECT_EQ(written([](BuiltNode&) {}), "0 faults");
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.vertices = 4; }), "the payload has 3 vertices, the record 4"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.texturedTriangles = 2; }), "1 textured triangles, the record 2"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.untexturedTriangles = 1; }), "0 untextured triangles, the record 1"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.textureWidth = 6; }), "4 texels across, the record 6"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.textureHeight = 6; }), "4 texels down, the record 6"));
    // Legs of 4 cells of 0.25 m: 0.5 m2; at 8 cells = 2 m from the grid's origin.
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.areaSquareMetres = 3.0f; }), "area is 0.500000 m2, the record says 3."));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.bounds.min.x = std::nextafter(2.0f, 3.0f); }), "a vertex lies outside"));
    EXPECT_EQ(written([](BuiltNode& n) { n.bounds.min.x = 2.0f; }), "0 faults");
}

TEST(CheckScene, HoldsTheHierarchyAgainstThePacks) {
    const TemporaryFolder folder;
    std::vector<BuiltBlock> built = test::writeTinyScene(folder.path(), {test::tinyBlock(0), test::tinyBlock(1)});
    built[1].nodes[1].staticBenefit += 1.0f;
    ASSERT_TRUE(writeScene(folder.path(), test::tinyInfo(), built));
    EXPECT_EQ(soleFault(folder.path()), "hierarchy.bin: node 2: differs from what the packs say of their nodes");
}

TEST(CheckScene, TellsHowFarItIsAndStopsWhenAsked) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(), {test::tinyBlock(3)});
    std::vector<double> fractions;
    const auto heard = [&](std::string_view, double fraction) {
        fractions.push_back(fraction);
        return fractions.size() != 6;
    };
    const Result<SceneCheck> check = checkScene(folder.path(), heard);
    EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
    ASSERT_TRUE(check);
    EXPECT_EQ(check->payloads, 4u);
    std::uint64_t bytes = 0;
    const Scene scene = openScene(folder.path()).value();
    for (const PayloadRef& payload : scene.hierarchy.payload) bytes += payload.sizeBytes;
    EXPECT_EQ(check->bytes, bytes);
    EXPECT_TRUE(says(lineOf(checkScene(folder.path(), heard)), "was stopped"));
}

TEST(WriteScene, WritesNothingThatItCouldNotRead) {
    const TemporaryFolder folder;
    EXPECT_FALSE(writeScene(folder.path(), test::tinyInfo(), {}));
    std::vector<BuiltBlock> blocks = {test::writePack(folder.path(), 0, test::tinyBlock(1))};
    SceneInfo info = test::tinyInfo();
    info.origin.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), info, blocks)), "the origin is not finite"));
    blocks[0].nodes[1].staticBenefit = -1.0f;
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)), "node 1: the benefit is negative"));
    blocks[0].nodes[1].staticBenefit = 1.0f;
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), {blocks[0], blocks[0]})), "number of its pack"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "hierarchy.bin"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene.toml"));
    std::filesystem::remove(folder.path() / "blocks/00000.pack");
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)), "00000.pack: cannot be opened"));
}

TEST(WriteScene, SaysWhichFileCannotBeWritten) {
    const TemporaryFolder folder;
    const std::vector<BuiltBlock> blocks = {test::writePack(folder.path(), 0, test::tinyBlock(0))};
    std::filesystem::create_directories(folder.path() / "hierarchy.bin" / "in the way");
    EXPECT_TRUE(says(lineOf(writeScene(folder.path(), test::tinyInfo(), blocks)), "hierarchy.bin: cannot be given its name"));
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

// Killed at each of these points, a build leaves no scene, and the next one ends with the bytes of an undisturbed one.
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
            EXPECT_EQ(test::readAll(folder.path() / name), test::readAll(undisturbed.path() / name)) << name << step;
        }
        EXPECT_EQ(faultsOf(folder.path()), std::vector<std::string>{}) << step;
    }
}

// Headers with a true checksum whose counts are at the caps, or one above.
TEST(ParseHierarchyFile, BelievesNoCountThatTheBytesCannotHold) {
    const auto verdict = [](std::uint32_t blocks, std::uint32_t nodes) {
        Bytes header(kHierarchyHeaderBytes, 0);
        std::memcpy(header.data(), "fbscene\n", 8);
        header[8] = 1;
        std::memcpy(&header[12], &blocks, 4);
        std::memcpy(&header[16], &nodes, 4);
        const std::uint64_t hash = hashBytes(header.data(), kHierarchyHeaderBytes - 8);
        std::memcpy(&header[kHierarchyHeaderBytes - 8], &hash, 8);
        return lineOf(parseHierarchyFile(header, "file"));
    };
    EXPECT_TRUE(says(verdict(kMaxBlocks, kMaxNodes), "the tables take 1951757056 bytes, but 0 are there"));
    EXPECT_TRUE(says(verdict(kMaxBlocks + 1, kMaxNodes), "cannot have 100001 blocks"));
    EXPECT_TRUE(says(verdict(kMaxBlocks, kMaxNodes + 1), "cannot have 100000 blocks and 16777217 nodes"));
    EXPECT_TRUE(says(verdict(0, 1), "cannot have"));
    EXPECT_TRUE(says(verdict(1, 0), "cannot have"));
}

}  // namespace
}  // namespace fb
