#include "load/make_room.h"

#include <algorithm>

#include "base/check.h"

namespace fb {
namespace {

std::uint64_t freeBytes(const RoomMaker& room) {
    const std::uint64_t used = room.residency.totalBytes();
    return used < room.budgetBytes ? room.budgetBytes - used : 0;
}

// Priority below which a group gives way to `group`.
double limitFor(const RoomMaker& room, const SiblingGroup& group) {
    return room.input.load.swapMargin * group.priority;
}

template <class Visit>
void forEachMember(const RoomMaker& room, const SiblingGroup& group, Visit visit) {
    const NodeId first = room.hierarchy.firstChild[group.parent];
    const NodeId end = first + room.hierarchy.childCount[group.parent];
    for (NodeId node = first; node < end; ++node) visit(node);
}

// The order in which groups go; children before the group that they hang from.
bool goesFirst(const RoomMaker& room, std::uint32_t a, std::uint32_t b) {
    const SiblingGroup& left = room.plan.groups.groups[a];
    const SiblingGroup& right = room.plan.groups.groups[b];
    if (left.pinned != right.pinned) return right.pinned;
    if (left.priority != right.priority) return left.priority < right.priority;
    return left.parent > right.parent;  // breadth-first ids: deeper levels first
}

// The bytes of the victims not yet taken, summed up.
void sumVictims(RoomMaker& room) {
    LoadPlan& plan = room.plan;
    plan.victimBytes.resize(plan.victims.size() + 1);
    plan.victimBytes[room.victimsTaken] = 0;
    for (std::size_t i = room.victimsTaken; i < plan.victims.size(); ++i) {
        plan.victimBytes[i + 1] = plan.victimBytes[i] + plan.groups.groups[plan.victims[i]].held.bytes;
    }
}

void listVictims(RoomMaker& room) {
    std::vector<std::uint32_t>& victims = room.plan.victims;
    victims.clear();
    for (std::uint32_t i = 0; i < room.plan.groups.groups.size(); ++i) {
        const SiblingGroup& group = room.plan.groups.groups[i];
        const bool mayGo = !group.pinned && group.priority < room.highestLimit;
        if (mayGo && group.held.members > 0) victims.push_back(i);
    }
    std::sort(victims.begin(), victims.end(),
              [&room](std::uint32_t a, std::uint32_t b) { return goesFirst(room, a, b); });
    room.victimsListed = true;
    room.victimsTaken = 0;
    sumVictims(room);
}

void listUnderWay(RoomMaker& room) {
    std::vector<std::uint32_t>& underWay = room.plan.underWay;
    underWay.clear();
    for (std::uint32_t i = 0; i < room.plan.groups.groups.size(); ++i) {
        const SiblingGroup& group = room.plan.groups.groups[i];
        if (group.inFlight.members > 0 && group.priority < room.highestLimit) underWay.push_back(i);
    }
    std::sort(underWay.begin(), underWay.end(), [&room](std::uint32_t a, std::uint32_t b) {
        const SiblingGroup& left = room.plan.groups.groups[a];
        const SiblingGroup& right = room.plan.groups.groups[b];
        return left.priority != right.priority ? left.priority < right.priority : left.parent > right.parent;
    });
    room.underWayListed = true;
    room.steppedBack = 0;
}

// `forPriority`: of what needs the room; 0 where the budget was cut.
void evictGroup(RoomMaker& room, SiblingGroup& group, double forPriority) {
    room.residency.evictedAtSeconds[group.parent] = room.input.nowSeconds;
    room.residency.evictedFor[group.parent] = forPriority;
    forEachMember(room, group, [&](NodeId node) {
        if (room.residency.state[node] == NodeState::resident) {
            if (!room.input.inFront.empty() && room.input.inFront[node] != 0) room.plan.frontEvicted = true;
            room.residency.setUnloaded(room.hierarchy, node);
            ++room.residency.counters.evicted;
            room.plan.evicted.push_back(node);
            // Its children are no candidates any more.
            const NodeId first = room.hierarchy.firstChild[node];
            for (std::uint32_t i = 0; i < room.hierarchy.childCount[node]; ++i) {
                room.residency.memoryRefused[first + i] = 0;
            }
        }
    });
    withdrawLoads(room, group);
    group.held = {};
    group.evicted = true;
    refuseMemory(room, group);
}

}  // namespace

RoomMaker startMakingRoom(const PlanInput& input, Residency& residency, LoadPlan& plan) {
    RoomMaker room{input, input.hierarchy, residency, plan, budgetBytes(input.load)};
    for (const SiblingGroup& group : plan.groups.groups) {
        if (group.missing.members > 0) room.highestLimit = std::max(room.highestLimit, limitFor(room, group));
    }
    return room;
}

void shrinkToBudget(RoomMaker& room) {
    if (room.residency.totalBytes() <= room.budgetBytes) return;
    LoadPlan& plan = room.plan;
    plan.victims.clear();
    for (std::uint32_t i = 0; i < plan.groups.groups.size(); ++i) {
        if (plan.groups.groups[i].held.members > 0) plan.victims.push_back(i);
    }
    std::sort(plan.victims.begin(), plan.victims.end(),
              [&room](std::uint32_t a, std::uint32_t b) { return goesFirst(room, a, b); });
    for (const std::uint32_t i : plan.victims) {
        if (room.residency.totalBytes() <= room.budgetBytes) break;
        evictGroup(room, plan.groups.groups[i], 0.0);
    }
}

bool canMakeRoom(RoomMaker& room, const SiblingGroup& group) {
    if (room.residency.totalBytes() > room.budgetBytes) return false;  // the roots alone are too large
    std::uint64_t available = freeBytes(room);
    if (group.missing.bytes <= available) return true;
    if (!room.victimsListed) listVictims(room);
    const LoadPlan& plan = room.plan;
    const double limit = limitFor(room, group);
    const auto end =
        std::partition_point(plan.victims.begin() + room.victimsTaken, plan.victims.end(),
                             [&](std::uint32_t i) { return plan.groups.groups[i].priority < limit; });
    available += plan.victimBytes[static_cast<std::size_t>(end - plan.victims.begin())] -
                 plan.victimBytes[room.victimsTaken];
    return group.missing.bytes <= available;
}

void evictFor(RoomMaker& room, const SiblingGroup& group) {
    while (freeBytes(room) < group.missing.bytes) {
        FB_CHECK(room.victimsTaken < room.plan.victims.size());
        SiblingGroup& victim = room.plan.groups.groups[room.plan.victims[room.victimsTaken]];
        FB_CHECK(victim.priority < limitFor(room, group));
        if (victim.held.members > 0) evictGroup(room, victim, group.priority);  // 0: it stepped back in this frame
        ++room.victimsTaken;
    }
}

bool makeWayInWindow(RoomMaker& room, const SiblingGroup& group) {
    const std::uint64_t window = flightWindowBytes(room.budgetBytes);
    const auto fits = [&](std::uint64_t reserved) {
        return reserved == 0 || reserved + group.missing.bytes <= window;
    };
    std::uint64_t reserved = room.residency.reservedBytes;
    if (fits(reserved)) return true;
    if (!room.underWayListed) listUnderWay(room);
    std::vector<SiblingGroup>& groups = room.plan.groups.groups;
    const std::vector<std::uint32_t>& underWay = room.plan.underWay;
    const double limit = limitFor(room, group);
    std::uint32_t end = room.steppedBack;
    while (!fits(reserved) && end < underWay.size() && groups[underWay[end]].priority < limit) {
        reserved -= groups[underWay[end++]].inFlight.bytes;  // 0 where it was evicted meanwhile
    }
    if (!fits(reserved)) return false;
    for (; room.steppedBack < end; ++room.steppedBack) {
        withdrawLoads(room, groups[underWay[room.steppedBack]]);
    }
    if (room.victimsListed) sumVictims(room);
    return true;
}

void withdrawLoads(RoomMaker& room, SiblingGroup& group) {
    if (group.inFlight.members == 0) return;
    forEachMember(room, group, [&](NodeId node) {
        if (!room.residency.isInFlight(node)) return;
        room.residency.setUnloaded(room.hierarchy, node);
        ++room.residency.counters.cancelled;
        room.plan.withdrawn.push_back(node);
    });
    group.missing.add(group.inFlight);
    group.held.remove(group.inFlight);
    group.inFlight = {};
}

void refuseMemory(RoomMaker& room, const SiblingGroup& group) {
    forEachMember(room, group, [&](NodeId node) {
        if (room.residency.loaded[node] == 0) room.residency.memoryRefused[node] = 1;
    });
}

}  // namespace fb
