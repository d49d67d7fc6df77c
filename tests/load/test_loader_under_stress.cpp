// The loader's threads with several decoders, changing wishes, a slow disk and many ends.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/random.h"
#include "payload_world.h"

namespace fb::test {
namespace {

constexpr std::uint64_t kNoCap = ~std::uint64_t{0};

// More decoders from one list of wishes to the next, and fewer again: each node comes once, whole.
TEST(LoaderUnderStress, DecodesOnAsManyThreadsAsItIsTold) {
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
TEST(LoaderUnderStress, LosesNothingWhileWishesComeAndGo) {
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

TEST(LoaderUnderStress, ReadsNoFasterThanTheLimit) {
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
TEST(LoaderUnderStress, QuitsWhileItWaitsForASlowDisk) {
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

TEST(LoaderUnderStress, QuitsFiveHundredTimesWhileLoading) {
    const PayloadWorld world = manyNodes(3);
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
