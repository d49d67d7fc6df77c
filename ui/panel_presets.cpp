// Presets: load one, see what differs from it, save your own.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels.h"

namespace fb {

void drawPresetsPanel(const UiInput& input, UiState& state, UiRequests& requests) {
    ImGui::TextDisabled("click to load");
    for (const PresetFile& file : input.presets) {
        const std::string text = file.name + (file.shipped ? "" : "  (yours)");
        if (ImGui::Selectable(text.c_str(), file.name == input.presetName)) requests.loadPreset = file.path.string();
    }
    ImGui::Separator();
    ImGui::SetNextItemWidth(12.0f * ImGui::GetFontSize());
    ImGui::InputTextWithHint("##name", "name", &state.presetToSave);
    ImGui::SameLine();
    if (ImGui::Button("Save")) requests.savePreset = state.presetToSave;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("into %s", userPresetFolder().c_str());
    ImGui::Separator();
    const std::vector<std::string> differences = presetDifferences(input.reference, input.settings);
    ImGui::TextDisabled("%zu knob%s from %.*s", differences.size(), differences.size() == 1 ? " differs" : "s differ", static_cast<int>(input.presetName.size()),
                        input.presetName.data());
    ImGui::BeginChild("differences");
    for (const std::string& line : differences) ImGui::TextWrapped("%s", line.c_str());
    ImGui::EndChild();
}

}  // namespace fb
