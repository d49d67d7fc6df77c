#include "select/gain.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

constexpr double kLeastShareGained = 0.02;  // of a child's benefit
constexpr double kNearestMetres = 1e-3;     // a distance counts as at least this

// Edge of a texel in metres; 0 without texture.
double texelMetres(const Hierarchy& h, NodeId n) {
    const double texels = 1.0 * h.textureWidth[n] * h.textureHeight[n];
    return texels > 0.0 ? std::sqrt(static_cast<double>(h.areaSquareMetres[n]) / texels) : 0.0;
}

double errorMetres(const Hierarchy& h, NodeId n) { return static_cast<double>(h.geometricErrorMetres[n]); }

}  // namespace

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

// The bound of section 8, and of it the part by which a child is finer: next to the camera the bound is the whole picture
// for the parent and its children alike, and their difference would leave exactly those coarse.
double childErrorGain(const Hierarchy& h, NodeId child, double distance, const View& view) {
    const NodeId parent = h.parent[child];
    const double texel = texelMetres(h, parent), before = errorMetres(h, parent) + 0.5 * texel;
    if (!(before > 0.0)) return 0.0;
    const double width = view.width, height = view.height;
    const double scale = view.pixelsPerUnit / std::max(kNearestMetres, distance);
    const double pixels = std::min(width * height, static_cast<double>(h.areaSquareMetres[child]) * scale * scale);
    const double bound = before * view.pixelsPerUnit / std::max(kNearestMetres, distance - before);
    // A coarser texture does not undo a better shape.
    const double less = std::max(0.0, errorMetres(h, parent) - errorMetres(h, child)) +
                        0.5 * std::max(0.0, texel - texelMetres(h, child));
    return pixels * std::min(std::hypot(width, height), bound) * less / before;
}

double errorGain(const SelectInput& input, const SelectState& state) {
    const Hierarchy& h = input.hierarchy;
    double gain = 0.0;
    for (const NodeId child : state.group) {
        const Box3d box{glm::dvec3(h.bounds[child].min), glm::dvec3(h.bounds[child].max)};
        gain += childErrorGain(h, child, box.distance(input.view.camera.eye), input.view);
    }
    return gain;
}

}  // namespace fb
