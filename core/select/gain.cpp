#include "select/gain.h"

#include <algorithm>
#include <cmath>

#include "select/surface_distance.h"

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

ChildErrorGain::ChildErrorGain(const Hierarchy& h, NodeId parent, const View& view)
    : hierarchy_(h),
      pixelsPerUnit_(view.pixelsPerUnit),
      picture_(1.0 * view.width * view.height),
      diagonal_(std::hypot(view.width, view.height)),
      shape_(errorMetres(h, parent)),
      texel_(texelMetres(h, parent)),
      before_(shape_ + 0.5 * texel_) {}

// The bound of section 8, and of it the part by which a child is finer: next to the camera the bound is the whole picture
// for the parent and its children alike, and their difference would leave exactly those coarse.
double ChildErrorGain::of(NodeId child, double distance) const {
    if (!(before_ > 0.0)) return 0.0;
    const double scale = pixelsPerUnit_ / std::max(kNearestMetres, distance);
    const double pixels = std::min(picture_, static_cast<double>(hierarchy_.areaSquareMetres[child]) * scale * scale);
    const double bound = before_ * pixelsPerUnit_ / std::max(kNearestMetres, distance - before_);
    // A coarser texture does not undo a better shape.
    const double less = std::max(0.0, shape_ - errorMetres(hierarchy_, child)) +
                        0.5 * std::max(0.0, texel_ - texelMetres(hierarchy_, child));
    return pixels * std::min(diagonal_, bound) * less / before_;
}

double errorGain(const SelectInput& input, NodeId parent, const SelectState& state) {
    const Hierarchy& h = input.hierarchy;
    const ChildErrorGain child(h, parent, input.view);
    double gain = 0.0;
    for (const NodeId node : state.group) {
        gain += child.of(node, surfaceDistance(h, node, input.view.camera.eye));
    }
    return gain;
}

}  // namespace fb
