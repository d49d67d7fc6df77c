#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "scenefile/hierarchy.h"
#include "scenefile/limits.h"
#include "scenefile/node_data.h"

namespace fb {
namespace {

using Fault = std::string;  // empty: none

bool sameLengths(const Hierarchy& h) {
    const std::array lengths = {h.firstChild.size(),
                                h.childCount.size(),
                                h.level.size(),
                                h.stuck.size(),
                                h.block.size(),
                                h.bounds.size(),
                                h.texturedTriangles.size(),
                                h.untexturedTriangles.size(),
                                h.skirtTriangles.size(),
                                h.vertices.size(),
                                h.staticBenefit.size(),
                                h.averageNormal.size(),
                                h.normalCoherence.size(),
                                h.areaSquareMetres.size(),
                                h.geometricErrorMetres.size(),
                                h.borderErrorMetres.size(),
                                h.textureWidth.size(),
                                h.textureHeight.size(),
                                h.residentBytes.size(),
                                h.payload.size()};
    for (std::size_t length : lengths) {
        if (length != h.parent.size()) return false;
    }
    return true;
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool notNegative(float value) {
    return std::isfinite(value) && value >= 0.0f;
}

Fault checkGrid(const BlockGrid& grid) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(grid.origin[axis]) <= kMaxCoordinateMetres))
            return "the grid's origin is out of range";
    }
    int exponent = 0;
    if (!std::isfinite(grid.step) || std::frexp(grid.step, &exponent) != 0.5) {
        return "the grid's step is not a power of two";
    }
    // frexp gives a fraction of 0.5, so the step is 2^(exponent - 1).
    if (exponent - 1 < kMinGridExponent || exponent - 1 > kMaxGridExponent)
        return "the grid's step is out of range";
    return {};
}

// `next`: the first node that has not been given to a parent yet. In breadth-first order it is the first
// child of the next inner node; this one rule makes children contiguous, after their parent, and of exactly
// one parent.
Fault checkLinks(const Hierarchy& h, NodeId n, NodeId& next) {
    const bool root = n < h.rootCount;
    if (root != (h.parent[n] == kNoNode)) return "roots must come first and have no parent";
    if (root && h.level[n] != 0) return "a root must have level 0";
    if (root && h.block[n] != n) return "root and block must have the same number";
    if (h.level[n] > kMaxLevel) return "the level is above " + std::to_string(kMaxLevel);
    if (h.childCount[n] == 0) {
        return h.firstChild[n] == kNoNode ? Fault() : "a leaf must not have a first child";
    }
    if (h.firstChild[n] != next) return "the children do not follow in breadth-first order";
    if (h.childCount[n] > h.size() - next) return "there are more children than nodes";
    next += h.childCount[n];
    return {};
}

Fault checkAgainstParent(const Hierarchy& h, NodeId n) {
    const NodeId p = h.parent[n];
    if (p >= n) return "the parent must come before its children";
    if (n < h.firstChild[p] || n - h.firstChild[p] >= h.childCount[p])
        return "the parent does not know this child";
    if (h.level[n] != h.level[p] + 1) return "the level must be one more than the parent's";
    if (h.block[n] != h.block[p]) return "the block must be the parent's";
    if (!h.bounds[p].contains(h.bounds[n])) return "the bounds must lie inside the parent's";
    if (h.geometricErrorMetres[n] > h.geometricErrorMetres[p])
        return "the error must not exceed the parent's";
    if (h.payload[n].pack != h.payload[p].pack) return "the pack must be the parent's";
    return {};
}

Fault checkNumbers(const Hierarchy& h, NodeId n) {
    const Box3f& box = h.bounds[n];
    if (!finite(box.min) || !finite(box.max) || box.empty()) return "the bounds are empty or not finite";
    if (!notNegative(h.staticBenefit[n])) return "the benefit is negative or not finite";
    if (!notNegative(h.areaSquareMetres[n])) return "the area is negative or not finite";
    if (!notNegative(h.geometricErrorMetres[n])) return "the error is negative or not finite";
    if (!notNegative(h.borderErrorMetres[n])) return "the border error is negative or not finite";
    if (h.isLeaf(n) && h.geometricErrorMetres[n] != 0.0f) return "the error of a leaf must be 0";
    if (!(h.normalCoherence[n] >= 0.0f && h.normalCoherence[n] <= 1.0f))
        return "the coherence is not in [0, 1]";
    const glm::vec3& normal = h.averageNormal[n];
    if (!finite(normal)) return "the average normal is not finite";
    const bool none = normal.x == 0.0f && normal.y == 0.0f && normal.z == 0.0f;
    if (!none && std::abs(glm::length(normal) - 1.0f) > 1.0e-3f)
        return "the average normal is neither unit nor zero";
    return {};
}

bool textureClass(std::uint32_t side) {
    return side <= kMaxTextureSide && atlasSide(side) == side;
}

Fault checkCounts(const Hierarchy& h, NodeId n) {
    const std::uint64_t triangles = std::uint64_t{h.texturedTriangles[n]} + h.untexturedTriangles[n];
    if (triangles > kMaxNodeTriangles)
        return "there are more triangles than " + std::to_string(kMaxNodeTriangles);
    if (h.skirtTriangles[n] > triangles) return "there are more skirts than triangles";
    if (h.vertices[n] > kMaxNodeVertices)
        return "there are more vertices than " + std::to_string(kMaxNodeVertices);
    const bool textured = h.textureWidth[n] != 0 || h.textureHeight[n] != 0;
    if (textured && (!textureClass(h.textureWidth[n]) || !textureClass(h.textureHeight[n]))) {
        return "a texture side is neither 2^k nor 3 * 2^(k-1), or out of range";
    }
    return {};
}

Fault checkNode(const Hierarchy& h, NodeId n, NodeId& next) {
    if (Fault fault = checkLinks(h, n, next); !fault.empty()) return fault;
    if (Fault fault = checkNumbers(h, n); !fault.empty()) return fault;
    if (Fault fault = checkCounts(h, n); !fault.empty()) return fault;
    return n < h.rootCount ? Fault() : checkAgainstParent(h, n);
}

}  // namespace

Result<void> checkHierarchy(const Hierarchy& h) {
    if (h.parent.empty()) return failure({}, {}, "the hierarchy has no nodes");
    if (h.parent.size() > kMaxNodes)
        return failure({}, {}, "there are more nodes than " + std::to_string(kMaxNodes));
    if (!sameLengths(h)) return failure({}, {}, "the arrays of the hierarchy differ in length");
    if (h.rootCount == 0 || h.rootCount > h.size() || h.rootCount > kMaxBlocks) {
        return failure({}, {}, "the number of roots is out of range: " + std::to_string(h.rootCount));
    }
    if (h.grids.size() != h.rootCount || h.kinds.size() != h.rootCount) {
        return failure({}, {}, "each block must have one root, one grid and one kind");
    }
    for (std::size_t b = 0; b < h.grids.size(); ++b) {
        if (Fault fault = checkGrid(h.grids[b]); !fault.empty()) {
            return failure({}, "block " + std::to_string(b), std::move(fault));
        }
    }
    // Every node but a root lies among its parent's children, so in the end none is left over: next ==
    // h.size().
    NodeId next = h.rootCount;
    for (NodeId n = 0; n < h.size(); ++n) {
        if (Fault fault = checkNode(h, n, next); !fault.empty()) {
            return failure({}, "node " + std::to_string(n), std::move(fault));
        }
    }
    return {};
}

}  // namespace fb
