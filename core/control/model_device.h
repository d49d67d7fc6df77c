// The simulated device of --clock model (design section 11): a frame's time from counts of work, with hidden properties and
// seeded noise. The same inputs give the same times on every machine. A term whose knob is 0 does no work.
#pragma once

#include <cstdint>
#include <span>

#include "scenefile/hierarchy.h"
#include "settings/settings.h"

namespace fb {

struct FrameWork {
    double texturedTriangles = 0.0, untexturedTriangles = 0.0;  // hidden factors of the nodes included
    std::uint64_t nodes = 0;
    double megapixels = 0.0;  // filled
    double uploadMiB = 0.0;
    double textureMiB = 0.0;  // drawn beyond what the device holds
};

// How often each term's own arithmetic ran.
struct ModelCounts {
    std::uint64_t spread = 0, textures = 0, drift = 0, noise = 0, stall = 0;
};

// The work of drawing a front. `megapixels` in front of the roots.
[[nodiscard]] FrameWork modelWork(const ModelSettings& settings, const Hierarchy& hierarchy, std::span<const NodeId> front,
                                  double megapixels, std::uint64_t uploadBytes, ModelCounts& counts);

// What the work adds to the overhead on a device at its usual speed.
[[nodiscard]] double modelDrawMs(const ModelSettings& settings, const FrameWork& work);

// Drift, noise and stalls depend on the seed and the frame number alone, never on what was drawn before.
[[nodiscard]] double modelFrameMs(const ModelSettings& settings, const FrameWork& work, std::uint64_t frame,
                                  ModelCounts& counts);

}  // namespace fb
