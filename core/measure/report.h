// What a replay writes (design section 7; the names are an interface): frames.csv, summary.json, plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "effects/effects.h"
#include "load/residency.h"
#include "measure/frame_record.h"

namespace fb {

struct ReplayReport {
    std::string version, scene, preset, policy, path, clock, device;
    std::uint64_t sceneHash = 0, settingsHash = 0;
    double targetMs = 0.0;
    int levels = 1;
    std::vector<FrameRecord> frames;
    LoadCounters loads;
    std::uint64_t budgetBytes = 0, peakBytes = 0;
    struct EffectUse {
        std::string name, mode;
        std::uint64_t activeFrames = 0;
        double meanUs = 0.0;
    };
    std::vector<EffectUse> effects;
};

[[nodiscard]] std::string framesCsv(const ReplayReport& report);
[[nodiscard]] std::string summaryJson(const ReplayReport& report);
// frames.csv, summary.json and plots/*.png, *.svg into `folder`.
[[nodiscard]] Result<void> writeReport(const ReplayReport& report, const std::filesystem::path& folder);

struct Distribution {
    double mean = 0, sd = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};
// Percentiles by nearest rank. All 0 for no values; values that are not finite are left out.
[[nodiscard]] Distribution describe(std::vector<double> values);

}  // namespace fb
