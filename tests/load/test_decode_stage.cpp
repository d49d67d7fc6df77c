#include "load/decode_stage.h"

#include <gtest/gtest.h>

#include "load/finished_queue.h"

namespace fb::test {
namespace {

StartedLoad loadOf(NodeId node) {
    return {node, 3, {1, 2, 3}, {}};
}

TEST(DecodeStage, HandsOutTheOldestFirstAndHasRoomForAFewMoreThanThereAreDecoders) {
    DecodeStage stage;
    for (NodeId n = 1; n <= 3; ++n) {
        EXPECT_TRUE(stage.hasRoom(1)) << n;
        stage.push(loadOf(n), 100 * n);
    }
    EXPECT_FALSE(stage.hasRoom(1));
    EXPECT_TRUE(stage.hasRoom(2));
    EXPECT_EQ(stage.residentBytes(), 600u);
    for (NodeId n = 1; n <= 3; ++n) {
        const DecodeStage::Next next = stage.start();
        EXPECT_EQ(next.load.node, n);
        EXPECT_TRUE(next.wanted);
        EXPECT_EQ(next.load.bytes.size(), 3u);
    }
    EXPECT_FALSE(stage.hasWaiting());
    EXPECT_EQ(stage.size(), 3u) << "in the hands of decoders";
    EXPECT_TRUE(stage.finish(2));
    EXPECT_EQ(stage.residentBytes(), 400u);
    EXPECT_TRUE(stage.finish(1));
    EXPECT_TRUE(stage.finish(3));
    EXPECT_EQ(stage.residentBytes(), 0u);
}

// 1 is finished, 2 being decoded, 3 waits; 1 and 3 are no longer wished for, later 3 is again.
TEST(DecodeStage, GivesUpWhatIsNoLongerWishedForUnlessItIsAgain) {
    FinishedQueue queue;
    DecodeStage stage;
    WishMarks marks(10);
    std::vector<FinishedQueue::Entry> dropped;
    queue.push({{1, nullptr, {}}, 10, 5});
    stage.push(loadOf(2), 10);
    stage.push(loadOf(3), 10);
    static_cast<void>(stage.start());

    std::vector<Wish> wishes = {{2, 2.0}, {4, 1.0}};
    marks.mark(wishes);
    marks.settle(queue, wishes, dropped, &stage);
    ASSERT_EQ(wishes.size(), 1u) << "2 is being decoded: nobody needs to read it";
    EXPECT_EQ(wishes[0].node, 4u);
    ASSERT_EQ(dropped.size(), 1u);
    EXPECT_EQ(dropped[0].load.node, 1u);

    wishes = {{3, 1.0}};
    marks.mark(wishes);
    marks.settle(queue, wishes, dropped, &stage);
    EXPECT_TRUE(wishes.empty()) << "3 waits still";
    EXPECT_FALSE(stage.finish(2)) << "given up while it was decoded";
    EXPECT_TRUE(stage.start().wanted);
    EXPECT_TRUE(stage.finish(3));

    stage.push(loadOf(5), 10);
    marks.mark({});
    marks.settle(queue, wishes, dropped, &stage);
    EXPECT_FALSE(stage.start().wanted);
    EXPECT_EQ(stage.size(), 0u) << "it has left without being decoded";
}

}  // namespace
}  // namespace fb::test
