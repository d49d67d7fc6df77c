// What must hold for every policy whatever the world, the camera, the residency, the times and the knobs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "worlds/random_worlds.h"
#include "worlds/tiny_walk.h"

namespace fb {
namespace {

// From nothing to absurd: 0, or ten to a power between -9 and 6.
double anyTime(Random& r) {
    return r.index(10) == 0 ? 0.0 : std::pow(10.0, r.uniform(-9.0, 6.0));
}

struct Trial {
    TinyWalk walk;
    Random random;

    explicit Trial(std::uint64_t seed) : walk(start(seed)), random(seed + 1) { turn(); }

    static TinyWalk start(std::uint64_t seed) {
        Random r(seed);
        Hierarchy world = randomWorld(r);
        Settings settings;
        randomiseGroup(r, settings, "select");
        return {std::move(world), settings.select};
    }
    void turn() {
        const glm::dvec3 eye = randomPoint(random, 25.0), target = randomPoint(random, 15.0);
        Camera camera = lookAt(eye, target, glm::dvec3(0, 1, 0));
        camera.fovyRadians = random.uniform(0.2, 2.6);
        const glm::dvec3 velocity = randomPoint(random, 50.0);
        walk.view = makeView(camera, velocity, 160, 90);
    }
    void nextFrame() {
        if (random.index(4) == 0) turn();
        if (random.index(10) == 0) walk.settings.policy = policies()[random.index(policies().size())].id;
        for (bool& on : walk.effects.on) on = random.index(2) == 0;
        for (NodeId n = walk.hierarchy.rootCount; n < walk.hierarchy.size(); ++n) {
            walk.loaded[n] = random.index(5) != 0 ? 1 : 0;
            walk.refused[n] = random.index(2) == 0 ? 1 : 0;
        }
        walk.vTimeMs = anyTime(random);
        walk.shareMs = anyTime(random) - anyTime(random);
        walk.targetMs = anyTime(random);
        walk.overheadMs = anyTime(random);
        walk.slowRatio = random.uniform(1.0 / 8.0, 8.0);
        walk.residualMs = anyTime(random);
        walk.textureMsPerByte = random.index(2) == 0 ? 0.0 : anyTime(random);
        walk.measured = {random.index(2) == 0 ? 0 : random.index(100000), anyTime(random)};
        walk.dtSeconds = random.uniform(0.0, 0.1);
        walk.step();
    }
};

// How many nodes of the front lie on each root-to-leaf path of which every node is in view.
void checkPaths(const TinyWalk& walk, const std::set<NodeId>& front, NodeId n, int above) {
    if (!meetsView(walk.view, walk.hierarchy.bounds[n])) return;
    const int covered = above + static_cast<int>(front.count(n));
    RC_ASSERT(covered <= 1);
    if (walk.hierarchy.isLeaf(n)) RC_ASSERT(covered == 1);
    for (std::uint32_t i = 0; i < walk.hierarchy.childCount[n]; ++i) {
        checkPaths(walk, front, walk.hierarchy.firstChild[n] + i, covered);
    }
}

void checkFront(const TinyWalk& walk) {
    const Selection& s = walk.selection;
    const std::set<NodeId> front(s.front.begin(), s.front.end());
    RC_ASSERT(front.size() == s.front.size());
    // One policy may leave roots out, with all that is below them.
    std::set<NodeId> reached;
    for (const Reached& r : s.reached) reached.insert(r.node);
    std::uint32_t skipped = 0;
    for (NodeId root = 0; root < walk.hierarchy.rootCount; ++root) {
        if (reached.contains(root)) {
            checkPaths(walk, front, root, 0);
        } else if (meetsView(walk.view, walk.hierarchy.bounds[root])) {
            ++skipped;
        }
    }
    RC_ASSERT(s.counters.skippedRoots == skipped);
    if (walk.settings.policy != PolicyId::funkhouser) RC_ASSERT(skipped == 0u);
    RC_ASSERT(std::isfinite(s.estimateMs));
    for (const Reached& r : s.reached) RC_ASSERT((std::isfinite(r.needMs) && std::isfinite(r.hadMs)));
    double cost = 0.0;
    std::uint64_t triangles = 0, bound = 0;
    for (NodeId n : s.front) {
        RC_ASSERT(n < walk.hierarchy.rootCount || walk.loaded[n] != 0);
        for (NodeId up = n; up != kNoNode; up = walk.hierarchy.parent[up]) {
            RC_ASSERT(meetsView(walk.view, walk.hierarchy.bounds[up]));
        }
        cost += nodeCost(walk.hierarchy, n, walk.settings.cTextured);
        triangles += walk.hierarchy.triangles(n);
    }
    for (std::uint32_t count : s.counters.boundBy) bound += count;
    RC_ASSERT(std::abs(s.frontCost - cost) <= 1e-9 * cost);
    RC_ASSERT(s.triangles == triangles);
    RC_ASSERT(bound == s.front.size());
    // Two of them look at what they reach twice.
    RC_ASSERT(s.counters.visited <= 2 * walk.hierarchy.size() + walk.hierarchy.rootCount);
}

void checkNumbers(const TinyWalk& walk) {
    for (double h : walk.state.hysteresis) RC_ASSERT(std::abs(h) <= walk.settings.hystLimit);
    RC_ASSERT(walk.counters().repairedCounters == 0u);
    if (!policyOf(walk.settings.policy).usesShareTime) return;
    // The queue of this frame: a slice for each reached node.
    for (double slice : walk.state.shares) {
        RC_ASSERT(std::isfinite(slice));
        RC_ASSERT(slice >= 0.0);
    }
}

double sumOfSlices(const TinyWalk& walk, NodeId parent) {
    double sum = 0.0;
    for (std::size_t i = 0; i < walk.state.queue.size(); ++i) {
        if (walk.hierarchy.parent[walk.state.queue[i]] == parent) sum += walk.state.shares[i];
    }
    return sum;
}

RC_GTEST_PROP(EveryPolicy, DrawsAFrontOfLoadedNodesInView, ()) {
    Trial trial(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 15; ++i) {
        trial.nextFrame();
        checkFront(trial.walk);
    }
}

RC_GTEST_PROP(EveryPolicy, KeepsCountersAndSlicesFiniteAndInRange, ()) {
    Trial trial(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 15; ++i) {
        trial.nextFrame();
        checkNumbers(trial.walk);
    }
}

RC_GTEST_PROP(TimeSlices, OfAGroupAddUpToWhatItShares, ()) {
    Trial trial(*rc::gen::arbitrary<std::uint64_t>());
    trial.walk.settings.policy = trial.random.index(2) == 0 ? PolicyId::lakhia : PolicyId::lakhiaNaive;
    for (int i = 0; i < 15; ++i) {
        const PolicyId policy = trial.walk.settings.policy;
        trial.nextFrame();
        trial.walk.settings.policy = policy;
        trial.walk.step();
        const TinyWalk& walk = trial.walk;
        if (walk.selection.reached.empty()) continue;
        const double rootShare = std::max(walk.shareMs, 0.05 * walk.targetMs);
        RC_ASSERT(std::abs(sumOfSlices(walk, kNoNode) - rootShare) <= 1e-9 * rootShare);
        for (std::size_t q = 0; q < walk.state.queue.size(); ++q) {
            if (!walk.selection.reached[q].expanded) continue;
            const double share = walk.state.shares[q];
            RC_ASSERT(std::abs(sumOfSlices(walk, walk.state.queue[q]) - share) <= 1e-9 * share);
        }
    }
}

RC_GTEST_PROP(EveryPolicy, GivesTheSameFrontsForTheSameInput, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    Trial a(seed), b(seed);
    b.walk.state.queue.assign(50, 3);  // what scratch memory holds must not matter
    b.walk.state.group.assign(7, 1);
    b.walk.state.priorities.assign(9, -1.0);
    b.walk.state.slices.assign(9, -1.0);
    b.walk.state.marks.assign(9, 2);
    b.walk.state.heap.assign(9, 7);
    b.walk.state.heapDown.assign(9, 7);
    b.walk.state.tree.nodes.resize(9);
    std::uint64_t hashA = 0, hashB = 0;
    for (int i = 0; i < 15; ++i) {
        a.nextFrame();
        b.nextFrame();
        hashA = chainFrontHash(hashA, a.walk.selection.front);
        hashB = chainFrontHash(hashB, b.walk.selection.front);
    }
    RC_ASSERT(hashA == hashB);
}

RC_GTEST_PROP(RandomWorld, IsAHierarchyThatTheProgramBelieves, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    const Result<void> checked = checkHierarchy(randomWorld(r));
    RC_ASSERT(checked.has_value());
}

TEST(TinyWorld, IsLaidOutBreadthFirstWithParentsThatContainTheirChildren) {
    const Hierarchy h = makeWorld({{.children = {{.children = {{}}}, {}}}, {.children = {{.box = aside()}}}});
    ASSERT_TRUE(checkHierarchy(h)) << checkHierarchy(h).error().oneLine();
    EXPECT_EQ(h.rootCount, 2u);
    EXPECT_EQ(h.parent, (std::vector<NodeId>{kNoNode, kNoNode, 0, 0, 1, 2}));
    EXPECT_EQ(h.firstChild, (std::vector<NodeId>{2, 4, 5, kNoNode, kNoNode, kNoNode}));
    EXPECT_EQ(h.level, (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 2}));
    EXPECT_TRUE(h.bounds[1].contains(h.bounds[4]));
    EXPECT_EQ(nodeCost(h, 0, 0.5), 1.0);
}

}  // namespace
}  // namespace fb
