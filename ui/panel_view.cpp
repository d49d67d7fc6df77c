// The view: the drawn scene, the legend of what its colours show, and what is being played.
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "ui/panels.h"

namespace fb {
namespace {

void drawToolbar(const UiInput& input, UiRequests& requests) {
    const bool flying = input.playingPath.empty();
    ImGui::SetNextItemWidth(9.0f * ImGui::GetFontSize());
    const std::string current = flying ? "free flight" : std::string(input.playingPath);
    if (ImGui::BeginCombo("##path", current.c_str())) {
        if (ImGui::Selectable("free flight", flying)) requests.playPath = "";
        for (std::string_view name : input.pathNames) {
            const std::string text(name);
            if (ImGui::Selectable(text.c_str(), name == input.playingPath)) requests.playPath = text;
        }
        ImGui::EndCombo();
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Who moves the camera: you, or a path. Moving takes it back.");
    ImGui::SameLine();
    ImGui::TextDisabled("%.3g m/s   right mouse: look   WASD QE: move   R T: roll   wheel: speed   Home: whole scene",
                        input.speedMetresPerSecond);
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Alt + left mouse: orbit   middle mouse: pan   Shift: five times as fast\n"
                          "Tab: hide the panels   F12: save the window as PNG   Ctrl+Q: quit");
    }
}

void drawLegend(const UiInput& input, ImVec2 corner) {
    if (input.settings.draw.colour != ColourMode::level || !input.scene) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const int levels = shownLevels(*input.scene);
    const float width = ImGui::CalcTextSize("level 00 (coarse)").x + 34.0f;
    const ImVec2 end(corner.x + width, corner.y + line * static_cast<float>(levels) + 8.0f);
    list->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_PopupBg), 4.0f);
    for (int level = 0; level < levels; ++level) {
        const glm::vec3& c = input.levelColours[static_cast<std::size_t>(level)];
        const ImVec2 at(corner.x + 6.0f, corner.y + 4.0f + line * static_cast<float>(level));
        list->AddRectFilled(at, ImVec2(at.x + 16.0f, at.y + line - 5.0f),
                            ImGui::ColorConvertFloat4ToU32(ImVec4(c.x, c.y, c.z, 1.0f)));
        char text[32];
        std::snprintf(text, sizeof text, "level %d%s", level, level == 0 ? " (coarse)" : "");
        list->AddText(ImVec2(at.x + 22.0f, at.y), ImGui::GetColorU32(ImGuiCol_Text), text);
    }
}

void drawWork(const WorkProgress& work, UiRequests& requests) {
    ImGui::Dummy(ImVec2(0.0f, 0.3f * ImGui::GetContentRegionAvail().y));
    const float indent = 0.2f * ImGui::GetContentRegionAvail().x;
    ImGui::Indent(indent);
    ImGui::TextUnformatted(work.title.c_str());
    char text[96];
    if (work.secondsLeft >= 0.0) {
        std::snprintf(text, sizeof text, "%s %.0f %%, %.0f s left", work.phase.c_str(), 100.0 * work.fraction,
                      work.secondsLeft);
    } else {
        std::snprintf(text, sizeof text, "%s %.0f %%", work.phase.c_str(), 100.0 * work.fraction);
    }
    ImGui::ProgressBar(static_cast<float>(work.fraction), ImVec2(ImGui::GetContentRegionAvail().x - indent, 0.0f), text);
    if (ImGui::Button("Cancel")) requests.cancelWork = true;
    ImGui::SameLine();
    ImGui::TextDisabled("what is finished is kept; building again goes on from there");
    ImGui::Unindent(indent);
}

}  // namespace

void drawViewPanel(const UiInput& input, UiState& state, UiRequests& requests) {
    if (!state.hidden) drawToolbar(input, requests);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    requests.viewSize = glm::ivec2(std::max(1, static_cast<int>(room.x)), std::max(1, static_cast<int>(room.y)));
    if (input.work) {
        drawWork(*input.work, requests);
        return;
    }
    if (!input.scene) {
        ImGui::TextDisabled("Nothing is open. Start the program with a scene or with mesh files, or drop them here.");
        return;
    }
    // GL pictures have their first row at the bottom.
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(input.pictureTexture)), room, ImVec2(0.0f, 1.0f),
                 ImVec2(1.0f, 0.0f));
    requests.viewHovered = ImGui::IsItemHovered();
    drawLegend(input, ImVec2(corner.x + 10.0f, corner.y + 10.0f));
}

}  // namespace fb
