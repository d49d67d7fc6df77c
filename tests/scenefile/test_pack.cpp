#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "base/hash.h"
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

// All that a block says, as bytes: equal blocks give equal bytes.
Bytes asBytes(const BuiltBlock& block) {
    return encodeTrailer({0, 0, block});
}

bool reusable(const std::filesystem::path& folder) {
    return reusePack(folder, 0, kSettingsHash, kBlockHash).has_value();
}

std::size_t filesIn(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator{}));
}

TEST(ReusePack, GivesTheBlockAsItWasBuilt) {
    const TemporaryFolder folder;
    const BuiltBlock built = test::writePack(folder.path(), 0, test::tinyBlock(3));
    const std::optional<BuiltBlock> again = reusePack(folder.path(), 0, kSettingsHash, kBlockHash);
    ASSERT_TRUE(again);
    EXPECT_EQ(asBytes(*again), asBytes(built));
    ASSERT_EQ(again->nodes.size(), 4u);
    EXPECT_EQ(again->grid.step, 0.25);
    EXPECT_EQ(again->nodes[0].childCount, 3u);
    EXPECT_EQ(again->nodes[3].level, 1);
    EXPECT_EQ(again->nodes[3].payload.checksum, built.nodes[3].payload.checksum);
}

TEST(ReusePack, KeepsWhatIsKnownOfTheSourceAndOfStuckNodes) {
    BuiltBlock block;
    block.nodes.resize(2);
    block.nodes[1].level = 1;
    block.nodes[1].stuck = true;
    block.sourceTriangles = 123'456'789'012;
    block.sourceAreaSquareMetres = 0.25;
    const Bytes bytes = encodeTrailer({1, 2, block});
    const Result<PackTrailer> read = parseTrailer(bytes, "pack");
    ASSERT_TRUE(read) << lineOf(read);
    EXPECT_EQ(read->block.sourceTriangles, 123'456'789'012u);
    EXPECT_EQ(read->block.sourceAreaSquareMetres, 0.25);
    EXPECT_FALSE(read->block.nodes[0].stuck);
    EXPECT_TRUE(read->block.nodes[1].stuck);
    EXPECT_EQ(read->block.nodes[1].level, 1);
    block.sourceAreaSquareMetres = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(parseTrailer(encodeTrailer({1, 2, block}), "pack"));
}

TEST(TakePack, AsksForTheSettingsAndAWholeTrailerOnly) {
    const TemporaryFolder folder;
    (void)test::writePack(folder.path(), 0, test::tinyBlock(1));
    EXPECT_TRUE(takePack(folder.path(), 0, kSettingsHash));
    EXPECT_FALSE(takePack(folder.path(), 0, kSettingsHash + 1));
    EXPECT_FALSE(takePack(folder.path(), 1, kSettingsHash));
    Bytes bytes = test::readAll(folder.path() / packName(0));
    bytes.pop_back();
    test::overwrite(folder.path() / packName(0), bytes);
    EXPECT_FALSE(takePack(folder.path(), 0, kSettingsHash));
}

TEST(ReusePack, GivesNothingForOtherSettingsSourceOrBlock) {
    const TemporaryFolder folder;
    (void)test::writePack(folder.path(), 0, test::tinyBlock(1));
    EXPECT_TRUE(reusable(folder.path()));
    EXPECT_FALSE(reusePack(folder.path(), 0, kSettingsHash + 1, kBlockHash));
    EXPECT_FALSE(reusePack(folder.path(), 0, kSettingsHash, kBlockHash + 1));
    EXPECT_FALSE(reusePack(folder.path(), 1, kSettingsHash, kBlockHash));
    std::filesystem::rename(folder.path() / packName(0), folder.path() / packName(1));
    EXPECT_FALSE(reusePack(folder.path(), 1, kSettingsHash, kBlockHash));
    EXPECT_FALSE(reusable(folder.path() / "nowhere"));
}

TEST(ReusePack, GivesNothingForAnyPrefixOrOneByteMore) {
    const TemporaryFolder folder;
    (void)test::writePack(folder.path(), 0, test::tinyBlock(1));
    const std::filesystem::path pack = folder.path() / packName(0);
    Bytes bytes = test::readAll(pack);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        test::overwrite(pack, std::span(bytes).first(length));
        EXPECT_FALSE(reusable(folder.path())) << length;
    }
    bytes.push_back(0);
    test::overwrite(pack, bytes);
    EXPECT_FALSE(reusable(folder.path()));
    bytes.pop_back();
    test::overwrite(pack, bytes);
    EXPECT_TRUE(reusable(folder.path()));
}

TEST(ReusePack, GivesNothingForAnyFlippedBit) {
    const TemporaryFolder folder;
    (void)test::writePack(folder.path(), 0, test::tinyBlock(1));
    const std::filesystem::path pack = folder.path() / packName(0);
    Bytes bytes = test::readAll(pack);
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
        bytes[bit / 8] ^= mask;
        test::overwrite(pack, bytes);
        EXPECT_FALSE(reusable(folder.path())) << "byte " << bit / 8 << " bit " << bit % 8;
        bytes[bit / 8] ^= mask;
    }
}

// A trailer with a true checksum is still not believed: this is what a bug of a writer, or malice, would look
// like.
TEST(ReusePack, GivesNothingForASealedBlockThatBreaksTheRules) {
    const TemporaryFolder folder;
    const BuiltBlock good = test::writePack(folder.path(), 0, test::tinyBlock(2));
    const std::filesystem::path pack = folder.path() / packName(0);
    const Bytes bytes = test::readAll(pack);
    const std::size_t payloadsEnd = bytes.size() - encodeTrailer({0, 0, good}).size();
    const auto sealed = [&](const BuiltBlock& block) {
        Bytes changed(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(payloadsEnd));
        const Bytes trailer = encodeTrailer({kSettingsHash, kBlockHash, block});
        changed.insert(changed.end(), trailer.begin(), trailer.end());
        test::overwrite(pack, changed);
        return reusable(folder.path());
    };
    EXPECT_TRUE(sealed(good));
    const auto broken = [&](auto damage) {
        BuiltBlock block = good;
        damage(block);
        return !sealed(block);
    };
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes.clear(); }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes.pop_back(); }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[1].parentInBlock = 1; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].parentInBlock = 4'000'000'000u; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].level = 2; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[0].level = 1; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[0].childCount = 3; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].payload.offset += 8; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].payload.sizeBytes += 8; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].payload.sizeBytes = 0; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[2].payload.offset = ~std::uint64_t{7}; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { std::swap(b.nodes[1].payload, b.nodes[2].payload); }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.nodes[1].payload.pack = 1; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.grid.step = 0.3; }));
    EXPECT_TRUE(broken([](BuiltBlock& b) { b.kind = static_cast<BlockKind>(2); }));
}

TEST(ParseTrailer, BelievesNoCountThatTheBytesCannotHold) {
    const TemporaryFolder folder;
    const BuiltBlock built = test::writePack(folder.path(), 0, test::tinyBlock(0));
    const Bytes good = encodeTrailer({0, 0, built});
    EXPECT_EQ(good.size(), kLeastTrailerBytes);
    EXPECT_TRUE(parseTrailer(good, "pack"));
    for (std::uint64_t count :
         {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{kMaxNodes} + 1, ~std::uint64_t{0}}) {
        Bytes bytes = good;
        std::memcpy(bytes.data() + 80, &count, 8);
        EXPECT_TRUE(
            says(lineOf(parseTrailer(bytes, "pack")), "pack: trailer: claims a wrong number of nodes"))
            << count;
    }
}

TEST(PackWriter, LeavesNothingBehindWhenItIsNotFinished) {
    const TemporaryFolder folder;
    {
        PackWriter pack = PackWriter::create(folder.path(), 3).value();
        (void)pack.append(Bytes(100, 1));
        EXPECT_EQ(filesIn(folder.path() / "blocks"), 1u);
        EXPECT_FALSE(std::filesystem::exists(folder.path() / packName(3)));
    }
    EXPECT_EQ(filesIn(folder.path() / "blocks"), 0u);
}

TEST(PackWriter, PutsPayloadsAtMultiplesOfEight) {
    const TemporaryFolder folder;
    PackWriter pack = PackWriter::create(folder.path(), 0).value();
    const PayloadRef first = pack.append(Bytes(13, 1)).value();
    const PayloadRef second = pack.append(Bytes(8, 2)).value();
    const PayloadRef third = pack.append(Bytes(1, 3)).value();
    EXPECT_EQ(first.offset, 16u);
    EXPECT_EQ(second.offset, 32u);  // 16 + 13, and 3 zeros
    EXPECT_EQ(third.offset, 40u);
    EXPECT_EQ(first.sizeBytes, 13u);
    EXPECT_EQ(first.checksum, hashBytes(Bytes(13, 1).data(), 13));
}

TEST(PackWriter, SaysWhichFileCannotBeWritten) {
    const TemporaryFolder folder;
    test::overwrite(folder.path() / "blocks", {});  // a file where the folder should be
    EXPECT_TRUE(says(lineOf(PackWriter::create(folder.path(), 0)), "blocks: the folder cannot be made"));
    EXPECT_TRUE(says(lineOf(PackWriter::create("/proc/nowhere", 0)),
                     "/proc/nowhere/blocks: the folder cannot be made"));
}

TEST(PackWriter, AcceptsTheLastBlockNumberAndRefusesTheNext) {
    const TemporaryFolder folder;
    EXPECT_TRUE(PackWriter::create(folder.path(), kMaxBlocks - 1));
    EXPECT_TRUE(says(lineOf(PackWriter::create(folder.path(), kMaxBlocks)), "at most 100000 blocks"));
}

// A full disk, as the process's own limit on file sizes plays it.
TEST(PackWriter, ReportsAFullDiskAndLeavesNoFile) {
    const TemporaryFolder folder;
    PackWriter pack = PackWriter::create(folder.path(), 0).value();
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    rlimit small = limit;
    small.rlim_cur = 1000;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Result<PayloadRef> written = pack.append(Bytes(5000, 1));
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::signal(SIGXFSZ, before);
    EXPECT_TRUE(says(lineOf(written), "00000.pack: byte 1000: cannot be written")) << lineOf(written);
    EXPECT_EQ(filesIn(folder.path() / "blocks"), 0u);
}

}  // namespace
}  // namespace fb
