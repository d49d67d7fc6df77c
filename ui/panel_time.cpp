// Time: what a frame took, should take and was estimated to take; v_time and the share time.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/plot.h"

namespace fb {
namespace {

constexpr glm::vec3 kActual{0.34f, 0.71f, 0.91f};
constexpr glm::vec3 kEstimate{0.90f, 0.62f, 0.00f};
constexpr glm::vec3 kTarget{0.00f, 0.62f, 0.45f};
constexpr glm::vec3 kFeedback{0.80f, 0.47f, 0.65f};

constexpr PlotSeries kTimes[] = {
    {"actual", kActual, [](const FrameRecord& r) { return r.actualMs; }},
    {"estimate", kEstimate, [](const FrameRecord& r) { return r.estimateMs; }},
    {"target", kTarget, [](const FrameRecord& r) { return r.targetMs; }},
};
constexpr PlotSeries kVTime[] = {
    {"v_time", kFeedback, [](const FrameRecord& r) { return 1e6 * r.vTimeMs; }},
};

// Percentiles of the last frames by nearest rank.
struct Percentiles {
    double p50 = 0.0, p95 = 0.0, p99 = 0.0, missesPct = 0.0;
};
Percentiles percentiles(const History& history, std::vector<double>& times) {
    constexpr std::size_t kFrames = 300;
    times.clear();
    std::size_t misses = 0;
    for (std::size_t i = history.size() > kFrames ? history.size() - kFrames : 0; i < history.size(); ++i) {
        times.push_back(history[i].actualMs);
        misses += history[i].actualMs > 1.1 * history[i].targetMs ? 1 : 0;
    }
    if (times.empty()) return {};
    std::ranges::sort(times);
    const auto rank = [&times](double part) {
        const auto n = static_cast<double>(times.size());
        return times[static_cast<std::size_t>(std::clamp(std::ceil(part * n) - 1.0, 0.0, n - 1.0))];
    };
    return {rank(0.50), rank(0.95), rank(0.99), 100.0 * static_cast<double>(misses) / static_cast<double>(times.size())};
}

}  // namespace

void drawTimePanel(const UiInput& input, UiState& state) {
    ImGui::TextUnformatted("Time");
    ImGui::SameLine();
    const Percentiles p = percentiles(input.history, state.scratch);
    ImGui::TextDisabled("p50 %.1f  p95 %.1f  p99 %.1f ms   above 1.1 x target %.0f %%", p.p50, p.p95, p.p99, p.missesPct);
    ImGui::SameLine();
    ImGui::Checkbox("log", &state.logTime);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const double target = input.settings.control.targetMs;
    if (ImGui::BeginChild("times", ImVec2(0.0f, 0.66f * room.y))) {
        PlotOptions options;
        options.unit = "ms";
        options.shownSeconds = state.shownSeconds;
        options.logarithmic = state.logTime;
        options.atLeastHigh = 1.2 * target;
        options.band = PlotBand{input.settings.control.shareLow * target, input.settings.control.shareHigh * target, kTarget};
        plotLines("times", input.history, kTimes, options);
    }
    ImGui::EndChild();
    if (ImGui::BeginChild("v_time")) {
        PlotOptions options;
        options.unit = "ns per cost unit";
        options.shownSeconds = state.shownSeconds;
        plotLines("v_time", input.history, kVTime, options);
    }
    ImGui::EndChild();
}

}  // namespace fb
