#include "ui/workbench_ui.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "ui/panels.h"

namespace fb {
namespace {

constexpr float kSplitter = 5.0f;
constexpr float kSmallestPane = 120.0f;

// A line between two panes that can be dragged. `share` is the part of `length` after the line.
void splitter(const char* id, ImGuiAxis axis, ImVec2 from, ImVec2 to, float length, float& share) {
    float after = share * length;
    float before = length - after;
    const ImRect line(from, to);
    ImGui::SplitterBehavior(line, ImGui::GetID(id), axis, &before, &after, kSmallestPane, kSmallestPane, 3.0f);
    if (length > 2.0f * kSmallestPane) share = std::clamp(after / length, 0.05f, 0.9f);
}

// The view reaches its pane's edges; text keeps a margin.
bool beginPane(const char* name, ImVec2 position, ImVec2 size, bool margin = true) {
    ImGui::SetCursorScreenPos(position);
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (!margin) return ImGui::BeginChild(name, size, false, flags);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(6.0f, 3.0f));
    const bool shown = ImGui::BeginChild(name, size, false, flags | ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    return shown;
}

void drawRightColumn(const UiInput& input, UiState& state, UiRequests& requests) {
    if (!ImGui::BeginTabBar("right")) return;
    if (ImGui::BeginTabItem("Tuning")) {
        drawTuningPanel(input, state, requests);
        ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Presets")) {
        drawPresetsPanel(input, state, requests);
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

void drawBottomRow(const UiInput& input, UiState& state, ImVec2 position, ImVec2 size) {
    const float rightWidth = state.timeShare * size.x;
    const float leftWidth = size.x - rightWidth - kSplitter;
    if (beginPane("time", position, ImVec2(leftWidth, size.y))) drawTimePanel(input, state);
    ImGui::EndChild();
    const ImVec2 line(position.x + leftWidth, position.y);
    splitter("time|levels", ImGuiAxis_X, line, ImVec2(line.x + kSplitter, line.y + size.y), size.x, state.timeShare);
    if (beginPane("levels", ImVec2(line.x + kSplitter, line.y), ImVec2(rightWidth, size.y))) drawLevelsPanel(input, state);
    ImGui::EndChild();
}

// View above Time and Levels on the left, Tuning and Presets on the right.
void drawTiles(const UiInput& input, UiState& state, UiRequests& requests, ImVec2 position, ImVec2 size) {
    const float rightWidth = state.rightShare * size.x;
    const float leftWidth = size.x - rightWidth - kSplitter;
    const float bottomHeight = state.bottomShare * size.y;
    const float topHeight = size.y - bottomHeight - kSplitter;

    if (beginPane("view", position, ImVec2(leftWidth, topHeight), false)) drawViewPanel(input, state, requests);
    ImGui::EndChild();
    const ImVec2 lineY(position.x, position.y + topHeight);
    splitter("view|plots", ImGuiAxis_Y, lineY, ImVec2(lineY.x + leftWidth, lineY.y + kSplitter), size.y,
             state.bottomShare);
    drawBottomRow(input, state, ImVec2(lineY.x, lineY.y + kSplitter), ImVec2(leftWidth, bottomHeight));
    const ImVec2 lineX(position.x + leftWidth, position.y);
    splitter("view|tuning", ImGuiAxis_X, lineX, ImVec2(lineX.x + kSplitter, lineX.y + size.y), size.x,
             state.rightShare);
    if (beginPane("right", ImVec2(lineX.x + kSplitter, lineX.y), ImVec2(rightWidth, size.y))) {
        drawRightColumn(input, state, requests);
    }
    ImGui::EndChild();
}

}  // namespace

void drawWorkbenchUi(const UiInput& input, UiState& state, UiRequests& requests) {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
    ImGui::Begin("workbench", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    const float barHeight = ImGui::GetFrameHeight();
    const ImVec2 tiles(io.DisplaySize.x, std::max(io.DisplaySize.y - barHeight, 1.0f));
    if (state.hidden) {
        if (beginPane("view", ImVec2(0.0f, 0.0f), tiles, false)) drawViewPanel(input, state, requests);
        ImGui::EndChild();
    } else {
        drawTiles(input, state, requests, ImVec2(0.0f, 0.0f), tiles);
    }
    if (beginPane("status", ImVec2(0.0f, tiles.y), ImVec2(tiles.x, barHeight), false)) drawStatusBar(input);
    ImGui::EndChild();
    ImGui::End();
}

}  // namespace fb
