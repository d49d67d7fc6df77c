// What a replay writes (design section 7; the names are an interface): frames.csv, summary.json, plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "effects/effects.h"
#include "load/load_timeline.h"
#include "load/residency.h"
#include "measure/frame_record.h"
#include "measure/image_error.h"

namespace fb {

struct ReplayReport {
    std::string version, scene, preset, policy, path, clock, device;
    std::uint64_t sceneHash = 0, settingsHash = 0;
    double targetMs = 0.0;
    int levels = 1;
    std::vector<FrameRecord> frames;
    LoadCounters loads;
    std::uint64_t budgetBytes = 0, peakBytes = 0;
    std::uint64_t pinnedBytes = 0;  // of the roots
    PrefetchScore prefetch;
    std::string loadsCsv;  // see loads_csv.h
    struct EffectUse {
        std::string name, mode;
        std::uint64_t activeFrames = 0;
        double meanUs = 0.0;
        std::uint64_t work = 0;  // how often its own arithmetic ran, over all frames
    };
    std::vector<EffectUse> effects;
    std::optional<ImageErrorSummary> image;  // when pictures were compared with a reference
};

// Every frame counts, the first ones with their loading too: a report leaves nothing out.
// One row a frame. A number that is not finite is an empty field; front_hash is 16 hexadecimal digits.
[[nodiscard]] std::string framesCsv(const ReplayReport& report);
// What the names mean beyond design section 7. Every sd is that of all values (divided by n, not n - 1).
// - utilisation: mean of actual/target over frames with moreDetailAvailable; null where there are none
// - over_target_pct: 100 * frames with actual > 1.1 * target / frames
// - estimate_error_pct: of 100 * (actual - estimate) / actual over frames with actual > 0, so negative is
//   conservative (thesis 6.3); null where there are none. robust_sd: 1.4826 times the median distance from the median, which a
//   few stalls of the machine do not move
// - toggles.frames_per_toggle: frames / (up + down); null without toggles
// - levels_share: mean over the frames with a front of the share of its nodes on each level
// - memory.over_budget_frames: frames with resident + reserved > budget. pinned_bytes: of the roots, which always stay;
//   texture_peak_bytes: most of resident textures with mip levels; estimate_peak_bytes: of c_memory * cost, as the thesis counts
// - infeasible_frames: frames in which the roots alone were estimated to take longer than the target
// - err_px: mean of err_px_mean, p95 and max of err_px_max
// - skipped_roots: mean number of roots in view that were not drawn at all
// - prefetch: see PrefetchScore; late_s_mean: over the late ones, null where there are none
// - refused: mean number of loaded groups that were refused, and of the time that all that is refused would take
// - image: see ImageErrorSummary; a figure in decibels is null where all pictures are identical
// - front_hash: of the last frame
[[nodiscard]] std::string summaryJson(const ReplayReport& report);
// frames.csv, loads.csv, summary.json and plots/*.png, *.svg into `folder`, which is made if need be.
[[nodiscard]] Result<void> writeReport(const ReplayReport& report, const std::filesystem::path& folder);

struct Distribution {
    double mean = 0, sd = 0, robustSd = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};
// Percentiles by nearest rank: the smallest value that at least p % of the values do not exceed. sd of all
// values. All 0 for no values; values that are not finite are left out.
[[nodiscard]] Distribution describe(std::vector<double> values);

}  // namespace fb
