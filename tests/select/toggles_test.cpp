// Switches and ping-pongs (thesis 6.5): one a group, none for what came into or went out of view. The naive
// policy switches at once, so the share time steers it: the group of this world needs 2 ms.
#include <gtest/gtest.h>

#include "worlds/tiny_walk.h"

namespace fb {
namespace {

View viewBackward() {
    return makeView(lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), glm::dvec3(0.0), 100, 100);
}

//      0
//     / \        needs 2 ms
//    1   2
TinyWalk pair() {
    return {{{.children = {{}, {}}}}, PolicyId::lakhiaNaive};
}

struct Toggles {
    std::uint32_t up, down, pingPongs;
    bool operator==(const Toggles&) const = default;
};

Toggles stepAt(TinyWalk& walk, double shareMs) {
    walk.shareMs = shareMs;
    walk.step();
    return {walk.counters().togglesUp, walk.counters().togglesDown, walk.counters().pingPongs};
}
constexpr double kFine = 3.0, kCoarse = 1.0;

TEST(Toggles, AreCountedOncePerGroupWhateverItsSize) {
    TinyWalk walk = pair();
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 0, 0}));
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{1, 0, 0}));
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
}

TEST(Toggles, TheFirstFrameHasNone) {
    TinyWalk walk = pair();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
}

TEST(Toggles, ASwitchBackWithin35FramesIsAPingPong) {
    TinyWalk walk = pair();
    stepAt(walk, kCoarse);
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{1, 0, 0}));
    for (int i = 0; i < 34; ++i) stepAt(walk, kFine);
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 1, 1}));  // 35 frames after it went up
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{1, 0, 1}));    // and up again
    for (int i = 0; i < 35; ++i) stepAt(walk, kFine);
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 1, 0}));  // 36 frames later
}

TEST(Toggles, WhatWasOutOfViewMeanwhileDoesNotCount) {
    TinyWalk walk = pair();
    stepAt(walk, kCoarse);
    walk.view = viewBackward();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
    walk.view = tinyView();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
    EXPECT_EQ(walk.selection.front.size(), 2u);
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 1, 0}));
}

TEST(Toggles, ALostPingPongIsNotMadeUpByGoingOutOfView) {
    TinyWalk walk = pair();
    stepAt(walk, kCoarse);
    stepAt(walk, kFine);  // up
    walk.view = viewBackward();
    stepAt(walk, kFine);
    walk.view = tinyView();
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 0, 0}));
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{1, 0, 0})) << "up after up is no ping-pong";
}

//      0         0 is in view always, its children only when the camera looks ahead
//     / \        .
//    1   2
TinyWalk standIn() {
    return {{{.box = boxOf({-1, -1, -2}, {1, 1, 2}), .children = {{}, {}}}}, PolicyId::lakhiaNaive};
}

TEST(Toggles, AParentDrawnForUnseenChildrenIsNoSwitch) {
    TinyWalk walk = standIn();
    stepAt(walk, kFine);
    walk.view = viewBackward();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{0}));
    EXPECT_EQ(walk.boundBy(0), BoundBy::view);
    walk.view = tinyView();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{1, 2}));
}

TEST(Toggles, ASwitchAcrossUnseenFramesCountsWhenItShows) {
    TinyWalk walk = standIn();
    stepAt(walk, kFine);
    walk.view = viewBackward();
    stepAt(walk, kFine);
    walk.view = tinyView();
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 1, 0}));
}

TEST(Toggles, ANodeThatCameIntoViewAheadOfItsChildrenDoesNotSwitchWhenTheyFollow) {
    TinyWalk walk = standIn();
    walk.view = viewBackward();
    stepAt(walk, kFine);  // 0 is new, its children are out of view
    stepAt(walk, kFine);
    walk.view = tinyView();
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 0, 0}));
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{1, 2}));
    EXPECT_EQ(stepAt(walk, kCoarse), (Toggles{0, 1, 0})) << "from here on it is an ordinary group";
}

//      0
//      |         1 needs 2 ms of 0's slice, 2 needs 4 ms of 1's
//      1
//      |
//      2
TEST(Toggles, AFallOverTwoLevelsIsOneSwitch) {
    TinyWalk walk({{.children = {{.cost = 2, .children = {{.cost = 4}}}}}}, PolicyId::lakhiaNaive);
    stepAt(walk, 5);
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{2}));
    EXPECT_EQ(stepAt(walk, 1), (Toggles{0, 1, 0}));
    EXPECT_EQ(walk.selection.front, (std::vector<NodeId>{0}));
    EXPECT_EQ(stepAt(walk, 5), (Toggles{1, 0, 1}));
}

TEST(Toggles, SeveralGroupsCountEach) {
    TinyWalk walk({{.children = {{}, {}}}, {.children = {{}, {}}}}, PolicyId::lakhiaNaive);
    stepAt(walk, 2 * kCoarse);
    EXPECT_EQ(stepAt(walk, 2 * kFine), (Toggles{2, 0, 0}));
    EXPECT_EQ(stepAt(walk, 2 * kCoarse), (Toggles{0, 2, 2}));
}

TEST(Toggles, AChangeOfPolicySwitchesWhatItChanges) {
    TinyWalk walk = pair();
    stepAt(walk, kFine);
    walk.settings.policy = PolicyId::coarse;
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{0, 1, 0}));
    walk.settings.policy = PolicyId::full;
    EXPECT_EQ(stepAt(walk, kFine), (Toggles{1, 0, 1}));
}

// --- the hash of the front: SplitMix64's finaliser, a round a node, recomputed here from its definition. ---
std::uint64_t finaliser(std::uint64_t z) {
    z ^= z >> 30;
    z *= 0xbf58476d1ce4e5b9ull;
    z ^= z >> 27;
    z *= 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

TEST(FrontHash, IsTheChainThatItsDefinitionGives) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ull;
    EXPECT_EQ(chainFrontHash(0, {}), golden);
    const NodeId two[] = {5, 9};
    const std::uint64_t first = finaliser((7 ^ (3 * golden)) ^ (5 + golden));
    EXPECT_EQ(chainFrontHash(7, two), finaliser(first ^ (9 + golden)));
}

TEST(FrontHash, KnowsOrderLengthAndHistory) {
    const NodeId ab[] = {1, 2}, ba[] = {2, 1}, a[] = {1};
    EXPECT_NE(chainFrontHash(0, ab), chainFrontHash(0, ba));
    EXPECT_NE(chainFrontHash(0, ab), chainFrontHash(0, a));
    EXPECT_NE(chainFrontHash(0, ab), chainFrontHash(1, ab));
    EXPECT_NE(chainFrontHash(chainFrontHash(0, a), {}), chainFrontHash(0, a))
        << "an empty front is a frame too";
}

}  // namespace
}  // namespace fb
