// Making room for a group in memory and in the window of loads in flight: the steps of planLoads
// (plan_loads.h). Groups go in the order of rising priority, children before the group that they hang from; a
// group in use by the front stays, except when the budget was cut below what is held. Only what matters
// clearly less gives way: priority below LoadSettings::swapMargin times that of the group that comes in
// (algorithms section 4). What could be freed is known before anything is given up, so nothing goes for a
// group that does not come.
#pragma once

#include "load/plan_loads.h"

namespace fb {

struct RoomMaker {
    const PlanInput& input;
    const Hierarchy& hierarchy;
    Residency& residency;
    LoadPlan& plan;
    std::uint64_t budgetBytes;
    double highestLimit = 0.0;  // no group of this priority or above will be asked to go in this frame
    bool victimsListed = false;
    std::uint32_t victimsTaken = 0;  // of plan.victims
    bool underWayListed = false;
    std::uint32_t steppedBack = 0;  // of plan.underWay
};

[[nodiscard]] RoomMaker startMakingRoom(const PlanInput& input, Residency& residency, LoadPlan& plan);

// Evicts until the budget is kept or only the roots are left: the nodes of the front last.
void shrinkToBudget(RoomMaker& room);

// Whether the group's missing members could be given memory. Groups must be asked for in the order of falling
// priority.
[[nodiscard]] bool canMakeRoom(RoomMaker& room, const SiblingGroup& group);
// Evicts what is needed for them; after canMakeRoom().
void evictFor(RoomMaker& room, const SiblingGroup& group);
// Whether they may be in flight beside the others; stops less urgent loads for that, or changes nothing.
[[nodiscard]] bool makeWayInWindow(RoomMaker& room, const SiblingGroup& group);

// Withdraws the requests for a group's members; the resident ones stay.
void withdrawLoads(RoomMaker& room, SiblingGroup& group);
// Marks the members that are not resident as refused for want of memory.
void refuseMemory(RoomMaker& room, const SiblingGroup& group);

}  // namespace fb
