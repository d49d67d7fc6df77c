#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "base/random.h"
#include "load/finished_queue.h"
#include "payload_world.h"

namespace fb::test {
namespace {

constexpr std::uint64_t kNoCap = ~std::uint64_t{0};

// One root with three children; payloads of some hundred bytes.
PayloadWorld fourNodes() {
    return PayloadWorld({{kRoot, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, {3, 40, 50, 60});
}

std::uint32_t trianglesOf(NodeId node) {
    return 1 + node * 7 % 90;
}
// One root with so many children.
PayloadWorld manyNodes(std::uint32_t children) {
    std::vector<NodeSpec> specs = {{kRoot, 1, 0}};
    std::vector<std::uint32_t> triangles = {1};
    for (NodeId n = 1; n <= children; ++n) {
        specs.push_back({0, 1, 0});
        triangles.push_back(trianglesOf(n));
    }
    return {specs, triangles};
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

// More decoders from one list of wishes to the next, and fewer again: each node comes once, whole.
TEST(LoaderThread, DecodesOnAsManyThreadsAsItIsTold) {
    const PayloadWorld world = manyNodes(60);
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    std::vector<int> times(61, 0);
    NodeId next = 1;
    for (const int decoders : {1, 4, 2, 3}) {
        std::vector<Wish> wishes;
        for (int i = 0; i < 15; ++i) wishes.push_back({next++, 1.0});
        LoadSettings settings = chunksOf(1000);
        settings.decoders = decoders;
        loader->publish(wishes, settings);
        for (int i = 0; i < 15; ++i) {
            const FinishedLoad finished = takeNext(*loader);
            ASSERT_TRUE(finished.content.has_value());
            EXPECT_EQ((*finished.content)->indices.size(), 3 * trianglesOf(finished.node));
            EXPECT_LE(finished.stamps.firstRead, finished.stamps.read);
            EXPECT_LE(finished.stamps.read, finished.stamps.decoded);
            ++times[finished.node];
        }
    }
    for (NodeId n = 1; n <= 60; ++n) EXPECT_EQ(times[n], 1) << n;
    EXPECT_EQ(loader->counters().cancelled, 0u);
}

// Wishes that come and go while loads are read, decoded and finished: nothing comes that nobody wishes for, nothing twice,
// and every byte that was read was either delivered or counted as wasted.
TEST(LoaderThread, LosesNothingWhileWishesComeAndGo) {
    const PayloadWorld world = manyNodes(40);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        Disk disk;
        const std::unique_ptr<Loader> loader = startLoader(world, disk);
        LoadSettings settings = chunksOf(50 + random.index(3000));
        settings.decoders = 1 + static_cast<int>(random.index(4));
        std::uint64_t deliveredBytes = 0;
        std::vector<Wish> wishes;
        for (int frame = 0; frame < 200; ++frame) {
            if (random.index(3) == 0) {
                wishes.clear();
                for (NodeId n = 1; n <= 40; ++n) {
                    if (random.index(3) == 0) wishes.push_back({n, 1.0 + static_cast<double>(40 - n)});
                }
                loader->publish(wishes, settings);
            }
            if (random.index(2) == 0) std::this_thread::yield();
            FinishedLoad finished;
            while (loader->take(finished, kNoCap)) {
                ASSERT_TRUE(finished.content.has_value());
                const auto wish = std::ranges::find(wishes, finished.node, &Wish::node);
                ASSERT_NE(wish, wishes.end()) << "seed " << seed << ", node " << finished.node;
                wishes.erase(wish);
                deliveredBytes += world.payloadBytes(finished.node);
            }
        }
        loader->publish(wishes, settings);  // without those that came since
        for (std::size_t left = wishes.size(); left > 0; --left) {
            deliveredBytes += world.payloadBytes(takeNext(*loader).node);
        }
        // What was given up in the hands of a decoder is counted when it is done.
        const auto isCounted = [&] {
            const LoaderCounters counters = loader->counters();
            return counters.bytesRead == deliveredBytes + counters.wastedBytes;
        };
        for (int i = 0; i < 20000 && !isCounted(); ++i) std::this_thread::sleep_for(std::chrono::microseconds(100));
        EXPECT_TRUE(isCounted()) << "seed " << seed << ": read " << loader->counters().bytesRead << ", delivered "
                                 << deliveredBytes << ", wasted " << loader->counters().wastedBytes;
    }
}

TEST(LoaderThread, ReadsNoFasterThanTheLimit) {
    const PayloadWorld world({{kRoot, 1, 0}, {0, 1, 0}}, {1, 4000});
    Disk disk;
    const std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 1.0}};
    LoadSettings settings = chunksOf(1000);
    settings.diskLimitMBps = 0.2;
    loader->publish(wishes, settings);
    const FinishedLoad finished = takeNext(*loader);
    ASSERT_TRUE(finished.content.has_value());
    EXPECT_GE(finished.stamps.read - finished.stamps.firstRead, world.payloadBytes(1) / 0.2e6);
}

// The chunk would take 10 s.
TEST(LoaderThread, QuitsWhileItWaitsForASlowDisk) {
    const PayloadWorld world({{kRoot, 1, 0}, {0, 1, 0}}, {1, 4000});
    Disk disk;
    std::unique_ptr<Loader> loader = startLoader(world, disk);
    const Wish wishes[] = {{1, 1.0}};
    LoadSettings settings = chunksOf(4000);
    settings.diskLimitMBps = 1e-4;
    loader->publish(wishes, settings);
    waitForReads(*loader, disk, 1);
    const SteadyClock::time_point begun = SteadyClock::now();
    loader.reset();
    EXPECT_LT(millisecondsSince(begun), 8000.0);
    EXPECT_EQ(disk.reads().size(), 1u);
}

TEST(LoaderThread, QuitsFiveHundredTimesWhileLoading) {
    const PayloadWorld world = fourNodes();
    const Wish wishes[] = {{1, 3.0}, {2, 2.0}, {3, 1.0}};
    for (int round = 0; round < 500; ++round) {
        Disk disk;
        std::unique_ptr<Loader> loader = startLoader(world, disk);
        if (round % 10 == 0) continue;  // without any wish
        LoadSettings settings = chunksOf(1 + static_cast<std::uint64_t>(round % 100));
        settings.decoders = 1 + round % 3;
        loader->publish(wishes, settings);
        if (round % 3 == 0) waitForReads(*loader, disk, static_cast<std::size_t>(round) % 7 + 1);
        FinishedLoad finished;
        if (round % 4 == 0) static_cast<void>(loader->take(finished, kNoCap));
        if (round % 5 == 0) loader->publish({}, {});
    }
}

}  // namespace
}  // namespace fb::test
