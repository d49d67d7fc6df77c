#include "select/slow_look.h"

#include <cmath>

namespace fb {

double slowDistance(const glm::dvec3& eye, const Box3f& box) {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.min[axis], high = box.max[axis];
        if (eye[axis] < low) squared += (low - eye[axis]) * (low - eye[axis]);
        if (eye[axis] > high) squared += (eye[axis] - high) * (eye[axis] - high);
    }
    return std::sqrt(squared);
}

// Of all nodes below, the nearest of those that are leaves or have the eye outside, while it is inside all above them.
double slowSurfaceDistance(const Hierarchy& h, NodeId node, const glm::dvec3& eye) {
    double nearest = INFINITY;
    for (NodeId n = node; n < h.size(); ++n) {
        bool counts = h.childCount[n] == 0 || slowDistance(eye, h.bounds[n]) > 0.0;
        NodeId up = n;
        while (up != node && up != kNoNode) {
            up = h.parent[up];
            if (up != kNoNode && slowDistance(eye, h.bounds[up]) > 0.0) counts = false;
        }
        if (counts && up == node) nearest = std::min(nearest, slowDistance(eye, h.bounds[n]));
    }
    return nearest;
}

double slowOutside(const View& view, const Box3f& box) {
    const double up = std::tan(view.camera.fovyRadians / 2.0);
    const double across = up * view.width / view.height;
    double leftOf = INFINITY, rightOf = INFINITY, below = INFINITY, above = INFINITY, before = INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        const glm::dvec3 q = glm::conjugate(view.camera.orientation) * (p - view.camera.eye);
        const double depth = -q.z;
        leftOf = std::min(leftOf, (-q.x - across * depth) / std::sqrt(1.0 + across * across));
        rightOf = std::min(rightOf, (q.x - across * depth) / std::sqrt(1.0 + across * across));
        below = std::min(below, (-q.y - up * depth) / std::sqrt(1.0 + up * up));
        above = std::min(above, (q.y - up * depth) / std::sqrt(1.0 + up * up));
        before = std::min(before, view.camera.nearMetres - depth);
    }
    return std::max({0.0, leftOf, rightOf, below, above, before});
}

double slowCost(const SelectInput& in, NodeId n) {
    const double w = in.settings.cTextured;
    return std::max(1.0,
                    in.hierarchy.texturedTriangles[n] * w + in.hierarchy.untexturedTriangles[n] * (1.0 - w));
}

double slowPriority(const SelectInput& in, NodeId n, double outside) {
    const SelectSettings& s = in.settings;
    glm::dvec3 eye = in.view.camera.eye;
    if (in.effects[Effect::velocityLead]) eye += s.lookAhead * in.view.velocity;
    const double d = std::max(s.minDistance, slowDistance(eye, in.hierarchy.bounds[n]));
    double fv = outside > 0.0 ? 0.0 : 1.0;
    if (outside > 0.0 && in.effects[Effect::frustumFalloff])
        fv = std::max(0.0, 1.0 - outside / s.frustumFalloff);
    double fore = 1.0;
    if (in.effects[Effect::foreshortening]) {
        const glm::vec3 a = in.hierarchy.averageNormal[n];
        const glm::dvec3 towardViewer = in.view.camera.orientation * glm::dvec3(0, 0, 1);
        fore = std::max(0.05,
                        1.0 + s.cFore * (towardViewer.x * a.x + towardViewer.y * a.y + towardViewer.z * a.z));
    }
    return in.hierarchy.staticBenefit[n] * (1.0 + s.cVis * fv) * fore / (slowCost(in, n) * d * d);
}

}  // namespace fb
