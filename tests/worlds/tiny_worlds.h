// Hand-made hierarchies of a few nodes with exact numbers. A TinyNode says what a node is and holds its
// children; makeWorld() lays the nodes out breadth first, as the scene file does, so ids are read off the
// picture row by row:
//
//        0     1          roots
//       / \    |
//      2   3   4          children of 0, then of 1
//
// The numbers are chosen for arithmetic without rounding. A camera at the origin (tinyCamera) looks along -z
// with 90 degrees in both directions; everything `ahead` is exactly 1 m away. With c_textured = 0.5 a node's
// cost is `cost`, and with c_vis = 0 and the effects off its priority is benefit / cost (thesis 4.2,
// algorithms 2 item 2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/camera.h"
#include "scenefile/hierarchy.h"
#include "select/view.h"

namespace fb {

inline Box3f boxOf(glm::vec3 low, glm::vec3 high) {
    return {low, high};
}
// In view, 1 m away.
inline Box3f ahead() {
    return boxOf({-0.25f, -0.25f, -2.0f}, {0.25f, 0.25f, -1.0f});
}
// Out of view to the right. The plane's normal is (-1, 0, -1)/sqrt 2 and the nearest corner (100, y, -2), so
// the box is 98 / sqrt 2 = 69.3 m outside.
inline Box3f aside() {
    return boxOf({100.0f, -0.25f, -2.0f}, {101.0f, 0.25f, -1.0f});
}
// Out of view behind the eye: 1 m behind it, 1.05 m behind the near plane.
inline Box3f behind() {
    return boxOf({-0.25f, -0.25f, 1.0f}, {0.25f, 0.25f, 2.0f});
}

struct TinyNode {
    std::uint32_t cost = 1;
    float benefit = 1.0f;
    Box3f box = ahead();  // grown by the children's
    std::vector<TinyNode> children = {};
    glm::vec3 normal{0.0f};
};

inline Hierarchy makeWorld(const std::vector<TinyNode>& roots) {
    struct Placed {
        const TinyNode* node;
        NodeId parent;
    };
    std::vector<Placed> order;
    for (const TinyNode& root : roots) order.push_back({&root, kNoNode});
    Hierarchy h;
    h.rootCount = static_cast<std::uint32_t>(roots.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto [node, parent] = order[i];
        const auto id = static_cast<NodeId>(i);
        h.resize(i + 1);
        h.parent[id] = parent;
        h.childCount[id] = static_cast<std::uint32_t>(node->children.size());
        h.firstChild[id] = node->children.empty() ? kNoNode : static_cast<NodeId>(order.size());
        h.level[id] = parent == kNoNode ? std::uint8_t{0} : static_cast<std::uint8_t>(h.level[parent] + 1);
        h.block[id] = parent == kNoNode ? id : h.block[parent];
        h.bounds[id] = node->box;
        h.texturedTriangles[id] = 2 * node->cost;
        h.staticBenefit[id] = node->benefit;
        h.averageNormal[id] = node->normal;
        h.payload[id].pack = h.block[id];
        for (const TinyNode& child : node->children) order.push_back({&child, id});
    }
    // Bottom up: a parent contains its children and is never the finer one.
    for (NodeId n = h.size(); n-- > h.rootCount;) {
        const NodeId p = h.parent[n];
        h.bounds[p].grow(h.bounds[n]);
        h.geometricErrorMetres[p] = std::max(h.geometricErrorMetres[p], h.geometricErrorMetres[n] + 0.5f);
    }
    h.grids.resize(h.rootCount);
    h.kinds.resize(h.rootCount);
    return h;
}

inline Camera tinyCamera() {
    Camera camera;
    camera.fovyRadians = 1.5707963267948966;
    return camera;
}
inline View tinyView() {
    return makeView(tinyCamera(), glm::dvec3(0.0), 100, 100);
}

}  // namespace fb
