// summary.json: the names are an interface (design section 7): add, never rename. What they mean stands in
// report.h.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "measure/walk_figures.h"

namespace fb {
namespace {

using Json = nlohmann::ordered_json;

// null for what is not finite: JSON has no other word for it.
Json numberOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json actualOf(const std::vector<FrameRecord>& frames) {
    const Distribution d = describe(collect(frames, &FrameRecord::actualMs));
    return {{"mean", d.mean}, {"sd", d.sd}, {"p50", d.p50}, {"p95", d.p95}, {"p99", d.p99}, {"max", d.max}};
}

Json utilisationOf(const std::vector<FrameRecord>& frames) {
    const std::optional<double> mean = utilisation(frames);
    return mean ? Json(*mean) : Json(nullptr);
}

Json estimateErrorOf(const std::vector<FrameRecord>& frames) {
    const std::optional<Distribution> d = estimateErrorPercent(frames);
    if (!d) return {{"mean", nullptr}, {"sd", nullptr}, {"robust_sd", nullptr}};
    return {{"mean", d->mean}, {"sd", d->sd}, {"robust_sd", d->robustSd}};
}

Json togglesOf(const std::vector<FrameRecord>& frames) {
    const ToggleFigures t = toggleFigures(frames);
    return {{"up", t.up},
            {"down", t.down},
            {"per_frame", t.perFrame},
            {"frames_per_toggle", t.perFrame > 0.0 ? Json(1.0 / t.perFrame) : Json(nullptr)},
            {"pingpong", t.pingPongs}};
}

Json levelsShareOf(const std::vector<FrameRecord>& frames, int levels) {
    Json shares = Json::array();
    for (int level = 0; level < std::clamp(levels, 1, kMaxLevels); ++level) {
        std::vector<double> values;
        for (const FrameRecord& frame : frames) {
            if (frame.frontNodes == 0) continue;
            values.push_back(static_cast<double>(frame.levels[static_cast<std::size_t>(level)]) /
                             frame.frontNodes);
        }
        shares.push_back(describe(values).mean);
    }
    return shares;
}

// Of counts.
Json meanAndMax(const std::vector<double>& values) {
    const Distribution d = describe(values);
    return {{"mean", d.mean}, {"max", static_cast<std::uint64_t>(d.max)}};
}

std::uint64_t mostBytes(const std::vector<double>& values) {
    return static_cast<std::uint64_t>(describe(values).max);
}

Json memoryOf(const ReplayReport& report) {
    const auto over = [](const FrameRecord& frame) {
        return frame.residentBytes + frame.reservedBytes > frame.budgetBytes;
    };
    return {{"budget_bytes", report.budgetBytes},
            {"peak_bytes", report.peakBytes},
            {"over_budget_frames", std::ranges::count_if(report.frames, over)},
            {"pinned_bytes", report.pinnedBytes},
            {"texture_peak_bytes", mostBytes(collect(report.frames, &FrameRecord::textureBytes))},
            {"estimate_peak_bytes", mostBytes(collect(report.frames, &FrameRecord::estimateBytes))}};
}

Json prefetchOf(const PrefetchScore& score) {
    const double late = static_cast<double>(score.late);
    return {{"in_time", score.inTime},
            {"late", score.late},
            {"late_s_mean", numberOrNull(score.lateSeconds / late)},
            {"never_drawn", score.neverDrawn},
            {"wasted_bytes", score.wastedBytes},
            {"absent_node_frames", score.absentNodeFrames},
            {"reloads", score.reloads},
            {"most_loads_of_one", score.mostLoadsOfOne}};
}

Json errorPixelsOf(const std::vector<FrameRecord>& frames) {
    const Distribution worst = describe(collect(frames, &FrameRecord::errorPixelsMax));
    return {{"mean", describe(collect(frames, &FrameRecord::errorPixelsMean)).mean},
            {"p95", worst.p95},
            {"max", worst.max}};
}

Json imageOf(const ImageErrorSummary& image) {
    return {{"psnr_db", numberOrNull(image.psnrDb)},
            {"psnr_db_worst", numberOrNull(image.worstPsnrDb)},
            {"ssim", image.ssim},
            {"ssim_worst", image.worstSsim},
            {"pictures", image.pictures}};
}

Json effectsOf(const ReplayReport& report) {
    Json effects = Json::array();
    for (const ReplayReport::EffectUse& use : report.effects) {
        effects.push_back({{"name", use.name},
                           {"mode", use.mode},
                           {"active_frames", use.activeFrames},
                           {"us_mean", numberOrNull(use.meanUs)},
                           {"work", use.work}});
    }
    return effects;
}

Json faultsOf(const LoadCounters& loads) {
    Json faults;
    for (std::size_t i = 0; i < kLoadFaultCount; ++i) faults[std::string(kLoadFaultNames[i])] = loads.faults[i];
    faults["retried"] = loads.retried;
    faults["given_up_nodes"] = loads.givenUp;
    return faults;
}

}  // namespace

std::string summaryJson(const ReplayReport& report) {
    const std::vector<FrameRecord>& frames = report.frames;
    const Distribution selectUs = describe(collect(frames, &FrameRecord::selectUs));
    const LoadCounters& loads = report.loads;
    Json json;
    json["program"] = "frontbench";
    json["version"] = report.version;
    json["scene"] = report.scene;
    json["scene_hash"] = hashText(report.sceneHash);
    json["preset"] = report.preset;
    json["settings_hash"] = hashText(report.settingsHash);
    json["policy"] = report.policy;
    json["path"] = report.path;
    json["clock"] = report.clock;
    json["device"] = report.device;
    json["frames"] = frames.size();
    json["target_ms"] = numberOrNull(report.targetMs);
    json["actual_ms"] = actualOf(frames);
    json["infeasible_frames"] = std::ranges::count_if(frames, &FrameRecord::infeasible);
    json["utilisation"] = utilisationOf(frames);
    json["over_target_pct"] = overTargetPercent(frames);
    json["estimate_error_pct"] = estimateErrorOf(frames);
    json["toggles"] = togglesOf(frames);
    json["levels_share"] = levelsShareOf(frames, report.levels);
    json["front_nodes"] = meanAndMax(collect(frames, &FrameRecord::frontNodes));
    json["triangles"] = meanAndMax(collect(frames, &FrameRecord::triangles));
    json["select_us"] = {{"mean", selectUs.mean}, {"p99", selectUs.p99}};
    json["visited"] = meanAndMax(collect(frames, &FrameRecord::visited));
    json["memory"] = memoryOf(report);
    json["loads"] = {{"requested", loads.requested}, {"completed", loads.completed},
                     {"suspended", loads.suspended}, {"cancelled", loads.cancelled},
                     {"evicted", loads.evicted},     {"bytes", loads.bytes},
                     {"failed", loads.failed},       {"seeks", loads.seeks}};
    json["faults"] = faultsOf(loads);
    json["prefetch"] = prefetchOf(report.prefetch);
    json["skipped_roots"] = describe(collect(frames, &FrameRecord::skippedRoots)).mean;
    json["refused"] = {{"groups_mean", describe(collect(frames, &FrameRecord::refusedGroups)).mean},
                       {"need_ms_mean", describe(collect(frames, &FrameRecord::refusedNeedMs)).mean}};
    json["err_px"] = errorPixelsOf(frames);
    if (report.image) json["image"] = imageOf(*report.image);
    json["effects"] = effectsOf(report);
    json["front_hash"] = hashText(frames.empty() ? 0 : frames.back().frontHash);
    // Names of files need not be UTF-8, JSON is.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fb
