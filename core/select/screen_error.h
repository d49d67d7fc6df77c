// The screen-space error of a front: by how many pixels the drawn surface may lie beside the finest one.
// Geometric errors of the nodes and the view go in; err_px_max and err_px_mean of the frame come out. Runs
// after the selection. The bound is that of algorithms section 8: the usual eps*K/d understates it by up to
// 1/cos^2 of the half-diagonal field of view, because a length near the picture's corner covers more pixels,
// and because the surface may be eps nearer than the box.
#pragma once

#include <span>

#include "scenefile/hierarchy.h"
#include "select/view.h"

namespace fb {

struct FrontError {
    double maxPixels = 0.0;
    // By the pixels that a node's surface may cover: area * (K/d)^2, at most the whole picture.
    double meanPixels = 0.0;
};

// eps*K / ((d-eps) * cos^2 phi), where d is the distance to the box; 0 without geometric error. At most the
// diagonal of the picture, which it is where d <= eps: there the bound knows nothing.
[[nodiscard]] double nodeErrorPixels(const Hierarchy& hierarchy, NodeId node, const View& view);

// The pixels that a node's surface may cover: area * (K/d)^2, at most the whole picture.
[[nodiscard]] double coveredPixels(const Hierarchy& hierarchy, NodeId node, const View& view);
[[nodiscard]] FrontError frontError(const Hierarchy& hierarchy, std::span<const NodeId> front,
                                    const View& view);

}  // namespace fb
