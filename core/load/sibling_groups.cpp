#include "load/sibling_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "load/plan_loads.h"
#include "select/gain.h"
#include "select/surface_distance.h"

namespace fb {
namespace {

// Seconds: a group stays away for so long after it was evicted, at least and at most; and what it was evicted for counts half as
// much after each kHalfLife.
constexpr double kLeastAway = 1.0, kMostAway = 20.0, kHalfLife = 4.0;
// Of the gain of a node that is not in view: right beside it, and anywhere else.
constexpr double kWeightBeside = 0.3, kLeastWeight = 0.1;

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

// How much it matters to have the group's members in memory (algorithms section 4, Order).
double importance(const PlanInput& input, const SiblingGroup& group, EffectWork& work) {
    const Hierarchy& hierarchy = input.hierarchy;
    const NodeId first = hierarchy.firstChild[group.parent];
    const ChildErrorGain child(hierarchy, group.parent, input.view);
    const glm::dvec3 eye = predictedEye(input.view, input.select, input.effects);
    double priority = 0.0, gain = 0.0, bytes = 1.0;
    for (NodeId node = first; node < first + hierarchy.childCount[group.parent]; ++node) {
        const NodeView seen = lookAtNode(hierarchy, node, input.view, input.select, input.effects, work);
        priority = std::max(priority, seen.priority);
        if (input.load.order == LoadOrder::priority) continue;
        const double weight = seen.visible ? 1.0 : std::max(kLeastWeight, kWeightBeside * seen.frustumVisibility);
        gain += weight * child.of(node, surfaceDistance(hierarchy, node, eye));
        bytes += static_cast<double>(hierarchy.residentBytes[node]);
    }
    return input.load.order == LoadOrder::priority ? priority : gain / bytes;
}

// Free memory that is too small for anything else would be filled with what was evicted last, and evicted again with the next
// load, many times a second.
bool isBarred(const PlanInput& input, const Residency& residency, const SiblingGroup& group) {
    const double gone = input.nowSeconds - residency.evictedAtSeconds[group.parent];
    const double limit = input.load.swapMargin * residency.evictedFor[group.parent];
    if (limit <= 0.0 || gone < 0.0 || gone > kMostAway || group.held.members > 0) return false;
    return gone < kLeastAway || group.priority < limit * std::exp2(-gone / kHalfLife);
}

void addMember(const PlanInput& input, Residency& residency, NodeId node, SiblingGroup& group) {
    const SiblingGroup::Part part{1, residency.state[node] == NodeState::resident ? input.hierarchy.residentBytes[node]
                                                                                 : flightBytes(input.hierarchy, node)};
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
            group.priority = std::min(importance(input, group, into.effectWork), cap);
            group.barred = isBarred(input, residency, group);
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
