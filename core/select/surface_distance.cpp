#include "select/surface_distance.h"

#include <algorithm>
#include <limits>

namespace fb {

double surfaceDistance(const Hierarchy& hierarchy, NodeId node, const glm::dvec3& eye) {
    const Box3f& box = hierarchy.bounds[node];
    const double outside = Box3d{glm::dvec3(box.min), glm::dvec3(box.max)}.distance(eye);
    if (outside > 0.0 || hierarchy.isLeaf(node)) return outside;
    double least = std::numeric_limits<double>::infinity();
    const NodeId first = hierarchy.firstChild[node], end = first + hierarchy.childCount[node];
    for (NodeId child = first; child < end && least > 0.0; ++child) {
        least = std::min(least, surfaceDistance(hierarchy, child, eye));
    }
    return least;
}

}  // namespace fb
