// Deciding what to load and what to give up, once a frame on the main thread (thesis 4.3, algorithms section 4).
// Priorities of all resident nodes and of all candidates (unloaded nodes whose parent is resident) are computed afresh:
// kept from the last visit, nodes behind the camera would hold memory for ever.
// Sibling groups load together; a partial group is of no use. Level 0 is pinned.
#pragma once

#include <span>
#include <vector>

#include "load/residency.h"
#include "select/priority.h"

namespace fb {

struct Wish {
    NodeId node;
    double priority;
};

struct LoadPlan {
    std::vector<Wish> wishes;     // all in flight, falling priority: what the loader works on
    std::vector<NodeId> evicted;  // given up this frame; the caller releases them on the device
    bool everythingLoaded = false;  // no candidate is left
    // scratch
    struct Candidate {
        NodeId parent;
        double priority;  // greatest of its children
        std::uint64_t bytes;
    };
    std::vector<Candidate> candidates;
    std::vector<Wish> victims;
};

struct PlanInput {
    const Hierarchy& hierarchy;
    const View& view;
    const SelectSettings& select;
    const LoadSettings& load;
    const ActiveEffects& effects;
    std::span<const std::uint8_t> inFront;  // one a node, 1: drawn this frame, must stay
    double nowSeconds = 0.0;
};

// Changes `residency` (reservations, evictions, states) so that residentBytes + reservedBytes <= budget whenever the
// pinned roots and the nodes that must stay allow it, and fills `plan`.
void planLoads(const PlanInput& input, Residency& residency, LoadPlan& plan);

// maxMemory in bytes.
[[nodiscard]] inline std::uint64_t budgetBytes(const LoadSettings& load) {
    return static_cast<std::uint64_t>(load.budgetMiB * 1048576.0);
}

// Error with the number needed when the roots alone do not fit into the budget.
[[nodiscard]] Result<void> checkBudget(const Hierarchy& hierarchy, const LoadSettings& load);

}  // namespace fb
