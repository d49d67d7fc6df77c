#include "load/residency.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace fb {
namespace {

void addTo(std::vector<NodeId>& list, std::vector<std::uint32_t>& position, NodeId node) {
    position[node] = static_cast<std::uint32_t>(list.size());
    list.push_back(node);
}

void removeFrom(std::vector<NodeId>& list, std::vector<std::uint32_t>& position, NodeId node) {
    const std::uint32_t at = position[node];
    FB_CHECK(at < list.size());
    FB_CHECK(list[at] == node);
    list[at] = list.back();
    position[list[at]] = at;
    list.pop_back();
}

void leaveFlight(Residency& residency, const Hierarchy& hierarchy, NodeId node) {
    removeFrom(residency.inFlight, residency.position, node);
    residency.reservedBytes -= flightBytes(hierarchy, node);
}

}  // namespace

void Residency::reset(const Hierarchy& hierarchy) {
    const std::size_t nodes = hierarchy.size();
    state.assign(nodes, NodeState::unloaded);
    loaded.assign(nodes, 0);
    memoryRefused.assign(nodes, 0);
    loadedChildren.assign(nodes, 0);
    resident.clear();
    inFlight.clear();
    position.assign(nodes, 0);
    retryAtSeconds.assign(nodes, 0.0);
    failures.assign(nodes, 0);
    evictedAtSeconds.assign(nodes, 0.0);
    evictedFor.assign(nodes, 0.0);
    residentBytes = residentTextureBytes = reservedBytes = peakBytes = 0;
    texturedTriangles = untexturedTriangles = 0;
    counters = {};
}

void Residency::setResident(const Hierarchy& hierarchy, NodeId node) {
    const NodeId above = hierarchy.parent[node];
    FB_CHECK((above == kNoNode || loaded[above] == 1));
    if (isInFlight(node)) {
        leaveFlight(*this, hierarchy, node);
    } else {
        FB_CHECK((state[node] == NodeState::unloaded));
    }
    state[node] = NodeState::resident;
    loaded[node] = 1;
    memoryRefused[node] = 0;
    failures[node] = 0;
    addTo(resident, position, node);
    residentBytes += hierarchy.residentBytes[node];
    residentTextureBytes += hierarchy.textureBytes(node);
    texturedTriangles += hierarchy.texturedTriangles[node];
    untexturedTriangles += hierarchy.untexturedTriangles[node];
    if (above != kNoNode) ++loadedChildren[above];
    peakBytes = std::max(peakBytes, totalBytes());
}

void Residency::setUnloaded(const Hierarchy& hierarchy, NodeId node) {
    if (state[node] == NodeState::resident) {
        FB_CHECK(loadedChildren[node] == 0u);
        removeFrom(resident, position, node);
        residentBytes -= hierarchy.residentBytes[node];
        residentTextureBytes -= hierarchy.textureBytes(node);
        texturedTriangles -= hierarchy.texturedTriangles[node];
        untexturedTriangles -= hierarchy.untexturedTriangles[node];
        loaded[node] = 0;
        if (hierarchy.parent[node] != kNoNode) --loadedChildren[hierarchy.parent[node]];
    } else {
        FB_CHECK(isInFlight(node));
        leaveFlight(*this, hierarchy, node);
    }
    state[node] = NodeState::unloaded;
}

void Residency::reserve(const Hierarchy& hierarchy, NodeId node) {
    const NodeId above = hierarchy.parent[node];
    FB_CHECK((above == kNoNode || loaded[above] == 1));
    FB_CHECK((state[node] == NodeState::unloaded || state[node] == NodeState::failedTemporarily));
    if (state[node] == NodeState::failedTemporarily) ++counters.retried;
    state[node] = NodeState::wanted;
    addTo(inFlight, position, node);
    reservedBytes += flightBytes(hierarchy, node);
    peakBytes = std::max(peakBytes, totalBytes());
}

void Residency::setFailed(const Hierarchy& hierarchy, NodeId node, double nowSeconds) {
    FB_CHECK(isInFlight(node));
    leaveFlight(*this, hierarchy, node);
    ++failures[node];
    if (failures[node] >= kLoadTries) {
        state[node] = NodeState::failed;
        ++counters.givenUp;
        return;
    }
    state[node] = NodeState::failedTemporarily;
    retryAtSeconds[node] = nowSeconds + std::ldexp(kFirstRetrySeconds, failures[node] - 1);
}

}  // namespace fb
