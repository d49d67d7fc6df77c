// One frame's numbers: gathered once, shown by the panels, frames.csv and summary.json alike. No number exists only on
// screen. Names and units are those of design section 7.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "select/select.h"

namespace fb {

// Levels that are told apart; deeper ones count with the last.
inline constexpr int kMaxLevels = 16;

struct FrameRecord {
    std::uint64_t frame = 0;
    double timeSeconds = 0.0, dtMs = 0.0;
    glm::dvec3 eye{0.0};
    double speedMetresPerSecond = 0.0;
    double targetMs = 0.0, actualMs = 0.0, estimateMs = 0.0, overheadMs = 0.0;
    double vTimeMs = 0.0, shareMs = 0.0;
    double fixedMs = 0.0;     // of the estimate: what no front changes
    double megapixels = 0.0;  // of the picture in front of the roots; 0 where fill is not counted
    std::uint32_t frontNodes = 0;
    std::array<std::uint32_t, kMaxLevels> levels{};  // front nodes by level
    std::uint64_t triangles = 0;
    std::uint32_t visited = 0, togglesUp = 0, togglesDown = 0, pingPongs = 0;
    std::uint32_t refusedGroups = 0, skippedRoots = 0;
    double refusedNeedMs = 0.0;  // what refining all that was refused would take
    EffectWork effectWork;
    double selectUs = 0.0;
    std::uint64_t uploadBytes = 0, residentBytes = 0, reservedBytes = 0, budgetBytes = 0;
    std::uint64_t textureBytes = 0;    // of residentBytes
    double estimateBytes = 0.0;        // of resident nodes by the thesis: c_memory * cost
    std::uint32_t pendingLoads = 0, evictions = 0;
    double errorPixelsMax = 0.0, errorPixelsMean = 0.0;  // screen-space error of the front, mean by area
    std::array<std::uint32_t, kBoundByCount> boundBy{};
    bool infeasible = false;           // the roots alone take longer than the target
    bool moreDetailAvailable = false;  // something in the front could have been finer
    std::uint64_t effectsOn = 0;       // bit i: Effect i was active
    std::uint64_t frontHash = 0;       // chained over all frames so far
    // Main-thread stages in milliseconds, in the order of the frame: for the timing panel.
    double uploadMs = 0.0, planMs = 0.0, drawCpuMs = 0.0, uiMs = 0.0;
};

}  // namespace fb
