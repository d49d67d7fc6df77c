// Deciding what to load and what to give up, once a frame on the main thread (thesis 4.3, algorithms section
// 4). In: the camera, the front, the residency. Out: the wishes for the loader, the nodes given up, the
// residency changed. Priorities of all resident nodes and of all candidates (unloaded nodes whose parent is
// resident) are computed afresh: kept from the last visit, nodes behind the camera would hold memory for
// ever. Sibling groups load and go together; a partial group is of no use. Level 0 is pinned. How a group's
// priority is made, and why a still camera comes to rest: sibling_groups.h. Costs O(resident + candidates)
// and the sorting of the groups that may change; allocates nothing once the vectors have grown.
#pragma once

#include <span>
#include <vector>

#include "load/residency.h"
#include "load/sibling_groups.h"
#include "select/priority.h"

namespace fb {

struct Wish {
    NodeId node;
    double priority;  // of its sibling group
};

struct LoadPlan {
    std::vector<Wish> wishes;       // all in flight, falling priority, siblings side by side: for the loader
    std::vector<NodeId> evicted;    // given up this frame; the caller releases them on the device
    std::vector<NodeId> requested;  // in flight from this frame on
    std::vector<NodeId> withdrawn;  // no longer
    bool everythingLoaded = false;  // no candidate is left and nothing is in flight
    bool frontEvicted =
        false;  // a node of inFront had to go (budget cut): that front must not be drawn again
    // Scratch.
    SiblingGroups groups;
    std::vector<std::uint32_t> candidates;   // groups that could be loaded, a heap by priority
    std::vector<std::uint32_t> victims;      // groups that may be evicted, in the order in which they go
    std::vector<std::uint64_t> victimBytes;  // [i]: bytes of the victims before i
    std::vector<std::uint32_t> underWay;     // groups in flight, in the order in which they step back
};

struct PlanInput {
    const Hierarchy& hierarchy;
    const View& view;
    const SelectSettings& select;
    const LoadSettings& load;
    const ActiveEffects& effects;
    std::span<const std::uint8_t> inFront;  // one a node, 1: drawn this frame, must stay; empty: no front yet
    double nowSeconds = 0.0;
};

// maxMemory in bytes.
// 0: textures have no budget of their own.
[[nodiscard]] inline std::uint64_t textureBudgetBytes(const LoadSettings& load) {
    return static_cast<std::uint64_t>(load.textureBudgetMiB * kBytesPerMiB);
}
[[nodiscard]] inline std::uint64_t budgetBytes(const LoadSettings& load) {
    return static_cast<std::uint64_t>(load.budgetMiB * kBytesPerMiB);
}

// Bytes that may be in flight at once: an eighth of the budget, at least 8 MiB; a larger group goes alone.
// Few enough that a change of priorities shows at once, enough that the loader always knows what comes next.
[[nodiscard]] std::uint64_t flightWindowBytes(std::uint64_t budgetBytes);

// Changes `residency` (reservations, evictions, states) so that residentBytes + reservedBytes <= budget
// whenever the pinned roots allow it, and fills `plan`. The roots must be resident.
void planLoads(const PlanInput& input, Residency& residency, LoadPlan& plan);

// Of the roots, which always stay.
[[nodiscard]] std::uint64_t pinnedBytes(const Hierarchy& hierarchy);

// Error with the number needed when the roots alone do not fit into the budget.
[[nodiscard]] Result<void> checkBudget(const Hierarchy& hierarchy, const LoadSettings& load);

}  // namespace fb
