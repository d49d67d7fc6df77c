// Walks held against each other: one line a policy, path and target (design section 6, `compare`).
#pragma once

#include <string>
#include <vector>

#include "measure/report.h"

namespace fb {

struct ComparedWalk {
    std::string policy, path;
    double targetMs = 0.0;
    std::vector<FrameRecord> frames;  // of all rounds
};

// compare.csv: policy,path,target_ms,frames,utilisation,p99_over_target,over_target_pct,toggles_per_frame,pingpong,
// err_px_mean,skipped_roots,estimate_error_mean_pct,estimate_error_sd_pct,actual_ms_mean,select_us_mean. Fields of which there
// is no value are empty.
[[nodiscard]] std::string comparisonCsv(const std::vector<ComparedWalk>& walks);
// The same for people: a block a path and target, a line a policy.
[[nodiscard]] std::string comparisonTable(const std::vector<ComparedWalk>& walks);

}  // namespace fb
