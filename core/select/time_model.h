// What drawing is estimated to take: a node's time is linear in its triangles, and a frame has a part that no front
// changes. Comes from control/, which learns the coefficients from measured frames (algorithms 3.1); every policy reads
// it, whichever cost model stands behind it.
#pragma once

#include <algorithm>

#include "scenefile/hierarchy.h"

namespace fb {

struct TimeModel {
    double texturedMs = 0.0, untexturedMs = 0.0;  // per triangle
    double nodeMs = 0.0;                          // per node
    double leastMs = 0.0;                         // no node takes less
    double textureMsPerByte = 0.0;                // of textures, while they do not fit (effect texture_pressure)
    double fixedMs = 0.0;                         // of the frame: overhead, and filling the picture where that is known
    // The device's speed over seconds against its speed right now: 0.8 where the last frames were slow by a quarter.
    double slowRatio = 1.0;
    double residualMs = 0.0;  // by how much estimates are off these days
};

// The thesis's: v_time * cost for a node, O for the frame (thesis 4.2; algorithms 1).
[[nodiscard]] inline TimeModel timesByCost(double vTimeMs, double cTextured, double overheadMs) {
    TimeModel model;
    model.texturedMs = vTimeMs * cTextured;
    model.untexturedMs = vTimeMs * (1.0 - cTextured);
    model.leastMs = vTimeMs;  // cost >= 1
    model.fixedMs = overheadMs;
    return model;
}

// Always above 0: a need of 0 would make the ratio of a counter infinite (algorithms 5, case 1).
[[nodiscard]] inline double nodeTimeMs(const TimeModel& model, const Hierarchy& hierarchy, NodeId node) {
    constexpr double kSmallestMs = 1e-12;
    double ms = model.texturedMs * hierarchy.texturedTriangles[node] +
                model.untexturedMs * hierarchy.untexturedTriangles[node] + model.nodeMs;
    if (model.textureMsPerByte > 0.0) ms += model.textureMsPerByte * static_cast<double>(hierarchy.textureBytes(node));
    return std::max({kSmallestMs, model.leastMs, ms});
}

}  // namespace fb
