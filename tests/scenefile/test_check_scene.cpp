#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::Bytes;
using test::faultsOf;
using test::kBlockHash;
using test::kSettingsHash;
using test::lineOf;
using test::says;
using test::soleFault;
using test::TemporaryFolder;
using test::TinyBlock;

// The smallest scene: one node, one textured triangle.
TEST(CheckScene, FindsEverySingleFlippedBit) {
    const TemporaryFolder folder;
    test::writeTinyScene(folder.path(),
                         {test::tinyBlock(0, test::makeTexture(PayloadCodec::png, 4, 4, 3, 1))});
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
    const std::vector<BuiltBlock> built =
        test::writeTinyScene(folder.path(), {test::tinyBlock(1), test::tinyBlock(2)});
    const std::filesystem::path path = folder.path() / "blocks/00001.pack";
    Bytes bytes = test::readAll(path);
    const PayloadRef& payload = built[1].nodes[1].payload;  // joined: roots 0 1, then 2, then 3 and 4
    const std::string was = hashText(payload.checksum);
    bytes[payload.offset + 20] ^= 1;
    test::overwrite(path, bytes);
    const std::string is = hashText(hashBytes(&bytes[payload.offset], payload.sizeBytes));
    EXPECT_EQ(soleFault(folder.path()), "blocks/00001.pack: node 3 at byte " +
                                            std::to_string(payload.offset) +
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

// A writer's bug: payloads, packs and records whole, but not in agreement.
TEST(CheckScene, HoldsPayloadsAgainstTheirRecords) {
    const TemporaryFolder folder;
    const auto written = [&](auto damage) {
        TinyBlock block = test::tinyBlock(1, test::makeTexture(PayloadCodec::png, 4, 4, 3, 1));
        BuiltBlock built = test::writePack(folder.path(), 0, block);
        damage(built.nodes[1]);
        PackWriter pack = PackWriter::create(folder.path(), 0).value();
        for (std::size_t i = 0; i < 2; ++i)
            built.nodes[i].payload = pack.append(encodePayload(block.nodes[i].data).value()).value();
        EXPECT_TRUE(pack.finish(built, kSettingsHash, kBlockHash));
        EXPECT_TRUE(writeScene(folder.path(), test::tinyInfo(), {built}));
        return soleFault(folder.path());
    };
    EXPECT_EQ(written([](BuiltNode&) {}), "0 faults");
    EXPECT_TRUE(
        says(written([](BuiltNode& n) { n.vertices = 4; }), "the payload has 3 vertices, the record 4"));
    EXPECT_TRUE(
        says(written([](BuiltNode& n) { n.texturedTriangles = 2; }), "1 textured triangles, the record 2"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.untexturedTriangles = 1; }),
                     "0 untextured triangles, the record 1"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.textureWidth = 6; }), "4 texels across, the record 6"));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.textureHeight = 6; }), "4 texels down, the record 6"));
    // Legs of 4 cells of 0.25 m: 0.5 m2; at 8 cells = 2 m from the grid's origin.
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.areaSquareMetres = 3.0f; }),
                     "area is 0.500000 m2, the record says 3."));
    EXPECT_TRUE(says(written([](BuiltNode& n) { n.bounds.min.x = std::nextafter(2.0f, 3.0f); }),
                     "a vertex lies outside"));
    EXPECT_EQ(written([](BuiltNode& n) { n.bounds.min.x = 2.0f; }), "0 faults");
}

TEST(CheckScene, HoldsTheHierarchyAgainstThePacks) {
    const TemporaryFolder folder;
    std::vector<BuiltBlock> built =
        test::writeTinyScene(folder.path(), {test::tinyBlock(0), test::tinyBlock(1)});
    built[1].nodes[1].staticBenefit += 1.0f;
    ASSERT_TRUE(writeScene(folder.path(), test::tinyInfo(), built));
    EXPECT_EQ(soleFault(folder.path()),
              "hierarchy.bin: node 2: differs from what the packs say of their nodes");
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

}  // namespace
}  // namespace fb
