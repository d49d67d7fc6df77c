// What is told of loads, told by hand; times are chosen so that each figure can be seen in them.
#include <gtest/gtest.h>

#include <cmath>

#include "load/load_timeline.h"
#include "tiny_world.h"

namespace fb::test {
namespace {

//  0 - {1, 2} - 1 has {3}
struct Told {
    Hierarchy hierarchy = makeHierarchy(
        std::vector<NodeSpec>{{kNoNode, 1, 1}, {0, 1, 100}, {0, 1, 200}, {1, 1, 400}});
    Residency residency;
    LoadTimeline timeline;

    Told() {
        residency.reset(hierarchy);
        residency.setResident(hierarchy, 0);
        timeline.start(hierarchy);
    }
    void plan(Nodes requested, Nodes withdrawn, Nodes evicted, double at) {
        LoadPlan plan;
        plan.requested = std::move(requested);
        plan.withdrawn = std::move(withdrawn);
        plan.evicted = std::move(evicted);
        for (const NodeId node : plan.evicted) residency.setUnloaded(hierarchy, node);
        timeline.notePlan(plan, at);
    }
    void upload(NodeId node, double at) {
        residency.setResident(hierarchy, node);
        timeline.noteUploaded({at - 0.3, at - 0.2, at - 0.1, 2}, node, at);
    }
    void drawRootFor(BoundBy reason, double at) {
        Selection selection;
        selection.reached = {{0, false, reason, 0, 0}};
        timeline.noteSelection(selection, residency, at);
    }
    void drawChildren(double at) {
        Selection selection;
        selection.reached = {{0, true, BoundBy::leaf, 0, 0}, {1, false, BoundBy::leaf, 0, 0}, {2, false, BoundBy::leaf, 0, 0}};
        timeline.noteSelection(selection, residency, at);
    }
};

TEST(LoadTimeline, KeepsTheTimesOfALoad) {
    Told t;
    t.plan({1, 2}, {}, {}, 1.0);
    t.drawRootFor(BoundBy::load, 1.5);
    t.upload(1, 2.0);
    t.upload(2, 2.0);
    t.drawChildren(3.0);
    t.drawChildren(4.0);
    t.plan({}, {}, {2}, 5.0);
    const std::vector<LoadRecord> loads = t.timeline.records();
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_EQ(loads[0].node, 1u);
    EXPECT_EQ(loads[0].bytes, 100u);
    EXPECT_EQ(loads[0].queuedAt, 1.0);
    EXPECT_EQ(loads[0].missedAt, 1.5);
    EXPECT_EQ(loads[0].firstReadAt, 1.7);
    EXPECT_EQ(loads[0].readAt, 1.8);
    EXPECT_EQ(loads[0].decodedAt, 1.9);
    EXPECT_EQ(loads[0].uploadedAt, 2.0);
    EXPECT_EQ(loads[0].firstDrawnAt, 3.0);
    EXPECT_EQ(loads[0].suspensions, 2u);
    EXPECT_EQ(loads[0].end, LoadEnd::none);
    EXPECT_TRUE(std::isnan(loads[0].endedAt));
    EXPECT_EQ(loads[1].end, LoadEnd::evicted);
    EXPECT_EQ(loads[1].endedAt, 5.0);
}

TEST(LoadTimeline, TellsLoadsInTimeFromLateOnes) {
    Told t;
    t.plan({1, 2}, {}, {}, 0.0);
    t.drawRootFor(BoundBy::time, 1.0);  // nobody misses them
    t.upload(1, 2.0);
    t.drawRootFor(BoundBy::load, 3.0);  // 2 is missed, 1 is there
    t.drawRootFor(BoundBy::load, 4.0);
    t.upload(2, 5.0);
    EXPECT_EQ(t.timeline.score().inTime, 0u) << "not drawn yet";
    t.drawChildren(6.0);
    EXPECT_EQ(t.timeline.score().inTime, 1u);
    EXPECT_EQ(t.timeline.score().late, 1u);
    EXPECT_EQ(t.timeline.score().lateSeconds, 2.0);
    EXPECT_EQ(t.timeline.score().absentNodeFrames, 2u);
}

// Missed, then looked away from: what comes in that time is in time for the next look.
TEST(LoadTimeline, ForgetsWhatIsNoLongerMissed) {
    Told t;
    t.plan({1, 2}, {}, {}, 0.0);
    t.drawRootFor(BoundBy::memory, 1.0);
    t.drawRootFor(BoundBy::time, 2.0);
    t.upload(1, 3.0);
    t.drawRootFor(BoundBy::load, 4.0);
    t.upload(2, 4.5);
    EXPECT_EQ(t.timeline.score().late, 1u);
    EXPECT_EQ(t.timeline.score().lateSeconds, 0.5) << "since it was missed again";
    EXPECT_EQ(t.timeline.score().absentNodeFrames, 3u);
}

TEST(LoadTimeline, CountsWasteAndReloads) {
    Told t;
    t.plan({1, 2}, {}, {}, 0.0);
    t.upload(1, 1.0);
    t.plan({}, {}, {1}, 2.0);  // 100 bytes that nobody saw
    t.plan({1}, {}, {}, 3.0);
    t.upload(1, 4.0);
    t.upload(2, 4.0);
    t.drawChildren(5.0);
    t.plan({}, {}, {1, 2}, 6.0);
    EXPECT_EQ(t.timeline.score().neverDrawn, 1u);
    EXPECT_EQ(t.timeline.score().wastedBytes, 100u);
    EXPECT_EQ(t.timeline.score().reloads, 1u);
    EXPECT_EQ(t.timeline.score().mostLoadsOfOne, 2u);
}

TEST(LoadTimeline, TellsCancelledFromFailedLoads) {
    Told t;
    t.plan({1, 2}, {}, {}, 0.0);
    t.plan({}, {2}, {}, 1.0);
    t.timeline.noteFailed({0.5, kNotYet, kNotYet, 0}, 1, 2.0);
    const std::vector<LoadRecord> loads = t.timeline.records();
    EXPECT_EQ(loads[0].end, LoadEnd::failed);
    EXPECT_EQ(loads[0].firstReadAt, 0.5);
    EXPECT_EQ(loads[0].endedAt, 2.0);
    EXPECT_EQ(loads[1].end, LoadEnd::cancelled);
    EXPECT_EQ(loads[1].endedAt, 1.0);
    EXPECT_EQ(t.timeline.score().wastedBytes, 100u);
}

// Older records make room; what they were about is still told apart.
TEST(LoadTimeline, KeepsTheLastLoadsOfMany) {
    Told t;
    for (std::size_t i = 0; i < LoadTimeline::kCapacity; ++i) {
        t.plan({1}, {}, {}, static_cast<double>(i));
        t.plan({}, {1}, {}, static_cast<double>(i));
    }
    t.plan({2}, {}, {}, 1e6);
    const std::vector<LoadRecord> loads = t.timeline.records();
    ASSERT_EQ(loads.size(), LoadTimeline::kCapacity);
    EXPECT_EQ(loads.front().queuedAt, 1.0);
    EXPECT_EQ(loads.back().node, 2u);
    for (std::size_t i = 0; i < LoadTimeline::kCapacity; ++i) t.plan({1}, {}, {}, 2e6);
    t.upload(2, 3e6);  // its record is gone
    t.drawChildren(4e6);
    EXPECT_EQ(t.timeline.score().inTime, 1u);
}

}  // namespace
}  // namespace fb::test
