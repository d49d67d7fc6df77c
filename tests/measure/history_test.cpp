#include "measure/history.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

FrameRecord numbered(std::uint64_t frame) {
    FrameRecord record;
    record.frame = frame;
    return record;
}

TEST(History, KeepsTheLastFramesFromOldestToNewest) {
    History history(3);
    for (std::uint64_t frame = 1; frame <= 5; ++frame) history.push(numbered(frame));
    ASSERT_EQ(history.size(), 3u);
    EXPECT_EQ(history[0].frame, 3u);
    EXPECT_EQ(history[1].frame, 4u);
    EXPECT_EQ(history[2].frame, 5u);
    EXPECT_EQ(history.newest().frame, 5u);
}

TEST(History, HoldsFewerFramesThanItsCapacityAtFirst) {
    History history(3);
    EXPECT_EQ(history.size(), 0u);
    history.push(numbered(7));
    ASSERT_EQ(history.size(), 1u);
    EXPECT_EQ(history[0].frame, 7u);
    history.clear();
    EXPECT_EQ(history.size(), 0u);
}

TEST(History, OfCapacityZeroKeepsOneFrame) {
    History history(0);
    history.push(numbered(1));
    history.push(numbered(2));
    ASSERT_EQ(history.size(), 1u);
    EXPECT_EQ(history.newest().frame, 2u);
}

}  // namespace
}  // namespace fb
