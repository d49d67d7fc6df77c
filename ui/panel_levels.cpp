// Levels: how many nodes of the front lie on each level of the hierarchy, over time (thesis figures 6.2 and 6.3).
#include <imgui.h>

#include "ui/panels.h"
#include "ui/plot.h"

namespace fb {

void drawLevelsPanel(const UiInput& input, UiState& state) {
    ImGui::TextUnformatted("Levels");
    if (!input.scene) return;
    const int levels = shownLevels(*input.scene);
    for (int level = 0; level < levels; ++level) {
        const glm::vec3& c = input.levelColours[static_cast<std::size_t>(level)];
        const std::uint32_t nodes =
            input.history.size() ? input.history.newest().levels[static_cast<std::size_t>(level)] : 0;
        ImGui::SameLine();
        ImGui::ColorButton("##level", ImVec4(c.x, c.y, c.z, 1.0f), ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoPicker,
                           ImVec2(0.8f * ImGui::GetFontSize(), 0.8f * ImGui::GetFontSize()));
        ImGui::SameLine(0.0f, 3.0f);
        ImGui::TextDisabled("%d: %u", level, nodes);
    }
    plotLevels("levels", input.history, input.levelColours, levels, state.shownSeconds);
}

}  // namespace fb
