#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "load/finished_queue.h"
#include "payload_world.h"

namespace fb::test {
namespace {

constexpr std::uint64_t kNoCap = ~std::uint64_t{0};

// One root with three children; payloads of some hundred bytes.
PayloadWorld fourNodes() {
    return PayloadWorld({{kRoot, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, {3, 40, 50, 60});
}

TEST(LoaderThread, DeliversWhatIsWishedForInThatOrder) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{2, 3.0}, {1, 2.0}, {3, 1.0}};
    loader->publish(wishes, chunksOf(65536));
    for (const Wish& wish : wishes) {
        const FinishedLoad finished = takeNext(*loader);
        EXPECT_EQ(finished.node, wish.node);
        ASSERT_TRUE(finished.content.has_value()) << finished.content.error().oneLine();
        const std::uint32_t triangles = 30 + 10 * wish.node;
        EXPECT_EQ((*finished.content)->vertices.size(), triangles + 2);
        EXPECT_EQ((*finished.content)->indices.size(), triangles * 3);
    }
    const LoaderCounters counters = loader->counters();
    EXPECT_EQ(counters.cancelled, 0u);
    EXPECT_EQ(counters.suspended, 0u);
    EXPECT_EQ(counters.wastedBytes, 0u);
}

TEST(LoaderThread, ReadsInChunksFromStartToEnd) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 1.0}};
    loader->publish(wishes, chunksOf(100));
    ASSERT_TRUE(takeNext(*loader).content.has_value());
    const PayloadRef& payload = world.scene.hierarchy.payload[1];
    ASSERT_GT(payload.sizeBytes, 200u);
    std::uint64_t expected = payload.offset;
    for (const Disk::Read& read : disk.reads()) {
        EXPECT_EQ(read.offset, expected);
        EXPECT_EQ(read.bytes, std::min<std::uint64_t>(100, payload.offset + payload.sizeBytes - expected));
        expected += read.bytes;
    }
    EXPECT_EQ(expected, payload.offset + payload.sizeBytes);
}

TEST(LoaderThread, SuspendsForAMoreUrgentNodeAndResumesWithoutReadingTwice) {
    const PayloadWorld world = fourNodes();
    const std::uint64_t chunk =
        (world.payloadBytes(3) + 2) / 3;  // three chunks for node 3, the last perhaps short
    Disk disk;
    disk.closeGate();
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish first[] = {{3, 1.0}};
    loader->publish(first, chunksOf(chunk));
    disk.allow(1);
    waitForReads(*loader, disk, 2);  // in the second chunk of node 3
    const Wish second[] = {{1, 2.0}, {3, 1.0}};
    loader->publish(second, chunksOf(chunk));
    disk.openGate();
    EXPECT_EQ(takeNext(*loader).node, 1u);
    const FinishedLoad late = takeNext(*loader);
    EXPECT_EQ(late.node, 3u);
    EXPECT_TRUE(late.content.has_value());

    const std::vector<Disk::Read> reads = disk.reads();
    const std::uint64_t of1 = world.scene.hierarchy.payload[1].offset;
    const std::uint64_t of3 = world.scene.hierarchy.payload[3].offset;
    EXPECT_EQ(reads[0].offset, of3);
    EXPECT_EQ(reads[1].offset, of3 + chunk);
    EXPECT_EQ(reads[2].offset, of1);
    EXPECT_EQ(reads.back().offset, of3 + 2 * chunk);
    std::uint64_t bytes = 0;
    for (const Disk::Read& read : reads) bytes += read.bytes;
    EXPECT_EQ(bytes, world.payloadBytes(1) + world.payloadBytes(3));
    EXPECT_EQ(loader->counters().suspended, 1u);
    EXPECT_EQ(loader->counters().bytesRead, bytes);
    EXPECT_EQ(loader->counters().wastedBytes, 0u);
}

TEST(LoaderThread, DoesNotSuspendForAnEquallyUrgentNode) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    disk.closeGate();
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish first[] = {{3, 1.0}};
    loader->publish(first, chunksOf(100));
    disk.allow(1);
    waitForReads(*loader, disk, 2);
    const Wish second[] = {{1, 1.0}, {3, 1.0}};
    loader->publish(second, chunksOf(100));
    disk.openGate();
    EXPECT_EQ(takeNext(*loader).node, 3u);
    EXPECT_EQ(takeNext(*loader).node, 1u);
    EXPECT_EQ(loader->counters().suspended, 0u);
}

TEST(LoaderThread, DropsALoadThatIsNoLongerWishedForAfterItsChunk) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    disk.closeGate();
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish first[] = {{3, 1.0}};
    loader->publish(first, chunksOf(100));
    disk.allow(1);
    waitForReads(*loader, disk, 2);
    const Wish second[] = {{1, 1.0}};
    loader->publish(second, chunksOf(1000000));
    disk.openGate();
    EXPECT_EQ(takeNext(*loader).node, 1u);
    EXPECT_EQ(disk.reads().size(), 3u) << "two chunks of node 3, node 1 in one";
    EXPECT_EQ(loader->counters().cancelled, 1u);
    EXPECT_EQ(loader->counters().wastedBytes, 200u);
    EXPECT_EQ(loader->counters().suspended, 0u);
    // Wished for again, it begins again.
    loader->publish(first, chunksOf(1000000));
    EXPECT_EQ(takeNext(*loader).node, 3u);
    EXPECT_EQ(disk.reads().back().offset, world.scene.hierarchy.payload[3].offset);
}

TEST(LoaderThread, DropsAFinishedLoadWhoseWishWasWithdrawn) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish both[] = {{1, 2.0}, {2, 1.0}};
    loader->publish(both, chunksOf(1000000));
    waitForReads(*loader, disk, 2);  // node 1 is finished by then, and stands in the queue
    const Wish one[] = {{2, 1.0}};
    loader->publish(one, chunksOf(1000000));
    EXPECT_EQ(takeNext(*loader).node, 2u);
    EXPECT_EQ(loader->counters().cancelled, 1u);
    EXPECT_EQ(loader->counters().wastedBytes, world.payloadBytes(1));
    FinishedLoad finished;
    EXPECT_FALSE(loader->take(finished, kNoCap));
}

TEST(LoaderThread, ReadsAFinishedLoadOnceHoweverOftenItIsWishedFor) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 2.0}, {2, 1.0}};
    for (int frame = 0; frame < 200; ++frame) loader->publish(wishes, chunksOf(50));
    EXPECT_EQ(takeNext(*loader).node, 1u);
    const Wish rest[] = {{2, 1.0}};
    for (int frame = 0; frame < 200; ++frame) loader->publish(rest, chunksOf(50));
    EXPECT_EQ(takeNext(*loader).node, 2u);
    EXPECT_EQ(loader->counters().bytesRead, world.payloadBytes(1) + world.payloadBytes(2));
    // And once more when it was taken, given up and is wished for again.
    loader->publish(rest, chunksOf(50));
    EXPECT_EQ(takeNext(*loader).node, 2u);
}

TEST(LoaderThread, HearsWishesAfterALongTimeWithoutAny) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    for (const NodeId node : {1u, 2u}) {
        for (int frame = 0; frame < 100; ++frame) loader->publish({}, {});
        const Wish wishes[] = {{node, 1.0}};
        loader->publish(wishes, chunksOf(65536));
        EXPECT_EQ(takeNext(*loader).node, node);
    }
    // And of their end.
    disk.closeGate();
    const Wish wishes[] = {{3, 1.0}};
    loader->publish(wishes, chunksOf(100));
    waitForReads(*loader, disk, 3);
    for (int frame = 0; frame < 100; ++frame) loader->publish({}, {});
    disk.openGate();
    while (loader->counters().cancelled == 0) std::this_thread::yield();
    EXPECT_EQ(disk.reads().size(), 3u);
}

TEST(LoaderThread, HoldsBackALoadThatIsLargerThanTheCap) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 2.0}, {2, 1.0}};
    loader->publish(wishes, chunksOf(1000000));
    waitForReads(*loader, disk, 2);
    FinishedLoad finished;
    const std::uint64_t bytes = world.scene.hierarchy.residentBytes[1];
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(loader->take(finished, bytes - 1));
    while (!loader->take(finished, bytes)) std::this_thread::yield();
    EXPECT_EQ(finished.node, 1u);
}

TEST(LoaderThread, StopsReadingWhileItsQueueIsFull) {
    constexpr NodeId kNodes = FinishedQueue::kCapacity + 40;
    const PayloadWorld world = manyNodes(kNodes);
    std::vector<Wish> wishes;
    for (NodeId n = 1; n <= kNodes; ++n) wishes.push_back({n, 1.0});
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    loader->publish(wishes, chunksOf(1000000));
    waitForReads(*loader, disk, FinishedQueue::kCapacity);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(disk.reads().size(), FinishedQueue::kCapacity);
    for (NodeId n = 1; n <= kNodes; ++n) EXPECT_EQ(takeNext(*loader).node, n);
}

TEST(LoaderThread, NeverParsesBytesWhoseChecksumIsWrong) {
    // Node 1 gets the bytes of a payload that is perfectly valid, but another one.
    PayloadWorld world = fourNodes();
    world.scene.hierarchy.payload[1].offset = world.scene.hierarchy.payload[2].offset;
    world.scene.hierarchy.payload[1].sizeBytes = world.scene.hierarchy.payload[2].sizeBytes;
    world.scene.hierarchy.residentBytes[1] = world.scene.hierarchy.residentBytes[2];
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 1.0}, {2, 1.0}};
    loader->publish(wishes, chunksOf(65536));
    const FinishedLoad damaged = takeNext(*loader);
    EXPECT_EQ(damaged.node, 1u);
    ASSERT_FALSE(damaged.content.has_value());
    EXPECT_NE(damaged.content.error().reason.find("checksum"), std::string::npos);
    EXPECT_NE(damaged.content.error().place.find("node 1"), std::string::npos);
    EXPECT_TRUE(takeNext(*loader).content.has_value());
}

TEST(LoaderThread, RefusesContentThatTakesMoreMemoryThanTheHierarchySays) {
    PayloadWorld world = fourNodes();
    world.scene.hierarchy.residentBytes[1] -= 1;
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 1.0}};
    loader->publish(wishes, chunksOf(65536));
    const FinishedLoad finished = takeNext(*loader);
    ASSERT_FALSE(finished.content.has_value());
    // 42 vertices of 24 bytes and 120 indices of 4.
    EXPECT_EQ(finished.content.error().reason, "takes 1488 bytes in memory, the hierarchy says 1487");
}

TEST(LoaderThread, ReportsAReadErrorAndGoesOn) {
    const PayloadWorld world = fourNodes();
    Disk disk;
    disk.failRead(1);
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 2.0}, {2, 1.0}};
    loader->publish(wishes, chunksOf(100));
    const FinishedLoad failed = takeNext(*loader);
    EXPECT_EQ(failed.node, 1u);
    ASSERT_FALSE(failed.content.has_value());
    EXPECT_EQ(failed.content.error().oneLine(), "disk: node 1: EIO");
    const FinishedLoad good = takeNext(*loader);
    EXPECT_EQ(good.node, 2u);
    EXPECT_TRUE(good.content.has_value());
}

TEST(LoaderThread, ReadsAtLowPriority) {
    const PayloadWorld world = fourNodes();
    struct Ask final : PayloadSource {
        std::atomic<int>& niceness;
        explicit Ask(std::atomic<int>& into) : niceness(into) {}
        Result<void> readAt(std::uint32_t, std::uint64_t, std::span<std::uint8_t>) override {
            niceness = getpriority(PRIO_PROCESS, 0);
            return failure("disk", {}, "empty");
        }
    };
    std::atomic<int> niceness{-100};
    const std::unique_ptr<Loader> loader = startLoaderThread(world.scene, std::make_unique<Ask>(niceness));
    const Wish wishes[] = {{1, 1.0}};
    loader->publish(wishes, chunksOf(65536));
    EXPECT_FALSE(takeNext(*loader).content.has_value());
    EXPECT_EQ(niceness, std::min(getpriority(PRIO_PROCESS, 0) + 10, 19));
}

TEST(LoaderThread, StopsWithinOneChunk) {
    const PayloadWorld world({{kRoot, 1, 0}, {0, 1, 0}}, {1, 4000});
    ASSERT_GT(world.payloadBytes(1), 5000u);
    struct Slow final : PayloadSource {
        std::atomic<int>& reads;
        explicit Slow(std::atomic<int>& into) : reads(into) {}
        Result<void> readAt(std::uint32_t, std::uint64_t, std::span<std::uint8_t>) override {
            ++reads;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return {};
        }
    };
    std::atomic<int> reads{0};
    std::unique_ptr<Loader> loader = startLoaderThread(world.scene, std::make_unique<Slow>(reads));
    const Wish wishes[] = {{1, 1.0}};
    loader->publish(wishes, chunksOf(1));  // thousands of reads, seconds in all
    FinishedLoad none;
    while (reads == 0) EXPECT_FALSE(loader->take(none, 0));
    loader.reset();
    EXPECT_LT(reads, 5000);
}

}  // namespace
}  // namespace fb::test
