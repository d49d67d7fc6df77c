// The numbers that shaders get: camera, light and sky of a frame, and where a block lies relative to the eye.
// In: View and the scene's up direction, in double precision. Out: floats relative to the eye, so that a
// scene far from its origin neither jitters nor cracks.
#pragma once

#include "select/view.h"
#include "shaders/shared.h"

namespace fb {

// `up` of length 0 or not finite counts as (0, 1, 0).
[[nodiscard]] gpu::FrameData frameData(const View& view, const glm::vec3& up);

// origin - eye as coarse + fine: the float nearest to it and what is missing. (position + coarse) + fine is
// then right to the last place of a distance from the eye, whatever the size of the block: near the eye
// position and coarse cancel, and floats within a factor of 2 of each other are subtracted exactly (Sterbenz
// 1974).
struct SplitTranslation {
    glm::vec3 coarse, fine;
};
[[nodiscard]] SplitTranslation splitTranslation(const glm::dvec3& origin, const glm::dvec3& eye);

}  // namespace fb
