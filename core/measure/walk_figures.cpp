#include "measure/walk_figures.h"

#include <algorithm>

namespace fb {

std::optional<double> utilisation(const std::vector<FrameRecord>& frames) {
    std::vector<double> ratios;
    for (const FrameRecord& frame : frames) {
        if (frame.moreDetailAvailable && frame.targetMs > 0.0)
            ratios.push_back(frame.actualMs / frame.targetMs);
    }
    if (ratios.empty()) return std::nullopt;
    return describe(std::move(ratios)).mean;
}

double overTargetPercent(const std::vector<FrameRecord>& frames) {
    const auto over = [](const FrameRecord& frame) { return frame.actualMs > 1.1 * frame.targetMs; };
    const auto count = static_cast<double>(std::ranges::count_if(frames, over));
    return frames.empty() ? 0.0 : 100.0 * count / static_cast<double>(frames.size());
}

std::optional<Distribution> estimateErrorPercent(const std::vector<FrameRecord>& frames) {
    std::vector<double> percents;
    for (const FrameRecord& frame : frames) {
        if (frame.actualMs > 0.0)
            percents.push_back(100.0 * (frame.actualMs - frame.estimateMs) / frame.actualMs);
    }
    if (percents.empty()) return std::nullopt;
    return describe(std::move(percents));
}

ToggleFigures toggleFigures(const std::vector<FrameRecord>& frames) {
    ToggleFigures figures;
    for (const FrameRecord& frame : frames) {
        figures.up += frame.togglesUp;
        figures.down += frame.togglesDown;
        figures.pingPongs += frame.pingPongs;
    }
    const auto toggles = static_cast<double>(figures.up + figures.down);
    if (!frames.empty()) figures.perFrame = toggles / static_cast<double>(frames.size());
    return figures;
}

}  // namespace fb
