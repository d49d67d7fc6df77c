// What must be remembered of a frame until its time is known, and where it is kept: timings may come late.
#pragma once

#include <array>
#include <cstdint>

#include "control/cost_fit.h"
#include "select/select.h"

namespace fb {

struct FrameFeatures {
    std::uint64_t frame = 0;
    double frontCost = 0.0;
    double fixedMs = 0.0;  // of the estimate: what v_time does not stand for
    double estimateMs = 0.0;
    std::uint64_t triangles = 0;
    WorkVector work{};
    std::uint32_t refusedGroups = 0;
    bool onlyRoots = false;      // the front holds nothing but roots
    bool shareFeedback = false;  // the effect shareFeedback was on
};

// Of the front that a selection chose. `megapixels` in front of the roots.
[[nodiscard]] FrameFeatures featuresOf(const SelectInput& input, const Selection& selection, double megapixels);

// Features of the last 16 frames, for timings that arrive late (GPU queries). Frames count from 1.
class FeatureRing {
  public:
    void push(const FrameFeatures& features);
    [[nodiscard]] const FrameFeatures* find(std::uint64_t frame) const;  // null when it is too old

  private:
    std::array<FrameFeatures, 16> ring_{};
};

}  // namespace fb
