// Tuning: every knob of the table, live. A dot marks a value that differs from the loaded preset; the button beside it
// resets that one.
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/panels.h"

namespace fb {
namespace {

void tooltip(const Knob& knob) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(knob.path.c_str());
    ImGui::Separator();
    ImGui::TextWrapped("%.*s", static_cast<int>(knob.help.size()), knob.help.data());
    if (!knob.equation.empty()) {
        ImGui::TextDisabled("%.*s", static_cast<int>(knob.equation.size()), knob.equation.data());
    }
    if (knob.type == KnobType::real || knob.type == KnobType::integer) {
        ImGui::TextDisabled("range %s to %s %.*s, default %s", valueLabel(knob, knob.low).c_str(),
                            valueLabel(knob, knob.high).c_str(), static_cast<int>(knob.unit == "1" ? 0 : knob.unit.size()),
                            knob.unit.data(), valueLabel(knob, knob.initial).c_str());
    } else {
        ImGui::TextDisabled("default %s", valueLabel(knob, knob.initial).c_str());
    }
    if (knob.reruns == KnobReruns::build) ImGui::TextDisabled("takes effect when the scene is built again");
    ImGui::TextDisabled("Ctrl+click to type a number");
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool editNumber(const Knob& knob, double& value) {
    // Wide ranges are dragged in ratios. A logarithmic slider cannot start at 0.
    const bool wide = knob.low > 0.0 && knob.high / knob.low >= 1000.0;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    char format[48];
    const std::string unit = knob.unit == "1" || knob.unit.empty() ? "" : " " + std::string(knob.unit);
    std::string escaped;
    for (char c : unit) escaped += c == '%' ? "%%" : std::string(1, c);
    if (knob.type == KnobType::integer) {
        auto whole = static_cast<std::int64_t>(value);
        const auto low = static_cast<std::int64_t>(knob.low);
        const auto high = static_cast<std::int64_t>(knob.high);
        std::snprintf(format, sizeof format, "%%lld%s", escaped.c_str());
        const bool edited = ImGui::SliderScalar("##value", ImGuiDataType_S64, &whole, &low, &high, format, flags);
        value = static_cast<double>(whole);
        return edited;
    }
    std::snprintf(format, sizeof format, "%%.4g%s", escaped.c_str());
    // Ranges allow for the unusual; the slider covers what is usual, typing reaches the rest.
    const double usual = std::abs(knob.initial);
    const double low = wide ? std::max(knob.low, usual / 20.0) : knob.low;
    const double high = std::min(knob.high, wide ? 20.0 * usual : std::max(10.0 * usual, low + 1.0));
    const bool whole = low == knob.low && high == knob.high;
    return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, format,
                               flags & ~static_cast<int>(whole ? 0 : ImGuiSliderFlags_AlwaysClamp));
}

bool editChoice(const Knob& knob, double& value) {
    bool edited = false;
    if (!ImGui::BeginCombo("##value", valueLabel(knob, value).c_str())) return false;
    for (std::size_t i = 0; i < knob.choices.size(); ++i) {
        const std::string name(knob.choices[i]);
        const bool chosen = static_cast<double>(i) == value;
        if (ImGui::Selectable(name.c_str(), chosen)) {
            value = static_cast<double>(i);
            edited = true;
        }
    }
    ImGui::EndCombo();
    return edited;
}

void drawKnob(const UiInput& input, const Knob& knob, UiState& state, UiRequests& requests) {
    ImGui::PushID(knob.path.c_str());
    double value = knob.get(input.settings);
    const double reference = knob.get(input.reference);
    bool edited = false, typing = false;
    ImGui::SetNextItemWidth(0.52f * ImGui::GetContentRegionAvail().x);
    if (knob.type == KnobType::boolean) {
        bool on = value != 0.0;
        edited = ImGui::Checkbox("##value", &on);
        value = on ? 1.0 : 0.0;
        ImGui::SameLine(0.52f * ImGui::GetContentRegionAvail().x + ImGui::GetStyle().ItemSpacing.x);
    } else {
        edited = knob.type == KnobType::choice ? editChoice(knob, value) : editNumber(knob, value);
        typing = ImGui::TempInputIsActive(ImGui::GetID("##value"));
        ImGui::SameLine();
    }
    const bool hoveredValue = ImGui::IsItemHovered() && !ImGui::IsItemActive();
    if (edited) {
        if (typing) state.typed = KnobEdit{&knob, value};
        else requests.edits.push_back({&knob, value});
    }
    if (state.typed && state.typed->knob == &knob && !typing) {
        if (!edited) requests.edits.push_back(*state.typed);
        state.typed.reset();
    }

    const bool changed = knob.get(input.settings) != reference;
    if (changed) {
        if (ImGui::SmallButton("reset")) requests.edits.push_back({&knob, reference});
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to %s", valueLabel(knob, reference).c_str());
        ImGui::SameLine();
        ImGui::TextColored(ImVec4(0.95f, 0.65f, 0.15f, 1.0f), "*");
        ImGui::SameLine(0.0f, 2.0f);
    }
    const std::string_view name = knob.symbol.empty() ? knob.key : knob.symbol;
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    if (hoveredValue || ImGui::IsItemHovered()) tooltip(knob);
    ImGui::PopID();
}

bool matches(const Knob& knob, const std::string& search) {
    if (search.empty()) return true;
    const auto contains = [&](std::string_view text) {
        const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); };
        return std::search(text.begin(), text.end(), search.begin(), search.end(), same) != text.end();
    };
    return contains(knob.path) || contains(knob.symbol) || contains(knob.help);
}

std::string_view groupTitle(std::string_view group) {
    if (group == "build") return "Build";
    if (group == "select") return "Selection";
    if (group == "control") return "Feedback";
    if (group == "load") return "Loading and memory";
    if (group == "draw") return "Drawing";
    if (group == "model") return "Simulated device";
    if (group == "effects") return "Effects";
    return group;
}

}  // namespace

void drawTuningPanel(const UiInput& input, UiState& state, UiRequests& requests) {
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("Reset all").x - 4.0f * ImGui::GetStyle().FramePadding.x);
    ImGui::InputTextWithHint("##search", "search", &state.knobSearch);
    ImGui::SameLine();
    if (ImGui::Button("Reset all")) {
        for (const Knob& knob : knobs()) requests.edits.push_back({&knob, knob.get(input.reference)});
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("every knob back to preset %.*s", static_cast<int>(input.presetName.size()),
                          input.presetName.data());
    }
    ImGui::BeginChild("knobs");
    for (std::string_view group : knobGroups()) {
        if (group == "model") continue;  // of the model clock, which the window never runs on
        // What is rarely turned while walking starts closed.
        const bool open = group == "select" || group == "control" || group == "load" || group == "draw";
        const bool any = std::ranges::any_of(
            knobs(), [&](const Knob& k) { return k.group == group && matches(k, state.knobSearch); });
        if (!any) continue;
        ImGui::SetNextItemOpen(open || !state.knobSearch.empty(), state.knobSearch.empty() ? ImGuiCond_Once : ImGuiCond_Always);
        // Headers of a search are others than those that the user opens and closes.
        const char* id = state.knobSearch.empty() ? "" : "##search";
        if (!ImGui::CollapsingHeader((std::string(groupTitle(group)) + id).c_str())) continue;
        for (const Knob& knob : knobs()) {
            if (knob.group == group && matches(knob, state.knobSearch)) drawKnob(input, knob, state, requests);
        }
    }
    ImGui::EndChild();
}

}  // namespace fb
