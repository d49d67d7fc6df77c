// What the selection knows of the camera: the predicted eye, the view's planes and its size in pixels. Made once a frame
// from Camera; used by every policy, the loader's priorities and the renderer's culling.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "base/bounds.h"
#include "base/camera.h"

namespace fb {

struct View {
    Camera camera;
    glm::dvec3 forward{0, 0, -1};
    glm::dvec3 velocity{0.0};  // m/s
    int width = 1, height = 1;
    double pixelsPerUnit = 1.0;  // pixels of a length of 1 m seen face on from 1 m: (H/2) / tan(fovy/2)
    // Left, right, bottom, top, near; normals point inward, unit length: inside where dot(xyz, p) + w >= 0.
    // Double precision: at 10 km from the origin a float plane is off by a centimetre.
    std::array<glm::dvec4, 5> planes;
};

[[nodiscard]] View makeView(const Camera& camera, const glm::dvec3& velocity, int width, int height);

// Distance in metres by which the box lies outside: the largest distance of the whole box behind one plane, 0 where it
// may meet the view (algorithms 2 item 2). Never 0 for a box behind a plane, may be 0 for one that is not visible.
[[nodiscard]] double outsideDistance(const View& view, const Box3f& box);
[[nodiscard]] inline bool meetsView(const View& view, const Box3f& box) { return outsideDistance(view, box) <= 0.0; }

}  // namespace fb
