#include <gtest/gtest.h>

#include <fstream>

#include "base/random.h"
#include "disk_scene.h"
#include "worlds/scratch_folder.h"

namespace fb::test {
namespace {

// Overwrites one byte of a node's payload on disk with its complement.
void damage(const Scene& scene, NodeId node) {
    const PayloadRef& payload = scene.hierarchy.payload[node];
    const auto at = static_cast<std::streamoff>(payload.offset + payload.sizeBytes / 2);
    std::fstream file(scene.packs[payload.pack].path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char byte = static_cast<char>(~file.get());
    file.seekp(at);
    file.put(byte);
}

TEST(LoadRoots, LoadsEveryRootAndNothingElse) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 3);
    StoringDevice device;
    Residency residency;
    residency.reset(scene.hierarchy);
    ASSERT_TRUE(loadRoots(scene, device, residency, true).has_value());
    EXPECT_EQ(residency.resident, (Nodes{0, 1, 2}));
    EXPECT_EQ(device.stored().size(), 3u);
    EXPECT_EQ(device.stored().at(2).indices.size(), 30u);
    EXPECT_EQ(device.bytes(), residency.residentBytes);
    EXPECT_EQ(residency.residentBytes, 3u * (12 * 24 + 30 * 4));
}

TEST(LoadRoots, NamesTheRootThatCannotBeLoadedAndLeavesNothingBehind) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 3);
    damage(scene, 1);
    StoringDevice device;
    Residency residency;
    residency.reset(scene.hierarchy);
    const Result<void> loaded = loadRoots(scene, device, residency, true);
    ASSERT_FALSE(loaded.has_value());
    EXPECT_NE(loaded.error().oneLine().find("node 1"), std::string::npos) << loaded.error().oneLine();
    EXPECT_NE(loaded.error().oneLine().find("checksum"), std::string::npos);
    EXPECT_TRUE(device.stored().empty());
    EXPECT_EQ(residency.totalBytes(), 0u);
    EXPECT_TRUE(residency.resident.empty());
}

TEST(LoadRoots, ReadsNothingWhenContentIsNotNeeded) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 3);
    damage(scene, 1);
    StoringDevice device;
    Residency residency;
    residency.reset(scene.hierarchy);
    EXPECT_TRUE(loadRoots(scene, device, residency, false).has_value());
    EXPECT_EQ(residency.resident.size(), 3u);
    EXPECT_EQ(device.bytes(), 0u);
}

TEST(LoadingScenes, BringsEveryNodeFromDiskToTheDevice) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 2);
    StoringDevice device;
    const std::unique_ptr<Loader> loader = startLoaderThread(scene);
    Walk walk(scene, *loader, device);
    ASSERT_TRUE(loadRoots(scene, device, walk.residency, true).has_value());
    ASSERT_TRUE(walk.untilLoaded());
    EXPECT_TRUE(walk.faults.empty());
    ASSERT_EQ(device.stored().size(), 2u * kNodesPerBlock);
    for (const auto& [node, content] : device.stored()) {
        EXPECT_EQ(content.indices.size() / 3, scene.hierarchy.triangles(node));
        EXPECT_EQ(content.sizeBytes(), scene.hierarchy.residentBytes[node]);
    }
    EXPECT_EQ(walk.residency.counters.requested, 2u * kNodesPerBlock - 2);
    EXPECT_EQ(walk.residency.counters.completed, 2u * kNodesPerBlock - 2);
    std::uint64_t payloads = 0;
    for (NodeId n = 2; n < scene.hierarchy.size(); ++n) payloads += scene.hierarchy.payload[n].sizeBytes;
    EXPECT_EQ(walk.residency.counters.bytes, payloads);
}

TEST(LoadingScenes, TheSimulatedDiskDeliversTheSameContent) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 2);
    StoringDevice device;
    const std::unique_ptr<Loader> loader = makeModelLoader(scene, {}, true);
    Walk walk(scene, *loader, device);
    ASSERT_TRUE(loadRoots(scene, device, walk.residency, true).has_value());
    ASSERT_TRUE(walk.untilLoaded());
    ASSERT_EQ(device.stored().size(), 2u * kNodesPerBlock);
    ScenePacks packs(scene);
    for (const auto& [node, content] : device.stored()) {
        EXPECT_EQ(content.indices.size() / 3, scene.hierarchy.triangles(node));
    }
}

TEST(LoadingScenes, DrawsTheParentWhereANodeIsDamaged) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 1);
    damage(scene, 2);  // one of the four children of the root
    for (const bool onThread : {true, false}) {
        StoringDevice device;
        const std::unique_ptr<Loader> loader =
            onThread ? startLoaderThread(scene) : makeModelLoader(scene, {}, true);
        Walk walk(scene, *loader, device);
        ASSERT_TRUE(loadRoots(scene, device, walk.residency, true).has_value());
        ASSERT_TRUE(walk.untilLoaded());
        EXPECT_EQ(walk.residency.state[2], NodeState::failed);
        EXPECT_EQ(walk.residency.loaded[0], 1);
        EXPECT_EQ(walk.faults.size(), 4u);
        EXPECT_EQ(walk.residency.counters.faults, (Faults{0, 4, 0}));
        EXPECT_EQ(walk.residency.counters.givenUp, 1u);
        for (NodeId n = 5; n < kNodesPerBlock; ++n) EXPECT_EQ(walk.residency.loaded[n], 0);
    }
}

TEST(LoadingScenes, OutlivesAPackThatIsCutOffDuringTheWalk) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 2);
    StoringDevice device;
    const std::unique_ptr<Loader> loader = startLoaderThread(scene);
    Walk walk(scene, *loader, device);
    ASSERT_TRUE(loadRoots(scene, device, walk.residency, true).has_value());
    std::filesystem::resize_file(scene.packs[0].path(), 100);
    ASSERT_TRUE(walk.untilLoaded());
    for (NodeId n = 0; n < scene.hierarchy.size(); ++n) {
        const bool there = scene.hierarchy.block[n] == 1 || n == 0;
        EXPECT_EQ(walk.residency.loaded[n], there ? 1 : 0) << n;
    }
    EXPECT_EQ(walk.residency.counters.failed, walk.faults.size());
    EXPECT_GE(walk.faults.size(), 4u);
    EXPECT_EQ(walk.residency.counters.faults, (Faults{walk.faults.size(), 0, 0}));
}

TEST(LoadingScenes, KeepsTheBudgetInEveryFrameOfAWalkWithTheThread) {
    const ScratchFolder folder;
    const Scene scene = writeDiskScene(folder / "s.fbscene", 3);
    std::uint64_t allBytes = 0, rootBytes = 0;
    for (NodeId n = 0; n < scene.hierarchy.size(); ++n) {
        allBytes += scene.hierarchy.residentBytes[n];
        if (n < 3) rootBytes += scene.hierarchy.residentBytes[n];
    }
    StoringDevice device;
    const std::unique_ptr<Loader> loader = startLoaderThread(scene);
    Walk walk(scene, *loader, device);
    walk.load = chunksOf(64);
    ASSERT_TRUE(loadRoots(scene, device, walk.residency, true).has_value());
    Random random(5);
    for (int frame = 0; frame < 300; ++frame) {
        if (frame % 10 == 0) {
            const double bytes =
                static_cast<double>(rootBytes) + random.uniform() * static_cast<double>(allBytes - rootBytes);
            walk.load.budgetMiB = std::ceil(bytes) / 1048576.0;
            walk.load.frozen = random.index(5) == 0;
        }
        walk.frame();
        ASSERT_LE(walk.residency.totalBytes(), budgetBytes(walk.load));
        ASSERT_EQ(device.bytes(), walk.residency.residentBytes);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    EXPECT_GT(walk.residency.counters.completed, 0u);
    EXPECT_GT(walk.residency.counters.evicted, 0u);
    walk.load = {};
    ASSERT_TRUE(walk.untilLoaded());
    EXPECT_EQ(device.stored().size(), 3u * kNodesPerBlock);
    EXPECT_TRUE(walk.faults.empty());
}

// The n-th read fails once, for every n there is: one node fails for the time being, then all is loaded.
TEST(LoadingScenes, RecoversFromAFailureOfAnySingleRead) {
    const PayloadWorld world({{kRoot, 2, 0}, {0, 2, 0}, {0, 2, 0}, {1, 1, 0}}, {3, 40, 50, 60});
    std::size_t number = 0;
    for (bool failedOnce = true; failedOnce; ++number) {
        Disk disk;
        disk.failRead(number);
        const std::unique_ptr<Loader> loader = startLoader(world, disk);
        NullDevice device;
        Walk walk(world.scene, *loader, device);
        walk.load = chunksOf(100);
        walk.residency.setResident(world.scene.hierarchy, 0);
        ASSERT_TRUE(walk.untilLoaded()) << number;
        failedOnce = walk.residency.counters.failed == 1;
        EXPECT_EQ(walk.residency.resident.size(), 4u);
        EXPECT_EQ(walk.faults.size(), failedOnce ? 1u : 0u);
        EXPECT_EQ(walk.residency.counters.requested, failedOnce ? 4u : 3u);
    }
    std::size_t chunks = 0;
    for (NodeId n = 1; n < 4; ++n) chunks += (world.payloadBytes(n) + 99) / 100;
    EXPECT_EQ(number, chunks + 1) << "every read of an undisturbed run has failed once";
}

}  // namespace
}  // namespace fb::test
