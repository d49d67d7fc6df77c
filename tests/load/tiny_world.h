// Hand-made hierarchies for the loading tests: every node's priority and bytes are given outright.
// The camera sits inside every box and all effects are off, so that priority = staticBenefit exactly:
// visibility 1 (c_vis 0), cost 1 (no triangles), distance d_min = 1.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "load/loader.h"
#include "load/plan_loads.h"
#include "select/view.h"

namespace fb::test {

struct NodeSpec {
    NodeId parent;  // kNoNode for roots; specs are breadth first
    float priority;
    std::uint32_t bytes;
};

inline Hierarchy makeHierarchy(std::span<const NodeSpec> specs) {
    Hierarchy h;
    h.resize(specs.size());
    for (NodeId n = 0; n < specs.size(); ++n) {
        const NodeId parent = specs[n].parent;
        h.parent[n] = parent;
        h.firstChild[n] = kNoNode;
        h.childCount[n] = 0;
        h.level[n] = 0;
        h.block[n] = 0;
        h.bounds[n] = {{-1, -1, -1}, {1, 1, 1}};
        h.staticBenefit[n] = specs[n].priority;
        h.residentBytes[n] = specs[n].bytes;
        if (parent == kNoNode) {
            ++h.rootCount;
            continue;
        }
        h.level[n] = static_cast<std::uint8_t>(h.level[parent] + 1);
        if (h.childCount[parent]++ == 0) h.firstChild[parent] = n;
    }
    h.grids.resize(1);
    h.kinds.resize(1);
    return h;
}

// One frame after the other by hand: plan, deliver, look.
struct World {
    Hierarchy hierarchy;
    Residency residency;
    LoadPlan plan;
    View view = makeView(Camera{}, glm::dvec3(0.0), 64, 64);
    SelectSettings select;
    LoadSettings load;
    ActiveEffects effects;
    std::vector<std::uint8_t> inFront;
    double nowSeconds = 0.0;

    explicit World(std::vector<NodeSpec> specs) : hierarchy(makeHierarchy(specs)) {
        select.cVis = 0.0;
        load.order = LoadOrder::priority;
        load.swapMargin = 0.5;
        setBudget(1'000'000);
        residency.reset(hierarchy);
        for (NodeId root = 0; root < hierarchy.rootCount; ++root) residency.setResident(hierarchy, root);
    }
    void setBudget(std::uint64_t bytes) { load.budgetMiB = static_cast<double>(bytes) / 1048576.0; }

    void planFrame() {
        planLoads({hierarchy, view, select, load, effects, inFront, nowSeconds}, residency, plan);
    }
    void deliver(NodeId node) { residency.setResident(hierarchy, node); }
    void deliverAll() {
        while (!residency.inFlight.empty()) deliver(residency.inFlight.back());
    }
    // Until nothing is in flight.
    void settle() {
        for (int i = 0; i < 1000; ++i) {
            planFrame();
            if (plan.wishes.empty()) return;
            deliverAll();
        }
    }
    void setFront(std::initializer_list<NodeId> nodes) {
        inFront.assign(hierarchy.size(), 0);
        for (const NodeId node : nodes) inFront[node] = 1;
    }
    std::vector<NodeId> wished() const {
        std::vector<NodeId> nodes;
        for (const Wish& wish : plan.wishes) nodes.push_back(wish.node);
        return nodes;
    }
    std::vector<NodeId> loadedNodes() const {
        std::vector<NodeId> nodes;
        for (NodeId n = 0; n < hierarchy.size(); ++n) {
            if (residency.loaded[n] != 0) nodes.push_back(n);
        }
        return nodes;
    }
    std::vector<NodeId> refusedNodes() const {
        std::vector<NodeId> nodes;
        for (NodeId n = 0; n < hierarchy.size(); ++n) {
            if (residency.memoryRefused[n] != 0) nodes.push_back(n);
        }
        return nodes;
    }
};

using Nodes = std::vector<NodeId>;
using Faults = std::array<std::uint64_t, kLoadFaultCount>;  // read, content, upload
inline constexpr NodeId kRoot = kNoNode;

}  // namespace fb::test
