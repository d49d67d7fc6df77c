// frames.csv: the columns are an interface (design section 7): add, never rename.
#include <algorithm>
#include <array>

#include "base/hash.h"
#include "measure/number_text.h"
#include "measure/report.h"

namespace fb {
namespace {

struct Column {
    std::string_view name;
    void (*append)(std::string& text, const FrameRecord& frame);
};

template <auto kMember>
constexpr Column column(std::string_view name) {
    return {name, [](std::string& text, const FrameRecord& frame) { appendNumber(text, frame.*kMember); }};
}
template <int kAxis>
constexpr Column eyeColumn(std::string_view name) {
    return {name, [](std::string& text, const FrameRecord& frame) { appendNumber(text, frame.eye[kAxis]); }};
}
template <BoundBy kReason>
constexpr Column boundColumn(std::string_view name) {
    return {name, [](std::string& text, const FrameRecord& frame) {
                appendNumber(text, frame.boundBy[static_cast<std::size_t>(kReason)]);
            }};
}

using R = FrameRecord;
constexpr std::array kBeforeLevels = {column<&R::frame>("frame"),
                                      column<&R::timeSeconds>("t_s"),
                                      column<&R::dtMs>("dt_ms"),
                                      eyeColumn<0>("cam_x"),
                                      eyeColumn<1>("cam_y"),
                                      eyeColumn<2>("cam_z"),
                                      column<&R::speedMetresPerSecond>("speed_mps"),
                                      column<&R::targetMs>("target_ms"),
                                      column<&R::actualMs>("actual_ms"),
                                      column<&R::estimateMs>("estimate_ms"),
                                      column<&R::overheadMs>("overhead_ms"),
                                      column<&R::vTimeMs>("v_time"),
                                      column<&R::shareMs>("share_ms"),
                                      column<&R::frontNodes>("front_nodes")};
constexpr std::array kAfterLevels = {
    column<&R::triangles>("triangles"),
    column<&R::visited>("visited"),
    column<&R::togglesUp>("toggles_up"),
    column<&R::togglesDown>("toggles_down"),
    column<&R::pingPongs>("pingpong"),
    column<&R::selectUs>("select_us"),
    column<&R::uploadBytes>("upload_bytes"),
    column<&R::residentBytes>("resident_bytes"),
    column<&R::budgetBytes>("budget_bytes"),
    column<&R::pendingLoads>("pending_loads"),
    column<&R::evictions>("evictions"),
    column<&R::errorPixelsMax>("err_px_max"),
    column<&R::errorPixelsMean>("err_px_mean"),
    boundColumn<BoundBy::time>("bound_by_time"),
    boundColumn<BoundBy::load>("bound_by_load"),
    boundColumn<BoundBy::hysteresis>("bound_by_hysteresis"),
    boundColumn<BoundBy::leaf>("bound_by_leaf"),
    boundColumn<BoundBy::memory>("bound_by_memory"),
    Column{"front_hash", [](std::string& text, const R& frame) { text += hashText(frame.frontHash); }},
    boundColumn<BoundBy::view>("bound_by_view"),
    boundColumn<BoundBy::policy>("bound_by_policy"),
    column<&R::refusedGroups>("refused_groups"),
    column<&R::refusedNeedMs>("refused_need_ms"),
    column<&R::skippedRoots>("skipped_roots"),
    column<&R::fixedMs>("fixed_ms"),
    column<&R::reservedBytes>("reserved_bytes"),
    column<&R::textureBytes>("texture_bytes"),
    column<&R::estimateBytes>("estimate_bytes")};

}  // namespace

std::string framesCsv(const ReplayReport& report) {
    const int levels = std::clamp(report.levels, 1, kMaxLevels);
    std::string text;
    text.reserve((report.frames.size() + 1) * 320);
    for (const Column& c : kBeforeLevels) text += std::string(c.name) + ",";
    for (int level = 0; level < levels; ++level) text += "level" + std::to_string(level) + ",";
    for (const Column& c : kAfterLevels) text += std::string(c.name) + ",";
    text.back() = '\n';

    for (const FrameRecord& frame : report.frames) {
        for (const Column& c : kBeforeLevels) {
            c.append(text, frame);
            text += ',';
        }
        for (int level = 0; level < levels; ++level) {
            appendNumber(text, frame.levels[static_cast<std::size_t>(level)]);
            text += ',';
        }
        for (const Column& c : kAfterLevels) {
            c.append(text, frame);
            text += ',';
        }
        text.back() = '\n';
    }
    return text;
}

}  // namespace fb
