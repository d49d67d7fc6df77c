// The numbers that shaders get: camera, light and sky of a frame, and where a block lies relative to the eye.
// In: View and the scene's up direction, in double precision. Out: floats relative to the eye, so that a scene far from
// its origin neither jitters nor cracks.
#pragma once

#include <array>

#include "scenefile/hierarchy.h"
#include "select/view.h"
#include "shaders/shared.h"

namespace fb {

// `up` of length 0 or not finite counts as (0, 1, 0).
[[nodiscard]] gpu::FrameData frameData(const View& view, const glm::vec3& up);

// origin - eye as coarse + fine. Coarse is a multiple of the grid's step, like every position, so position + coarse is
// exact within 2^24 steps of the eye and the final sum is rounded once: to half a unit in the last place of a distance
// from the eye, whatever the size of the block.
struct SplitTranslation {
    glm::vec3 coarse, fine;
};
[[nodiscard]] SplitTranslation splitTranslation(const BlockGrid& grid, const glm::dvec3& eye);

}  // namespace fb
