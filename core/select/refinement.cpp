#include "select/refinement.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "select/select.h"
#include "select/sibling_group.h"

namespace fb {
namespace {

constexpr double kLeastShareGained = 0.02;  // of a child's benefit
constexpr double kLeastExtraMs = 1e-3;
constexpr double kLargestValue = 1e300;
constexpr double kSavingFactor = 1000.0;  // what takes no more time is worth as if it took the least

// Benefits of the visible children, less what their parent's part of the same region has already.
double benefitGain(const SelectInput& input, NodeId parent, const SelectState& state) {
    const Hierarchy& h = input.hierarchy;
    const double part = static_cast<double>(h.staticBenefit[parent]) / h.childCount[parent];
    double gain = 0.0;
    for (std::size_t i = 0; i < state.group.size(); ++i) {
        const NodeId child = state.group[i];
        const double benefit = state.priorities[i] * nodeCost(h, child, input.settings.cTextured);
        const double own = static_cast<double>(h.staticBenefit[child]);
        gain += benefit * (own > 0.0 ? std::max(kLeastShareGained, 1.0 - part / own) : kLeastShareGained);
    }
    return gain;
}

// Edge of a texel in metres; 0 without texture.
double texelMetres(const Hierarchy& h, NodeId n) {
    const double texels = 1.0 * h.textureWidth[n] * h.textureHeight[n];
    return texels > 0.0 ? std::sqrt(static_cast<double>(h.areaSquareMetres[n]) / texels) : 0.0;
}

// How much less the pixels of the visible children are wrong by: pixels times pixels. Of lengths on the surface, not of the
// bound of algorithms section 8: next to the camera that knows nothing, above as below, and a gain of 0 would leave exactly
// those coarse. 0 only where nothing gets finer.
double errorGain(const SelectInput& input, NodeId parent, const std::vector<NodeId>& visible) {
    const Hierarchy& h = input.hierarchy;
    const double picture = 1.0 * input.view.width * input.view.height;
    const auto error = [&](NodeId n) { return static_cast<double>(h.geometricErrorMetres[n]) + 0.5 * texelMetres(h, n); };
    const double before = error(parent);
    double gain = 0.0;
    for (const NodeId child : visible) {
        const Box3d box{glm::dvec3(h.bounds[child].min), glm::dvec3(h.bounds[child].max)};
        const double distance = std::max(input.settings.minDistance, box.distance(input.view.camera.eye));
        const double scale = input.view.pixelsPerUnit / distance;
        const double pixels = std::min(picture, static_cast<double>(h.areaSquareMetres[child]) * scale * scale);
        gain += pixels * scale * std::max(0.0, before - error(child));
    }
    return gain;
}

}  // namespace

void RefinementTree::start(const SelectInput& input, SelectState& state, Selection& selection, GainMeasure gain) {
    gain_ = gain;
    nodes.clear();
    children.clear();
    gatherGroup(input, kNoNode, state, selection);
    children.assign(state.group.begin(), state.group.end());
    state.shares.assign(state.priorities.begin(), state.priorities.end());  // adding a node takes the place of the group
    const std::size_t roots = children.size();
    for (std::size_t i = 0; i < roots; ++i) {
        add(children[i], kNoRefinement, input, state, selection);
        nodes.back().priority = state.shares[i];
    }
}

void RefinementTree::expand(std::uint32_t index, const SelectInput& input, SelectState& state, Selection& selection) {
    FB_CHECK(nodes[index].usable);
    FB_CHECK(!nodes[index].expanded);
    nodes[index].expanded = true;
    if (nodes[index].parent != kNoRefinement) ++nodes[nodes[index].parent].expandedChildren;
    if (nodes[index].firstNode != kNoRefinement) return;
    nodes[index].firstNode = static_cast<std::uint32_t>(nodes.size());
    const std::uint32_t first = nodes[index].firstChild, count = nodes[index].childCount;
    for (std::uint32_t i = first; i < first + count; ++i) add(children[i], index, input, state, selection);
}

void RefinementTree::collapse(std::uint32_t index) {
    FB_CHECK(isInnermost(index));
    nodes[index].expanded = false;
    if (nodes[index].parent != kNoRefinement) --nodes[nodes[index].parent].expandedChildren;
}

void RefinementTree::finish(Selection& selection) const {
    for (const Refinement& r : nodes) {
        if (isReached(r)) selection.reached.push_back({r.node, r.expanded, r.boundBy, r.needMs, r.hadMs});
    }
}

double RefinementTree::drawnMs() const {
    double ms = 0.0;
    for (const Refinement& r : nodes) {
        if (!r.expanded && isReached(r)) ms += r.ownMs;
    }
    return ms;
}

void RefinementTree::add(NodeId node, std::uint32_t parent, const SelectInput& input, SelectState& state,
                         Selection& selection) {
    Refinement r;
    r.node = node;
    r.parent = parent;
    r.ownMs = nodeTimeMs(input.time, input.hierarchy, node);
    if (!input.hierarchy.isLeaf(node)) {
        gatherGroup(input, node, state, selection);
        r.firstChild = static_cast<std::uint32_t>(children.size());
        r.childCount = static_cast<std::uint32_t>(state.group.size());
        children.insert(children.end(), state.group.begin(), state.group.end());
        const GroupMemory memory = groupMemory(input, node, state);
        r.usable = r.childCount > 0 && memory == GroupMemory::loaded;
        r.boundBy = r.childCount == 0 ? BoundBy::view : r.usable ? BoundBy::time : boundByMemory(memory);
        weigh(r, input, state);
    }
    nodes.push_back(r);
}

void RefinementTree::weigh(Refinement& r, const SelectInput& input, const SelectState& state) const {
    double childrenMs = 0.0;
    for (const NodeId child : state.group) childrenMs += nodeTimeMs(input.time, input.hierarchy, child);
    r.gain = gain_ == GainMeasure::error ? errorGain(input, r.node, state.group) : benefitGain(input, r.node, state);
    r.extraMs = childrenMs - r.ownMs;
    r.value = r.extraMs > 0.0 ? r.gain / std::max(r.extraMs, kLeastExtraMs) : kSavingFactor * r.gain;
    r.value = std::min(r.value, kLargestValue);
}

}  // namespace fb
