#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "base/random.h"
#include "scenefile/hierarchy_file.h"
#include "scenefile/pack_format.h"
#include "scenefile/tiny_scene.h"

namespace fb {
namespace {

using test::Bytes;
using test::faultsOf;
using test::kBlockHash;
using test::kSettingsHash;
using test::lineOf;
using test::TemporaryFolder;
using test::TinyBlock;

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
            if (p.pack != q.pack || p.offset != q.offset || p.sizeBytes != q.sizeBytes ||
                p.checksum != q.checksum) {
                return false;
            }
        }
        return true;
    };
    const auto sameGrids = [&] {
        for (std::size_t i = 0; i < a.grids.size(); ++i) {
            if (a.grids[i].origin != b.grids[i].origin || a.grids[i].step != b.grids[i].step) return false;
        }
        return a.grids.size() == b.grids.size() && a.kinds == b.kinds;
    };
    return a.rootCount == b.rootCount && a.parent == b.parent && a.firstChild == b.firstChild &&
           a.childCount == b.childCount && a.level == b.level && a.block == b.block &&
           a.texturedTriangles == b.texturedTriangles && a.untexturedTriangles == b.untexturedTriangles &&
           a.skirtTriangles == b.skirtTriangles && a.borderErrorMetres == b.borderErrorMetres &&
           a.vertices == b.vertices && a.staticBenefit == b.staticBenefit &&
           a.averageNormal == b.averageNormal && a.normalCoherence == b.normalCoherence &&
           a.areaSquareMetres == b.areaSquareMetres && a.geometricErrorMetres == b.geometricErrorMetres &&
           a.textureWidth == b.textureWidth && a.textureHeight == b.textureHeight &&
           a.residentBytes == b.residentBytes && sameBounds() && samePayloads() && sameGrids();
}

// A tree of about `wanted` nodes with random numbers that keep the rules; payloads of up to 50 bytes lie as
// in a pack.
BuiltBlock randomBlock(std::uint32_t pack, Random& random, std::size_t wanted) {
    BuiltBlock block;
    block.kind = random.index(2) == 0 ? BlockKind::objects : BlockKind::terrain;
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
    std::uint64_t offset = kPackHeaderBytes;
    for (BuiltNode& node : block.nodes) {
        node.texturedTriangles = static_cast<std::uint32_t>(random.index(5000));
        node.untexturedTriangles = static_cast<std::uint32_t>(random.index(5000));
        node.skirtTriangles =
            static_cast<std::uint32_t>(random.index(node.texturedTriangles + node.untexturedTriangles + 1));
        node.borderErrorMetres = static_cast<float>(random.uniform(0.0, 9.0));
        node.vertices = static_cast<std::uint32_t>(random.index(9000));
        node.staticBenefit = static_cast<float>(random.uniform(0.0, 1e6));
        node.normalCoherence = static_cast<float>(random.uniform());
        node.areaSquareMetres = static_cast<float>(random.uniform(0.0, 1e6));
        const double turn = random.uniform(0.0, 6.28);
        node.averageNormal = {static_cast<float>(std::cos(turn)), 0.0f, static_cast<float>(std::sin(turn))};
        node.textureWidth =
            static_cast<std::uint16_t>(atlasSide(static_cast<std::uint32_t>(random.index(4096))));
        node.textureHeight =
            static_cast<std::uint16_t>(atlasSide(static_cast<std::uint32_t>(random.index(4096))));
        node.payload = {pack, offset, static_cast<std::uint32_t>(1 + random.index(50)), random.bits()};
        offset = alignPayload(offset + node.payload.sizeBytes);
    }
    return block;
}

RC_GTEST_PROP(HierarchyFile, GivesBackWhatWasWritten, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto blockCount = *rc::gen::inRange<std::uint32_t>(1, 6);
    const auto wanted = *rc::gen::inRange<std::size_t>(1, 60);
    HierarchyFile file;
    std::vector<BuiltBlock> blocks;
    for (std::uint32_t b = 0; b < blockCount; ++b) {
        blocks.push_back(randomBlock(b * 2, random, wanted));
        file.packs.push_back({b * 2, 1'000'000, random.bits()});
    }
    file.hierarchy = joinBlocks(blocks);
    const Bytes bytes = encodeHierarchyFile(file);
    const Result<HierarchyFile> read = parseHierarchyFile(bytes, "file");
    RC_ASSERT(lineOf(read) == "no error");
    RC_ASSERT(same(read->hierarchy, file.hierarchy));
    RC_ASSERT(read->packs.size() == file.packs.size());
    for (std::size_t b = 0; b < blockCount; ++b) {
        RC_ASSERT(read->packs[b].number == file.packs[b].number);
        RC_ASSERT(read->packs[b].sizeBytes == file.packs[b].sizeBytes);
        RC_ASSERT(read->packs[b].seal == file.packs[b].seal);
    }
    RC_ASSERT(encodeHierarchyFile(*read) == bytes);
}

TEST(Scene, GivesBackTheHierarchyThatWasWritten) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const TemporaryFolder folder;
        Random random(seed);
        std::vector<BuiltBlock> blocks;
        for (std::uint32_t b = 0; b <= seed % 3; ++b) {
            BuiltBlock& block = blocks.emplace_back(randomBlock(b * 2, random, 1 + seed * 10));
            PackWriter pack = PackWriter::create(folder.path(), b * 2).value();
            for (BuiltNode& node : block.nodes)
                node.payload = pack.append(Bytes(node.payload.sizeBytes, 7)).value();
            ASSERT_TRUE(pack.finish(block, kSettingsHash, kBlockHash));
        }
        const Result<void> written = writeScene(folder.path(), test::tinyInfo(), blocks);
        ASSERT_TRUE(written) << lineOf(written);
        const Result<Scene> scene = openScene(folder.path());
        ASSERT_TRUE(scene) << lineOf(scene);
        EXPECT_TRUE(same(scene->hierarchy, joinBlocks(blocks)));
        EXPECT_EQ(scene->packs.size(), (seed % 3) * 2 + 1);  // indexed by number: the odd ones are not there
        EXPECT_TRUE(readPayload(*scene, scene->hierarchy.size() - 1));
    }
}

// Meshes, textures and records together: what build/ will write must pass the check without a fault.
TEST(Scene, PassesItsCheckWithTexturesMasksAndNone) {
    const TemporaryFolder folder;
    TinyBlock masked = test::tinyBlock(0, test::makeTexture(PayloadCodec::png, 12, 8, 4, 3));
    masked.nodes[0].data.mesh.flags.alphaMask = true;
    masked.grid = {{-0.5, 100.0, 3.0}, 0.0625};
    test::writeTinyScene(
        folder.path(),
        {test::tinyBlock(3, test::makeTexture(PayloadCodec::jpeg, 16, 6, 3, 2)), masked, test::tinyBlock(1)});
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
        test::writeTinyScene(folder->path(),
                             {test::tinyBlock(2, test::makeTexture(PayloadCodec::jpeg, 8, 8, 3, 1))});
    }
    for (const char* name : {"hierarchy.bin", "scene.toml", "blocks/00000.pack"}) {
        EXPECT_EQ(test::readAll(once.path() / name), test::readAll(twice.path() / name)) << name;
    }
}

}  // namespace
}  // namespace fb
