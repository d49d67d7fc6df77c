#include "load/chunk_order.h"

#include <gtest/gtest.h>

namespace fb::test {
namespace {

void adopt(ChunkOrder& order, std::vector<Wish> wishes) {
    order.adopt(wishes);
}

TEST(ChunkOrder, ForgetsWhatWasDroppedAndIsWishedForAgain) {
    ChunkOrder order;
    adopt(order, {{7, 1.0}});
    order.choose().filledBytes = 100;
    EXPECT_TRUE(order.isStarted(7));
    adopt(order, {{8, 1.0}});
    EXPECT_FALSE(order.isStarted(7));
    adopt(order, {{7, 1.0}});
    EXPECT_FALSE(order.isStarted(7)) << "its bytes are gone";
    EXPECT_EQ(order.choose().filledBytes, 0u);
    EXPECT_EQ(order.counters().cancelled, 1u);
    EXPECT_EQ(order.counters().wastedBytes, 100u);
}

TEST(ChunkOrder, ReleasesAStartedLoadWithItsBytes) {
    ChunkOrder order;
    adopt(order, {{7, 2.0}, {8, 1.0}});
    order.choose().bytes = {1, 2, 3};
    const StartedLoad load = order.release(7);
    EXPECT_EQ(load.bytes, (std::vector<std::uint8_t>{1, 2, 3}));
    EXPECT_FALSE(order.isStarted(7));
    ASSERT_TRUE(order.hasWork());
    EXPECT_EQ(order.choose().node, 8u);
    static_cast<void>(order.release(8));
    EXPECT_FALSE(order.hasWork());
}

}  // namespace
}  // namespace fb::test
