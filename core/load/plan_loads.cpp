#include "load/plan_loads.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/check.h"
#include "load/make_room.h"

namespace fb {
namespace {

constexpr std::uint64_t kSmallestWindowBytes = std::uint64_t{8} << 20;

// Requests that can no longer come to anything: their group has lost a member for good.
void withdrawHopelessLoads(RoomMaker& room) {
    for (SiblingGroup& group : room.plan.groups.groups) {
        if (group.hopeless || group.broken) withdrawLoads(room, group);
    }
}

// Whether it still hangs from a resident node and was not given up for a more urgent one.
bool isStillCandidate(const RoomMaker& room, const SiblingGroup& group) {
    return !group.evicted && room.residency.state[group.parent] == NodeState::resident;
}

void reserveMissing(RoomMaker& room, const SiblingGroup& group) {
    const NodeId first = room.hierarchy.firstChild[group.parent];
    for (NodeId node = first; node < first + room.hierarchy.childCount[group.parent]; ++node) {
        const NodeState state = room.residency.state[node];
        if (state != NodeState::unloaded && state != NodeState::failedTemporarily) continue;
        room.residency.reserve(room.hierarchy, node);
        ++room.residency.counters.requested;
        room.plan.requested.push_back(node);
    }
}

void listCandidates(RoomMaker& room) {
    LoadPlan& plan = room.plan;
    for (std::uint32_t i = 0; i < plan.groups.groups.size(); ++i) {
        const SiblingGroup& group = plan.groups.groups[i];
        const bool blocked = group.hopeless || group.broken || group.waiting || group.evicted;
        if (group.missing.members == 0 || blocked) continue;
        if (group.barred) {
            refuseMemory(room, group);
        } else {
            plan.candidates.push_back(i);
        }
    }
}

// Admits groups by falling priority, the lowest id first among equals. One for which no room can be made is
// passed over: a group larger than the memory must not stop all others. One that has to wait for its place in
// the window stops the rest: they would get ahead of it for ever.
void admitGroups(RoomMaker& room) {
    LoadPlan& plan = room.plan;
    const std::vector<SiblingGroup>& groups = plan.groups.groups;
    const auto lessUrgent = [&groups](std::uint32_t a, std::uint32_t b) {
        return groups[a].priority != groups[b].priority ? groups[a].priority < groups[b].priority
                                                        : groups[a].parent > groups[b].parent;
    };
    std::make_heap(plan.candidates.begin(), plan.candidates.end(), lessUrgent);
    while (!plan.candidates.empty()) {
        const SiblingGroup& group = groups[plan.candidates.front()];
        if (isStillCandidate(room, group)) {
            if (!canMakeRoom(room, group)) {
                refuseMemory(room, group);
            } else if (!makeWayInWindow(room, group)) {
                break;
            } else {
                evictFor(room, group);
                reserveMissing(room, group);
            }
        }
        std::pop_heap(plan.candidates.begin(), plan.candidates.end(), lessUrgent);
        plan.candidates.pop_back();
    }
    for (const std::uint32_t i : plan.candidates) {
        const SiblingGroup& group = groups[i];
        if (isStillCandidate(room, group) && !canMakeRoom(room, group)) refuseMemory(room, group);
    }
}

void listWishes(const Hierarchy& hierarchy, const Residency& residency, LoadPlan& plan) {
    for (const NodeId node : residency.inFlight) {
        const std::uint32_t group = plan.groups.groupOf[hierarchy.parent[node]];
        plan.wishes.push_back({node, plan.groups.groups[group].priority});
    }
    std::sort(plan.wishes.begin(), plan.wishes.end(), [](const Wish& a, const Wish& b) {
        return a.priority != b.priority ? a.priority > b.priority : a.node < b.node;
    });
}

}  // namespace

std::uint64_t flightWindowBytes(std::uint64_t budgetBytes) {
    return std::max(kSmallestWindowBytes, budgetBytes / 8);
}

void planLoads(const PlanInput& input, Residency& residency, LoadPlan& plan) {
    FB_CHECK(residency.state.size() == input.hierarchy.size());
    FB_CHECK((input.inFront.empty() || input.inFront.size() == input.hierarchy.size()));
    plan.wishes.clear();
    plan.evicted.clear();
    plan.requested.clear();
    plan.withdrawn.clear();
    plan.candidates.clear();
    plan.frontEvicted = false;
    gatherSiblingGroups(input, residency, plan.groups);
    RoomMaker room = startMakingRoom(input, residency, plan);

    withdrawHopelessLoads(room);
    if (input.load.frozen) {
        for (SiblingGroup& group : plan.groups.groups) withdrawLoads(room, group);
    }
    shrinkToBudget(room);
    if (!input.load.frozen) {
        listCandidates(room);
        admitGroups(room);
    }
    listWishes(input.hierarchy, residency, plan);

    plan.everythingLoaded = residency.inFlight.empty();
    for (const SiblingGroup& group : plan.groups.groups) {
        const bool settled = group.complete || group.broken || group.hopeless;
        if (group.evicted || !settled) plan.everythingLoaded = false;
    }
}

std::uint64_t pinnedBytes(const Hierarchy& hierarchy) {
    std::uint64_t bytes = 0;
    for (NodeId root = 0; root < hierarchy.rootCount; ++root) bytes += hierarchy.residentBytes[root];
    return bytes;
}

Result<void> checkBudget(const Hierarchy& hierarchy, const LoadSettings& load) {
    const std::uint64_t rootBytes = pinnedBytes(hierarchy);
    if (rootBytes <= budgetBytes(load)) return {};
    const auto neededMiB =
        static_cast<std::uint64_t>(std::ceil(static_cast<double>(rootBytes) / kBytesPerMiB));
    return failure("load.budget", {},
                   std::to_string(hierarchy.rootCount) + " roots of the scene take " +
                       std::to_string(rootBytes) + " bytes, the budget is " +
                       std::to_string(budgetBytes(load)),
                   "set load.budget to " + std::to_string(neededMiB) + " MiB or more");
}

}  // namespace fb
