// Blocks wait until their memory fits; estimates follow the counts.
#include "build/memory_gate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "base/random.h"
#include "build/block_memory.h"

namespace fb {
namespace {

TEST(MemoryGate, NeverHoldsMoreThanItsLimit) {
    constexpr std::uint64_t kLimit = 100;
    MemoryGate gate(kLimit);
    std::atomic<std::uint64_t> inside = 0;
    std::atomic<int> overfull = 0, done = 0;
    std::vector<std::thread> threads;
    for (std::uint64_t t = 0; t < 6; ++t) {
        threads.emplace_back([&, t] {
            Random random(t);
            for (int i = 0; i < 200; ++i) {
                const std::uint64_t bytes = 1 + random.index(kLimit);
                const MemoryGate::Pass pass = gate.enter(bytes);
                if (inside.fetch_add(bytes) + bytes > kLimit) ++overfull;
                if (random.uniform() < 0.2) std::this_thread::yield();
                inside -= bytes;
                ++done;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(done, 1200);
    EXPECT_EQ(overfull, 0);
    EXPECT_LE(gate.peakBytes(), kLimit);
    EXPECT_GT(gate.peakBytes(), kLimit / 2);
}

TEST(MemoryGate, LetsInWhatIsLargerThanTheLimitOnceItIsEmpty) {
    MemoryGate gate(10);
    std::atomic<bool> entered = false;
    std::thread large;
    {
        const MemoryGate::Pass small = gate.enter(4);
        large = std::thread([&] {
            const MemoryGate::Pass pass = gate.enter(50);
            entered = true;
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_FALSE(entered);
    }
    large.join();
    EXPECT_TRUE(entered);
    EXPECT_EQ(gate.peakBytes(), 50u);
}

TEST(MemoryGate, HasNoLimitAtZero) {
    MemoryGate gate(0);
    const MemoryGate::Pass a = gate.enter(~std::uint64_t{0} / 4), b = gate.enter(~std::uint64_t{0} / 4);
    EXPECT_EQ(gate.peakBytes(), ~std::uint64_t{0} / 4 * 2);
}

TEST(EstimateBlockBytes, CountsTrianglesAndTheTexelsThatTheyShow) {
    SourceBlock block;
    block.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    block.mesh.triangles = {{0, 1, 2}};
    TextureStore store(1 << 20);
    EXPECT_EQ(estimateBlockBytes(block, store), kBytesPerTriangle);
    auto image = std::make_shared<Image>();
    image->width = image->height = 64, image->channels = 3;
    image->pixels.resize(64 * 64 * 3);
    block.textures.push_back({"t", {}, {}, image});
    block.textures.push_back({"not shown", {}, {}, image});
    block.materials.push_back({"m", glm::vec4(1.0f), 0, false});
    block.mesh.materials = {0};
    block.mesh.uvs = {{0, 0}, {0.5, 0}, {0, 1}};  // a quarter of the picture
    EXPECT_EQ(estimateBlockBytes(block, store), kBytesPerTriangle + 64 * 64 / 4 * kBytesPerTexel);
    block.mesh.uvs = {{0, 0}, {10, 0}, {0, 10}};  // repeated: all of it, once
    EXPECT_EQ(estimateBlockBytes(block, store), kBytesPerTriangle + 64 * 64 * kBytesPerTexel);
}

}  // namespace
}  // namespace fb
