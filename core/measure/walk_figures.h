// What a walk comes to in a few figures: of summary.json and of the table that `compare` prints. Their definitions are in
// report.h.
#pragma once

#include <optional>
#include <vector>

#include "measure/frame_record.h"
#include "measure/report.h"

namespace fb {

// One value a frame.
template <class Value>
[[nodiscard]] std::vector<double> collect(const std::vector<FrameRecord>& frames, const Value& value) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const FrameRecord& frame : frames) values.push_back(static_cast<double>(value(frame)));
    return values;
}
template <class Member>
[[nodiscard]] std::vector<double> collect(const std::vector<FrameRecord>& frames, Member FrameRecord::*member) {
    return collect(frames, [member](const FrameRecord& frame) { return frame.*member; });
}

struct ToggleFigures {
    std::uint64_t up = 0, down = 0, pingPongs = 0;
    double perFrame = 0.0;
};

[[nodiscard]] std::optional<double> utilisation(const std::vector<FrameRecord>& frames);
[[nodiscard]] double overTargetPercent(const std::vector<FrameRecord>& frames);
[[nodiscard]] std::optional<Distribution> estimateErrorPercent(const std::vector<FrameRecord>& frames);
[[nodiscard]] ToggleFigures toggleFigures(const std::vector<FrameRecord>& frames);

}  // namespace fb
