// The simulated device of --clock model (design section 11): a frame's time from counts of work, with seeded noise.
// The same inputs give the same times on every machine.
#pragma once

#include <cstdint>

#include "settings/settings.h"

namespace fb {

struct FrameWork {
    std::uint64_t texturedTriangles = 0, untexturedTriangles = 0, nodes = 0;
};

// What the work adds to the overhead, without noise.
[[nodiscard]] double modelDrawMs(const ModelSettings& settings, const FrameWork& work);

// Noise depends on the seed and the frame number alone, never on what was drawn before.
[[nodiscard]] double modelFrameMs(const ModelSettings& settings, const FrameWork& work, std::uint64_t frame);

}  // namespace fb
