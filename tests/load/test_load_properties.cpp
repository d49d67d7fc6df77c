#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "load/load_timeline.h"
#include "random_world.h"
#include "select/gain.h"

namespace fb::test {
namespace {

// A walk through a random scene: the loader and the device fail now and then, the budget jumps, the camera
// jumps.
struct RandomWalk {
    Random random;
    Scene scene;
    std::uint64_t rootBytes = 0, allBytes = 0;
    std::unique_ptr<FlakyLoader> loader;
    FlakyDevice device;
    Residency residency;
    LoadPlan plan;
    LoadTimeline timeline;
    View view;
    SelectSettings select;
    LoadSettings load;
    ActiveEffects effects;
    std::vector<std::uint8_t> inFront;
    double nowSeconds = 0.0;

    RandomWalk(std::uint64_t seed, double faultRate)
        : random(seed), scene(randomScene(random)), device(seed + 1, faultRate) {
        ModelSettings model;
        model.diskMBps = random.uniform(0.1, 100.0);
        loader = std::make_unique<FlakyLoader>(makeModelLoader(scene, model, false), seed + 2, faultRate);
        for (bool& on : effects.on) on = random.index(2) == 0;
        select.needAllChildren = random.index(4) != 0;
        load.order = random.index(2) == 0 ? LoadOrder::priority : LoadOrder::gain;
        load.swapMargin = random.index(4) == 0 ? 1.0 : random.uniform();
        load.uploadMiBPerFrame = random.uniform(0.0625, 8.0);
        load.chunkKiB = random.uniform(4.0, 256.0);
        view = randomView(random);
        residency.reset(scene.hierarchy);
        for (NodeId n = 0; n < scene.hierarchy.size(); ++n) {
            allBytes += scene.hierarchy.residentBytes[n];
            if (n < scene.hierarchy.rootCount) rootBytes += scene.hierarchy.residentBytes[n];
        }
        for (NodeId n = 0; n < scene.hierarchy.rootCount; ++n) {
            residency.setResident(scene.hierarchy, n);
            device.stored.insert(n);
        }
        timeline.start(scene.hierarchy);
        changeBudget();
    }

    // From the roots alone to a little more than everything.
    void changeBudget() {
        const double bytes = static_cast<double>(rootBytes) +
                             random.uniform(0.0, 1.1) * static_cast<double>(allBytes - rootBytes);
        load.budgetMiB = std::ceil(bytes) / 1048576.0;
    }

    void chooseFront() {
        inFront.assign(scene.hierarchy.size(), 0);
        std::vector<NodeId> open;
        for (NodeId n = 0; n < scene.hierarchy.rootCount; ++n) open.push_back(n);
        while (!open.empty()) {
            const NodeId node = open.back();
            open.pop_back();
            const bool refine = !scene.hierarchy.isLeaf(node) && random.index(3) != 0 &&
                                residency.loadedChildren[node] == scene.hierarchy.childCount[node];
            if (!refine) inFront[node] = random.index(3) != 0;  // some are outside the view
            for (std::uint32_t i = 0; refine && i < scene.hierarchy.childCount[node]; ++i) {
                open.push_back(scene.hierarchy.firstChild[node] + i);
            }
        }
    }

    void frame(double seconds) {
        nowSeconds += seconds;
        loader->advance(seconds);
        takeFinishedLoads({scene.hierarchy, load, nowSeconds, nullptr, 0.0, &timeline}, *loader, device, residency);
        planLoads({scene.hierarchy, view, select, load, effects, inFront, nowSeconds}, residency, plan);
        for (const NodeId node : plan.evicted) device.release(node);
        timeline.notePlan(plan, loader->nowSeconds());
        loader->publish(plan.wishes, load);
    }

    // What is told of loads agrees with the books.
    void checkTimeline() const {
        std::uint64_t ends[4] = {}, uploads = 0;
        std::set<NodeId> open;
        for (const LoadRecord& told : timeline.records()) {
            double before = told.queuedAt;
            for (const double at : {told.firstReadAt, told.readAt, told.decodedAt, told.uploadedAt, told.firstDrawnAt, told.endedAt}) {
                if (std::isnan(at)) continue;
                RC_ASSERT(at >= before);
                before = at;
            }
            ++ends[static_cast<std::size_t>(told.end)];
            uploads += std::isnan(told.uploadedAt) ? 0 : 1;
            RC_ASSERT(std::isnan(told.endedAt) == (told.end == LoadEnd::none));
            if (told.end != LoadEnd::none) continue;
            RC_ASSERT(open.insert(told.node).second);
            RC_ASSERT(std::isnan(told.uploadedAt) == residency.isInFlight(told.node));
        }
        const LoadCounters& c = residency.counters;
        RC_ASSERT(timeline.records().size() == c.requested);
        RC_ASSERT(uploads == c.completed);
        RC_ASSERT(ends[static_cast<std::size_t>(LoadEnd::cancelled)] == c.cancelled);
        RC_ASSERT(ends[static_cast<std::size_t>(LoadEnd::failed)] == c.failed);
        RC_ASSERT(ends[static_cast<std::size_t>(LoadEnd::evicted)] == c.evicted);
    }

    void checkBooks() const {
        const Hierarchy& h = scene.hierarchy;
        RC_ASSERT(residency.totalBytes() <= budgetBytes(load));
        std::uint64_t resident = 0, reserved = 0, inFlight = 0;
        std::vector<std::uint32_t> children(h.size(), 0);
        for (NodeId n = 0; n < h.size(); ++n) {
            const bool isResident = residency.state[n] == NodeState::resident;
            RC_ASSERT((residency.loaded[n] == 1) == isResident);
            RC_ASSERT(device.stored.contains(n) == isResident);
            if (isResident) resident += h.residentBytes[n];
            if (residency.isInFlight(n)) {
                reserved += flightBytes(h, n);
                ++inFlight;
            }
            if (h.parent[n] == kNoNode) {
                RC_ASSERT(isResident);
            } else if (isResident || residency.isInFlight(n)) {
                RC_ASSERT(residency.loaded[h.parent[n]] == 1);
                if (isResident) ++children[h.parent[n]];
            }
        }
        RC_ASSERT(resident == residency.residentBytes);
        RC_ASSERT(reserved == residency.reservedBytes);
        RC_ASSERT(children == residency.loadedChildren);
        RC_ASSERT(residency.peakBytes >= residency.totalBytes());
        const LoadCounters& c = residency.counters;
        checkTimeline();
        RC_ASSERT(c.requested == c.completed + c.cancelled + c.failed + inFlight);
        RC_ASSERT(plan.wishes.size() == inFlight);
        std::set<NodeId> ended;  // parents whose children have all been listed
        for (std::size_t i = 0; i < plan.wishes.size(); ++i) {
            RC_ASSERT(residency.isInFlight(plan.wishes[i].node));
            if (i == 0) continue;
            RC_ASSERT(plan.wishes[i].priority <= plan.wishes[i - 1].priority);
            const NodeId before = h.parent[plan.wishes[i - 1].node], now = h.parent[plan.wishes[i].node];
            if (before == now) continue;
            ended.insert(before);
            RC_ASSERT(!ended.contains(now));
        }
    }
};

RC_GTEST_PROP(LoadProperties, TheBooksAreRightAndTheBudgetHoldsInEveryFrame, (std::uint64_t seed)) {
    RandomWalk walk(seed, 0.05);
    for (int frame = 0; frame < 120; ++frame) {
        if (walk.random.index(20) == 0) walk.view = randomView(walk.random);
        if (walk.random.index(15) == 0) walk.changeBudget();
        if (walk.random.index(30) == 0) walk.load.frozen = !walk.load.frozen;
        const bool overBudget = walk.residency.totalBytes() > budgetBytes(walk.load);
        const std::vector<std::uint8_t> loadedBefore = walk.residency.loaded;
        walk.frame(walk.random.uniform(0.0, 0.2));
        walk.checkBooks();
        bool frontEvicted = false;
        for (const NodeId node : walk.plan.evicted) {
            frontEvicted = frontEvicted || (!walk.inFront.empty() && walk.inFront[node] != 0);
            RC_ASSERT(overBudget || !walk.load.frozen);
        }
        RC_ASSERT(walk.plan.frontEvicted == frontEvicted);
        RC_ASSERT(!frontEvicted || overBudget);
        // What is drawn, was complete and still is: no hole opens in a front that was not cut.
        for (NodeId n = 0; n < walk.scene.hierarchy.size() && !overBudget && !walk.inFront.empty(); ++n) {
            const NodeId parent = walk.scene.hierarchy.parent[n];
            if (walk.inFront[n] == 0 || parent == kNoNode) continue;
            RC_ASSERT(walk.residency.loadedChildren[parent] == walk.scene.hierarchy.childCount[parent]);
        }
        walk.chooseFront();
    }
}

// --- A still camera, against a slow and simple account of what may still be loaded. ---

struct Oracle {
    const RandomWalk& walk;
    const Hierarchy& h = walk.scene.hierarchy;
    std::map<NodeId, double> priorities = {};

    double priorityOf(NodeId parent) {  // of the group of its children
        if (parent == kNoNode) return std::numeric_limits<double>::infinity();
        const auto known = priorities.find(parent);
        if (known != priorities.end()) return known->second;
        double greatest = 0.0, gain = 0.0, bytes = 1.0;
        for (const NodeId child : childrenOf(parent)) {
            EffectWork work;
            const NodeView seen = lookAtNode(h, child, walk.view, walk.select, walk.effects, work);
            greatest = std::max(greatest, seen.priority);
            double weight = 1.0;
            if (!seen.visible) weight = std::max(0.1, 0.3 * seen.frustumVisibility);
            gain += weight * ChildErrorGain(h, parent, walk.view).of(child, seen.distance);
            bytes += h.residentBytes[child];
        }
        const double own = walk.load.order == LoadOrder::gain ? gain / bytes : greatest;
        return priorities[parent] = hopeless(parent) ? 0.0 : std::min(own, priorityOf(h.parent[parent]));
    }
    Nodes childrenOf(NodeId parent) const {
        Nodes children;
        for (NodeId n = 0; n < h.size(); ++n) {
            if (h.parent[n] == parent) children.push_back(n);
        }
        return children;
    }
    bool broken(NodeId parent) const {
        const Nodes children = childrenOf(parent);
        return std::any_of(children.begin(), children.end(),
                           [&](NodeId n) { return walk.residency.state[n] == NodeState::failed; });
    }
    bool hopeless(NodeId parent) const {
        if (!walk.select.needAllChildren) return false;
        for (; parent != kNoNode; parent = h.parent[parent]) {
            if (broken(parent)) return true;
        }
        return false;
    }
    bool completeOrUsable(NodeId parent) const {
        for (; parent != kNoNode; parent = h.parent[parent]) {
            if (walk.residency.loadedChildren[parent] == h.childCount[parent]) continue;
            if (walk.select.needAllChildren || !broken(parent)) return false;
        }
        return true;
    }
    // Evicts in thought whatever may go for a group of this priority, leaves first, until nothing more can
    // go.
    std::uint64_t freedFor(double priority) {
        std::vector<std::uint8_t> held = walk.residency.loaded;
        std::uint64_t freed = 0;
        for (bool more = true; more;) {
            more = false;
            for (NodeId parent = 0; parent < h.size(); ++parent) {
                std::uint64_t bytes = 0;
                bool stays = false;
                for (const NodeId child : childrenOf(parent)) {
                    if (held[child] == 0) continue;
                    bytes += h.residentBytes[child];
                    stays = stays || walk.inFront[child] != 0;
                    for (const NodeId below : childrenOf(child)) stays = stays || held[below] != 0;
                }
                if (bytes == 0 || stays || priorityOf(parent) >= walk.load.swapMargin * priority) continue;
                for (const NodeId child : childrenOf(parent)) held[child] = 0;
                freed += bytes;
                more = true;
            }
        }
        return freed;
    }
};

RC_GTEST_PROP(LoadProperties, AStillCameraComesToRestWithTheBestThatFits, (std::uint64_t seed)) {
    RandomWalk walk(seed, 0.02);
    for (int frame = 0; frame < 30; ++frame) {
        walk.frame(0.2);
        walk.chooseFront();
    }
    walk.view = randomView(walk.random);
    walk.changeBudget();
    walk.loader->faultRate = walk.device.faultRate = 0.0;
    int frames = 0;
    for (int quiet = 0; quiet < 2; ++frames) {
        RC_ASSERT(frames < 1000);
        const std::uint64_t requested = walk.residency.counters.requested;
        walk.frame(10.0);  // longer than any back-off
        walk.checkBooks();
        const bool moved = requested != walk.residency.counters.requested || !walk.plan.evicted.empty();
        const auto isBarred = [](const SiblingGroup& group) { return group.barred; };  // it may come back yet
        const bool waits = std::ranges::any_of(walk.plan.groups.groups, isBarred);
        quiet = moved || waits || !walk.plan.wishes.empty() ? 0 : quiet + 1;
    }
    const LoadCounters rest = walk.residency.counters;
    for (int frame = 0; frame < 300; ++frame) walk.frame(0.1);
    RC_ASSERT(walk.residency.counters.requested == rest.requested);
    RC_ASSERT(walk.residency.counters.evicted == rest.evicted);
    RC_ASSERT(walk.residency.counters.cancelled == rest.cancelled);

    // Nothing that could be had is missing, and what is missing says why.
    Oracle oracle{walk};
    const Hierarchy& h = walk.scene.hierarchy;
    bool everythingLoaded = true;
    for (NodeId parent = 0; parent < h.size(); ++parent) {
        if (h.isLeaf(parent) || walk.residency.loaded[parent] == 0) continue;
        std::uint64_t missing = 0;
        for (const NodeId child : oracle.childrenOf(parent)) {
            if (walk.residency.loaded[child] == 0) missing += flightBytes(h, child);
        }
        const bool loadable = missing > 0 && !oracle.broken(parent) && !oracle.hopeless(parent) &&
                              oracle.completeOrUsable(h.parent[parent]);
        if (loadable) {
            everythingLoaded = false;
            const std::uint64_t room = budgetBytes(walk.load) - walk.residency.totalBytes() +
                                       oracle.freedFor(oracle.priorityOf(parent));
            RC_ASSERT(missing > room);
        }
        for (const NodeId child : oracle.childrenOf(parent)) {
            const bool refused = loadable && walk.residency.loaded[child] == 0;
            RC_ASSERT((walk.residency.memoryRefused[child] == 1) == refused);
        }
    }
    RC_ASSERT(walk.plan.everythingLoaded == everythingLoaded);
}

RC_GTEST_PROP(LoadProperties, TheSimulatedWalkIsTheSameEveryTime, (std::uint64_t seed)) {
    RandomWalk one(seed, 0.05), two(seed, 0.05);
    for (int frame = 0; frame < 60; ++frame) {
        for (RandomWalk* walk : {&one, &two}) {
            if (walk->random.index(10) == 0) walk->view = randomView(walk->random);
            walk->frame(0.05);
            walk->chooseFront();
        }
        RC_ASSERT(one.residency.state == two.residency.state);
        RC_ASSERT(one.plan.evicted == two.plan.evicted);
        RC_ASSERT(one.plan.wishes.size() == two.plan.wishes.size());
    }
}

}  // namespace
}  // namespace fb::test
