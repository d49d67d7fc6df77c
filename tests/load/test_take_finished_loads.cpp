#include <gtest/gtest.h>

#include <deque>
#include <map>

#include "tiny_world.h"

namespace fb::test {
namespace {

constexpr std::uint32_t kMiB = 1u << 20;

struct ScriptedLoader final : Loader {
    const Hierarchy& hierarchy;
    std::deque<FinishedLoad> queue;

    explicit ScriptedLoader(const Hierarchy& h) : hierarchy(h) {}
    void finish(NodeId node) { queue.push_back({node, nullptr}); }
    void fail(NodeId node) { queue.push_back({node, failure("disk", {}, "EIO")}); }
    void publish(std::span<const Wish>, const LoadSettings&) override {}
    bool take(FinishedLoad& finished, std::uint64_t capBytes) override {
        if (queue.empty()) return false;
        if (queue.front().content && hierarchy.residentBytes[queue.front().node] > capBytes) return false;
        finished = std::move(queue.front());
        queue.pop_front();
        return true;
    }
    void advance(double) override {}
    LoaderCounters counters() const override { return {7, 0, 1234, 0}; }
    double nowSeconds() const override { return 2.5; }
};

struct LoggingDevice final : NodeDevice {
    Nodes uploads, releases;
    std::map<NodeId, int> refusals;  // uploads that fail before one succeeds

    Result<void> upload(NodeId node, const DecodedNode&) override {
        uploads.push_back(node);
        if (refusals[node]-- > 0) return failure("GPU", {}, "out of memory");
        return {};
    }
    void release(NodeId node) override { releases.push_back(node); }
};

//  0 - {1, 2, 3, 4} of 2 MiB each
struct TakeWorld : World {
    ScriptedLoader loader{hierarchy};
    LoggingDevice device;
    std::vector<std::string> faults;

    TakeWorld()
        : World({{kRoot, 1, 1}, {0, 1, 2 * kMiB}, {0, 1, 2 * kMiB}, {0, 1, 2 * kMiB}, {0, 1, 2 * kMiB}}) {
        setBudget(100 * kMiB);
        planFrame();
    }
    double limitMs = 0.0;
    std::uint64_t take() {
        const UploadInput input{hierarchy, load, nowSeconds,
                                [this](const Error& error) { faults.push_back(error.oneLine()); }, limitMs};
        return takeFinishedLoads(input, loader, device, residency);
    }
};

TEST(TakeFinishedLoads, StaysWithinTheUploadBudgetOfAFrame) {
    TakeWorld w;
    w.load.uploadMiBPerFrame = 5.0;
    for (NodeId n = 1; n <= 4; ++n) w.loader.finish(n);
    EXPECT_EQ(w.take(), 4u * kMiB);
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2}));
    EXPECT_EQ(w.take(), 4u * kMiB);
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1, 2, 3, 4}));
    EXPECT_EQ(w.take(), 0u);
    EXPECT_EQ(w.device.uploads, (Nodes{1, 2, 3, 4}));
    EXPECT_EQ(w.residency.counters.completed, 4u);
    EXPECT_EQ(w.residency.counters.suspended, 7u);
    EXPECT_EQ(w.residency.counters.bytes, 1234u);
}

TEST(TakeFinishedLoads, UploadsOneNodeAFrameHoweverLargeItIs) {
    TakeWorld w;
    w.load.uploadMiBPerFrame = 0.0625;
    w.loader.finish(1);
    w.loader.finish(2);
    EXPECT_EQ(w.take(), 2u * kMiB);
    EXPECT_EQ(w.loadedNodes(), (Nodes{0, 1}));
    EXPECT_EQ(w.take(), 2u * kMiB);
}

// No time at all is time for one.
TEST(TakeFinishedLoads, StaysWithinTheTimeOfAFrame) {
    TakeWorld w;
    w.limitMs = 1e-9;
    for (const NodeId node : {1u, 2u, 3u}) w.loader.finish(node);
    w.take();
    EXPECT_EQ(w.device.uploads, (Nodes{1}));
    w.take();
    EXPECT_EQ(w.device.uploads, (Nodes{1, 2}));
    w.limitMs = 0.0;
    w.loader.finish(4);
    w.take();
    EXPECT_EQ(w.device.uploads, (Nodes{1, 2, 3, 4}));
}

TEST(TakeFinishedLoads, DoesNotUploadWhatWasWithdrawnMeanwhile) {
    TakeWorld w;
    w.residency.setUnloaded(w.hierarchy, 1);
    w.loader.finish(1);
    EXPECT_EQ(w.take(), 0u);
    EXPECT_TRUE(w.device.uploads.empty());
    EXPECT_EQ(w.residency.state[1], NodeState::unloaded);
}

TEST(TakeFinishedLoads, RetriesALoadErrorThreeTimesThenGivesUp) {
    TakeWorld w;
    const double at[] = {0.0, 0.5, 1.5, 3.5};
    for (const double now : at) {
        w.nowSeconds = now;
        w.planFrame();
        ASSERT_EQ(w.residency.state[1], NodeState::wanted) << now;
        w.loader.fail(1);
        EXPECT_EQ(w.take(), 0u);
        w.planFrame();
        EXPECT_NE(w.residency.state[1], NodeState::wanted);
    }
    EXPECT_EQ(w.residency.state[1], NodeState::failed);
    EXPECT_EQ(w.faults, (std::vector<std::string>{
                            "disk: node 1: EIO (it will be tried again; its parent stays drawn)",
                            "disk: node 1: EIO (it will be tried again; its parent stays drawn)",
                            "disk: node 1: EIO (it will be tried again; its parent stays drawn)",
                            "disk: node 1: EIO (given up after 4 tries; its parent stays drawn)"}));
    EXPECT_EQ(w.residency.counters.failed, 4u);
    EXPECT_EQ(w.residency.counters.faults, (Faults{0, 4, 0}));
    EXPECT_EQ(w.residency.counters.retried, 3u);
    EXPECT_EQ(w.residency.counters.givenUp, 1u);
    EXPECT_EQ(w.residency.counters.cancelled, 3u) << "its siblings 2, 3 and 4";
    w.nowSeconds = 1e9;
    w.planFrame();
    EXPECT_TRUE(w.plan.wishes.empty());
}

TEST(TakeFinishedLoads, RetriesWhenTheDeviceHasNoMemory) {
    TakeWorld w;
    w.device.refusals[1] = 1;
    w.loader.finish(1);
    EXPECT_EQ(w.take(), 0u);
    EXPECT_EQ(w.residency.state[1], NodeState::failedTemporarily);
    EXPECT_EQ(w.residency.loaded[1], 0);
    EXPECT_EQ(w.residency.reservedBytes, 3u * 2 * kMiB);
    EXPECT_EQ(w.faults.size(), 1u);
    EXPECT_EQ(w.residency.counters.faults, (Faults{0, 0, 1}));
    w.nowSeconds = 0.5;
    w.planFrame();
    EXPECT_EQ(w.residency.counters.retried, 1u);
    w.loader.finish(1);
    EXPECT_EQ(w.take(), 2u * kMiB);
    EXPECT_EQ(w.residency.failures[1], 0);
    EXPECT_TRUE(w.device.releases.empty()) << "an upload that failed left nothing behind";
}

TEST(TakeFinishedLoads, CountsAFailedUploadAgainstTheTimeOfTheFrame) {
    TakeWorld w;
    w.load.uploadMiBPerFrame = 4.0;
    w.device.refusals[1] = 1;
    for (NodeId n = 1; n <= 4; ++n) w.loader.finish(n);
    EXPECT_EQ(w.take(), 2u * kMiB);
    EXPECT_EQ(w.device.uploads, (Nodes{1, 2}));
}

}  // namespace
}  // namespace fb::test
