#include "scenefile/hierarchy.h"

#include <algorithm>

#include "scenefile/node_data.h"

namespace fb {

std::uint8_t Hierarchy::maxLevel() const {
    return level.empty() ? std::uint8_t{0} : *std::ranges::max_element(level);
}

std::uint64_t Hierarchy::textureBytes(NodeId n) const { return mippedBytes(textureWidth[n], textureHeight[n]); }

void Hierarchy::resize(std::size_t nodes) {
    parent.resize(nodes, kNoNode);
    firstChild.resize(nodes, kNoNode);
    childCount.resize(nodes, 0);
    level.resize(nodes, 0);
    stuck.resize(nodes, 0);
    block.resize(nodes, 0);
    bounds.resize(nodes);
    texturedTriangles.resize(nodes, 0);
    untexturedTriangles.resize(nodes, 0);
    skirtTriangles.resize(nodes, 0);
    borderErrorMetres.resize(nodes, 0.0f);
    vertices.resize(nodes, 0);
    staticBenefit.resize(nodes, 0.0f);
    averageNormal.resize(nodes, glm::vec3(0.0f));
    normalCoherence.resize(nodes, 0.0f);
    areaSquareMetres.resize(nodes, 0.0f);
    geometricErrorMetres.resize(nodes, 0.0f);
    textureWidth.resize(nodes, 0);
    textureHeight.resize(nodes, 0);
    residentBytes.resize(nodes, 0);
    payload.resize(nodes);
}

double nodeCost(const Hierarchy& hierarchy, NodeId node, double cTextured) {
    return std::max(1.0, hierarchy.texturedTriangles[node] * cTextured +
                             hierarchy.untexturedTriangles[node] * (1.0 - cTextured));
}

}  // namespace fb
