#include "select/priority.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

constexpr double kSmallestPriority = 1e-12;
constexpr double kSmallestForeshortening = 0.05;

double foreshortening(const Hierarchy& hierarchy, NodeId node, const View& view, double cFore) {
    // From the scene to the viewer; with +forward a facing wall would matter least (algorithms 2 item 2).
    const double facing = glm::dot(-view.forward, glm::dvec3(hierarchy.averageNormal[node]));
    return std::max(kSmallestForeshortening, 1.0 + cFore * facing);
}

}  // namespace

glm::dvec3 predictedEye(const View& view, const SelectSettings& settings, const ActiveEffects& effects) {
    return effects[Effect::velocityLead] ? view.camera.eye + settings.lookAhead * view.velocity : view.camera.eye;
}

NodeView lookAtNode(const Hierarchy& hierarchy, NodeId node, const View& view, const SelectSettings& settings,
                    const ActiveEffects& effects, EffectWork& work) {
    const Box3f& box = hierarchy.bounds[node];
    NodeView seen;
    const double outside = outsideDistance(view, box);
    seen.visible = outside <= 0.0;

    if (effects[Effect::velocityLead]) ++work[Effect::velocityLead];
    const glm::dvec3 eye = predictedEye(view, settings, effects);
    const Box3d exact{glm::dvec3(box.min), glm::dvec3(box.max)};
    seen.distance = std::max(settings.minDistance, exact.distance(eye));

    seen.frustumVisibility = seen.visible ? 1.0 : 0.0;
    if (!seen.visible && effects[Effect::frustumFalloff]) {
        ++work[Effect::frustumFalloff];
        seen.frustumVisibility = std::max(0.0, 1.0 - outside / settings.frustumFalloff);
    }
    const double visibility = 1.0 + settings.cVis * seen.frustumVisibility;
    double fore = 1.0;
    if (effects[Effect::foreshortening]) {
        ++work[Effect::foreshortening];
        fore = foreshortening(hierarchy, node, view, settings.cFore);
    }
    const double cost = nodeCost(hierarchy, node, settings.cTextured);
    seen.priority =
        hierarchy.staticBenefit[node] * visibility * fore / (cost * seen.distance * seen.distance);
    if (!(seen.priority > 0.0) || !std::isfinite(seen.priority)) {
        seen.priority = kSmallestPriority;
        seen.repaired = true;
    }
    return seen;
}

}  // namespace fb
