#include "measure/comparison.h"

#include <cstdio>

#include "measure/number_text.h"
#include "measure/walk_figures.h"

namespace fb {
namespace {

struct Figures {
    std::optional<double> utilisation;
    double p99OverTarget = 0.0, overTargetPercent = 0.0;
    ToggleFigures toggles;
    double errorPixels = 0.0, skippedRoots = 0.0, actualMs = 0.0, selectUs = 0.0;
    std::optional<Distribution> estimateError;
};

Figures figuresOf(const ComparedWalk& walk) {
    Figures f;
    const Distribution actual = describe(collect(walk.frames, &FrameRecord::actualMs));
    f.utilisation = utilisation(walk.frames);
    f.p99OverTarget = actual.p99 / walk.targetMs;
    f.overTargetPercent = overTargetPercent(walk.frames);
    f.toggles = toggleFigures(walk.frames);
    f.errorPixels = describe(collect(walk.frames, &FrameRecord::errorPixelsMean)).mean;
    f.skippedRoots = describe(collect(walk.frames, &FrameRecord::skippedRoots)).mean;
    f.actualMs = actual.mean;
    f.selectUs = describe(collect(walk.frames, &FrameRecord::selectUs)).mean;
    f.estimateError = estimateErrorPercent(walk.frames);
    return f;
}

void add(std::string& text, double value) {
    text += ',';
    appendNumber(text, value);
}

void addOptional(std::string& text, const std::optional<double>& value) {
    text += ',';
    if (value) appendNumber(text, *value);
}

}  // namespace

std::string comparisonCsv(const std::vector<ComparedWalk>& walks) {
    std::string text =
        "policy,path,target_ms,frames,utilisation,p99_over_target,over_target_pct,toggles_per_frame,pingpong,err_px_mean,"
        "skipped_roots,estimate_error_mean_pct,estimate_error_sd_pct,actual_ms_mean,select_us_mean\n";
    for (const ComparedWalk& walk : walks) {
        const Figures f = figuresOf(walk);
        text += walk.policy + "," + walk.path;
        add(text, walk.targetMs);
        add(text, static_cast<double>(walk.frames.size()));
        addOptional(text, f.utilisation);
        for (const double value : {f.p99OverTarget, f.overTargetPercent, f.toggles.perFrame,
                                   static_cast<double>(f.toggles.pingPongs), f.errorPixels, f.skippedRoots})
            add(text, value);
        addOptional(text, f.estimateError ? std::optional(f.estimateError->mean) : std::nullopt);
        addOptional(text, f.estimateError ? std::optional(f.estimateError->sd) : std::nullopt);
        add(text, f.actualMs);
        add(text, f.selectUs);
        text += '\n';
    }
    return text;
}

std::string comparisonTable(const std::vector<ComparedWalk>& walks) {
    std::string text;
    char line[256];
    const ComparedWalk* before = nullptr;
    for (const ComparedWalk& walk : walks) {
        if (!before || before->path != walk.path || before->targetMs != walk.targetMs) {
            std::snprintf(line, sizeof line, "%s%s, target %g ms\n%-24s %6s %6s %7s %9s %9s %8s %8s %7s  %s\n",
                          before ? "\n" : "", walk.path.c_str(), walk.targetMs, "", "use", "p99/T", "> 1.1 T",
                          "toggles/f", "pingpongs", "error px", "skipped", "us", "estimate %");
            text += line;
        }
        before = &walk;
        const Figures f = figuresOf(walk);
        const std::string use = f.utilisation ? fixedText(*f.utilisation, 3) : "-";
        const std::string estimate = f.estimateError ? fixedText(f.estimateError->mean, 1) + " +- " +
                                                           fixedText(f.estimateError->sd, 1)
                                                     : "-";
        std::snprintf(line, sizeof line, "%-24s %6s %6.3f %6.1f%% %9.4f %9llu %8.2f %8.2f %7.0f  %s\n", walk.policy.c_str(),
                      use.c_str(), f.p99OverTarget, f.overTargetPercent, f.toggles.perFrame,
                      static_cast<unsigned long long>(f.toggles.pingPongs), f.errorPixels, f.skippedRoots, f.selectUs,
                      estimate.c_str());
        text += line;
    }
    return text;
}

}  // namespace fb
