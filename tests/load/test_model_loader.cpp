#include <gtest/gtest.h>

#include "tiny_world.h"

namespace fb::test {
namespace {

constexpr std::uint64_t kNoCap = ~std::uint64_t{0};

// 1 MB/s: a byte takes a microsecond. 5 ms before the first byte of a read from a new place. Chunks of 1000
// bytes. Nodes 1 (1000 bytes) and 2 (2000) stand one after the other in pack 0; 3 (3000) and 4 (500) in packs
// 1 and 2.
struct ModelWorld {
    Scene scene;
    LoadSettings settings;
    std::unique_ptr<Loader> loader;

    ModelWorld() {
        const std::vector<NodeSpec> specs = {{kRoot, 1, 1}, {0, 1, 10}, {0, 1, 20}, {0, 1, 30}, {0, 1, 40}};
        scene.hierarchy = makeHierarchy(specs);
        scene.hierarchy.payload = {
            {0, 0, 64, 0}, {0, 64, 1000, 0}, {0, 1064, 2000, 0}, {1, 64, 3000, 0}, {2, 64, 500, 0}};
        settings.chunkKiB = 1000.0 / 1024.0;
        ModelSettings model;
        model.diskMBps = 1.0;
        model.diskLatencyMs = 5.0;
        loader = makeModelLoader(scene, model, false);
    }
    void publish(std::initializer_list<Wish> wishes) {
        loader->publish(std::span<const Wish>(wishes.begin(), wishes.size()), settings);
    }
    // The node that is finished after `microseconds` more, kNoNode for none.
    NodeId after(std::int64_t microseconds) {
        loader->advance(static_cast<double>(microseconds) * 1e-6);
        FinishedLoad finished;
        if (!loader->take(finished, kNoCap)) return kNoNode;
        EXPECT_TRUE(finished.content.has_value());
        return finished.node;
    }
};

TEST(ModelLoader, TakesLatencyAndBytesOverBandwidth) {
    ModelWorld w;
    w.publish({{1, 1.0}});
    EXPECT_EQ(w.after(5999), kNoNode);
    EXPECT_EQ(w.after(1), 1u) << "5 ms + 1000 bytes";
}

TEST(ModelLoader, PaysNoLatencyForWhatFollowsOnDisk) {
    ModelWorld w;
    w.publish({{1, 2.0}, {2, 2.0}, {3, 1.0}});
    EXPECT_EQ(w.after(6000), 1u);
    EXPECT_EQ(w.after(1999), kNoNode);
    EXPECT_EQ(w.after(1), 2u) << "2000 bytes";
    EXPECT_EQ(w.after(7999), kNoNode);
    EXPECT_EQ(w.after(1), 3u) << "5 ms + 3000 bytes";
    EXPECT_EQ(w.loader->counters().seeks, 2u);
}

TEST(ModelLoader, PaysNoLatencyForThePaddingBetweenPayloads) {
    ModelWorld w;
    w.scene.hierarchy.payload[2].offset += 7;
    w.publish({{1, 2.0}, {2, 2.0}});
    EXPECT_EQ(w.after(6000), 1u);
    EXPECT_EQ(w.after(2000), 2u);
    EXPECT_EQ(w.loader->counters().seeks, 1u);
}

TEST(ModelLoader, PaysLatencyWhenItGoesBack) {
    ModelWorld w;
    w.publish({{2, 2.0}, {1, 1.0}});
    EXPECT_EQ(w.after(7000), 2u);
    EXPECT_EQ(w.after(5999), kNoNode);
    EXPECT_EQ(w.after(1), 1u);
}

TEST(ModelLoader, SuspendsBetweenChunksAndResumes) {
    ModelWorld w;
    w.publish({{3, 1.0}});
    EXPECT_EQ(w.after(5500), kNoNode);  // in the first chunk, which ends at 6 ms
    w.publish({{4, 2.0}, {3, 1.0}});
    EXPECT_EQ(w.after(5999), kNoNode);
    EXPECT_EQ(w.after(1), 4u) << "6 + 5 + 0.5 ms";
    EXPECT_EQ(w.after(6999), kNoNode);
    EXPECT_EQ(w.after(1), 3u) << "11.5 + 5 + 2 ms: the first 1000 bytes are kept";
    EXPECT_EQ(w.loader->counters().suspended, 1u);
    EXPECT_EQ(w.loader->counters().bytesRead, 3500u);
    EXPECT_EQ(w.loader->counters().wastedBytes, 0u);
}

TEST(ModelLoader, ReadsAChunkToItsEndWhenTheWishIsWithdrawn) {
    ModelWorld w;
    w.publish({{3, 1.0}});
    EXPECT_EQ(w.after(5500), kNoNode);
    w.publish({{4, 1.0}});
    EXPECT_EQ(w.after(5999), kNoNode);
    EXPECT_EQ(w.after(1), 4u) << "6 + 5 + 0.5 ms";
    EXPECT_EQ(w.loader->counters().cancelled, 1u);
    EXPECT_EQ(w.loader->counters().wastedBytes, 1000u);
    EXPECT_EQ(w.loader->counters().suspended, 0u);
}

TEST(ModelLoader, BeginsWhenTheWishComes) {
    ModelWorld w;
    EXPECT_EQ(w.after(20000), kNoNode);
    w.publish({{4, 1.0}});
    EXPECT_EQ(w.after(5499), kNoNode);
    EXPECT_EQ(w.after(1), 4u);
}

TEST(ModelLoader, DropsAFinishedLoadWhoseWishWasWithdrawn) {
    ModelWorld w;
    w.publish({{4, 1.0}});
    w.loader->advance(1.0);
    w.publish({{1, 1.0}});
    EXPECT_EQ(w.after(6000), 1u);
    EXPECT_EQ(w.loader->counters().cancelled, 1u);
    EXPECT_EQ(w.loader->counters().wastedBytes, 500u);
}

TEST(ModelLoader, ReadsAFinishedLoadOnceHoweverOftenItIsWishedFor) {
    ModelWorld w;
    for (int frame = 0; frame < 5; ++frame) {
        w.publish({{4, 2.0}, {3, 1.0}});
        w.loader->advance(0.02);
    }
    EXPECT_EQ(w.loader->counters().bytesRead, 3500u);
    FinishedLoad finished;
    ASSERT_TRUE(w.loader->take(finished, kNoCap));
    EXPECT_EQ(finished.node, 4u);
    w.publish({{3, 1.0}});
    ASSERT_TRUE(w.loader->take(finished, kNoCap));
    EXPECT_EQ(finished.node, 3u);
}

TEST(ModelLoader, HoldsBackALoadThatIsLargerThanTheCap) {
    ModelWorld w;
    w.publish({{4, 1.0}});
    w.loader->advance(1.0);
    FinishedLoad finished;
    EXPECT_FALSE(w.loader->take(finished, 39));
    EXPECT_TRUE(w.loader->take(finished, 40));
}

TEST(ModelLoader, DoesNotDependOnHowTimeIsCutUp) {
    // 1 and 2 at 6 and 8 ms, 3 at 16 ms, 4 at 21.5 ms.
    for (const std::int64_t step : {1, 7, 500, 3000, 30000}) {
        ModelWorld w;
        w.publish({{1, 4.0}, {2, 3.0}, {3, 2.0}, {4, 1.0}});
        std::vector<std::pair<NodeId, std::int64_t>> seen;
        FinishedLoad finished;
        for (std::int64_t now = step; now <= 30000; now += step) {
            w.loader->advance(static_cast<double>(step) * 1e-6);
            while (w.loader->take(finished, kNoCap)) seen.emplace_back(finished.node, now);
        }
        const std::int64_t exact[] = {6000, 8000, 16000, 21500};
        ASSERT_EQ(seen.size(), 4u) << step;
        for (NodeId n = 1; n <= 4; ++n) {
            EXPECT_EQ(seen[n - 1].first, n);
            EXPECT_EQ(seen[n - 1].second, (exact[n - 1] + step - 1) / step * step) << step;
        }
    }
}

TEST(ModelLoader, IgnoresTimeThatDoesNotGoOn) {
    ModelWorld w;
    w.publish({{4, 1.0}});
    for (const double odd :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        w.loader->advance(odd);
    }
    EXPECT_EQ(w.after(5499), kNoNode);
    EXPECT_EQ(w.after(1), 4u);
}

}  // namespace
}  // namespace fb::test
