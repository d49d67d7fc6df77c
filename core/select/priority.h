// The thesis's priority of a node: benefit over cost, from the camera of this frame (thesis 4.2, algorithms 2 item 2).
// Used by the lakhia policies for time slices and by the loader for what to load and unload.
#pragma once

#include "effects/effects.h"
#include "scenefile/hierarchy.h"
#include "select/view.h"
#include "settings/settings.h"

namespace fb {

struct NodeView {
    double priority = 0.0;    // staticBenefit * vis * fore / (cost * d^2); always finite and > 0
    double distance = 0.0;    // metres, at least d_min
    double frustumVisibility = 0.0;  // 1 where it meets the view, less beside it, with the effect frustum_falloff (thesis 4.2)
    bool visible = false;     // the node's box meets the view; its parent's visibility is the caller's business
    bool repaired = false;    // the formula gave no usable number and 1e-12 was taken (algorithms 5, case 4)
};

// Where the camera will be in look_ahead seconds, with the effect velocity_lead; else where it is.
[[nodiscard]] glm::dvec3 predictedEye(const View& view, const SelectSettings& settings, const ActiveEffects& effects);
[[nodiscard]] NodeView lookAtNode(const Hierarchy& hierarchy, NodeId node, const View& view,
                                  const SelectSettings& settings, const ActiveEffects& effects, EffectWork& work);

}  // namespace fb
