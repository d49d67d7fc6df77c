#include "load/sibling_groups.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/check.h"
#include "load/plan_loads.h"

namespace fb {
namespace {

// Resident nodes with children, by level from the top: a counting sort.
void listParents(const Hierarchy& hierarchy, const Residency& residency, std::vector<NodeId>& parents) {
    std::array<std::uint32_t, 257> start{};
    for (const NodeId node : residency.resident) {
        if (!hierarchy.isLeaf(node)) ++start[hierarchy.level[node] + 1u];
    }
    for (std::size_t level = 1; level < start.size(); ++level) start[level] += start[level - 1];
    parents.resize(start.back());
    for (const NodeId node : residency.resident) {
        if (!hierarchy.isLeaf(node)) parents[start[hierarchy.level[node]]++] = node;
    }
}

void addMember(const PlanInput& input, Residency& residency, NodeId node, SiblingGroup& group) {
    const SiblingGroup::Part part{1, input.hierarchy.residentBytes[node]};
    residency.memoryRefused[node] = 0;
    switch (residency.state[node]) {
        case NodeState::resident:
            group.held.add(part);
            if (!input.inFront.empty() && input.inFront[node] != 0) group.pinned = true;
            return;
        case NodeState::wanted:
        case NodeState::ready:
            group.held.add(part);
            group.inFlight.add(part);
            break;
        case NodeState::failed:
            group.broken = true;
            break;
        case NodeState::failedTemporarily:
        case NodeState::unloaded:
            group.missing.add(part);
            if (residency.state[node] == NodeState::failedTemporarily &&
                input.nowSeconds < residency.retryAtSeconds[node]) {
                group.waiting = true;
            }
            break;
    }
    group.complete = false;
}

}  // namespace

void gatherSiblingGroups(const PlanInput& input, Residency& residency, SiblingGroups& into) {
    const Hierarchy& hierarchy = input.hierarchy;
    into.groupOf.resize(hierarchy.size());
    into.groups.clear();
    into.effectWork = {};
    listParents(hierarchy, residency, into.parents);
    for (const NodeId parent : into.parents) {
        SiblingGroup group;
        group.parent = parent;
        group.complete = true;
        const NodeId first = hierarchy.firstChild[parent];
        const NodeId end = first + hierarchy.childCount[parent];
        for (NodeId node = first; node < end; ++node) addMember(input, residency, node, group);

        double cap = std::numeric_limits<double>::infinity();
        bool reachable = true;
        group.hopeless = group.broken && input.select.needAllChildren;
        if (hierarchy.parent[parent] != kNoNode) {
            group.above = into.groupOf[hierarchy.parent[parent]];
            const SiblingGroup& above = into.groups[group.above];
            cap = above.priority;
            reachable = above.usable;
            group.hopeless = group.hopeless || above.hopeless;
        }
        group.usable = reachable && !group.hopeless && (group.complete || group.broken);
        group.waiting = group.waiting || !reachable;
        if (!group.hopeless && (reachable || group.held.members > 0)) {
            for (NodeId node = first; node < end; ++node) {
                const double seen =
                    lookAtNode(hierarchy, node, input.view, input.select, input.effects, into.effectWork).priority;
                group.priority = std::max(group.priority, seen);
            }
            group.priority = std::min(group.priority, cap);
        }
        into.groupOf[parent] = static_cast<std::uint32_t>(into.groups.size());
        into.groups.push_back(group);
    }
    for (std::size_t i = into.groups.size(); i-- > 0;) {
        const SiblingGroup& group = into.groups[i];
        if (group.pinned && group.above != kNoGroup) into.groups[group.above].pinned = true;
    }
}

}  // namespace fb
