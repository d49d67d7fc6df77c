// Dear ImGui without a window: frames with injected mouse input, requests read back.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/workbench_ui.h"

namespace fb::test {

// A press and its release must come in different frames, as from real hands.
class HeadlessUi {
  public:
    HeadlessUi() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = ImVec2(1600.0f, 900.0f);
        io.DeltaTime = 1.0f / 60.0f;
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~HeadlessUi() { ImGui::DestroyContext(); }
    HeadlessUi(const HeadlessUi&) = delete;
    HeadlessUi& operator=(const HeadlessUi&) = delete;

    // One frame; what was asked for in it. Edits of knobs are applied as the program does.
    UiRequests frame() {
        UiRequests requests;
        ImGui::NewFrame();
        drawWorkbenchUi(input(), state, requests);
        ImGui::Render();
        for (const KnobEdit& edit : requests.edits) {
            if (!admit(settings, *edit.knob, edit.value, "test")) ++refused;
        }
        return requests;
    }
    void moveMouse(ImVec2 to) {
        ImGui::GetIO().MousePos = to;
        frame();
    }
    UiRequests press() {
        ImGui::GetIO().MouseDown[0] = true;
        return frame();
    }
    UiRequests release() {
        ImGui::GetIO().MouseDown[0] = false;
        return frame();
    }
    UiRequests click(ImVec2 at) {
        moveMouse(at);
        press();
        return release();
    }

    UiInput input() {
        return UiInput{settings, reference, "default", presets, paths,   {},  history, scene, work, message,
                       false,    0,         0,         10.0,    "a test", {}};
    }

    Settings settings, reference;
    std::vector<PresetFile> presets;
    std::vector<std::string_view> paths = {"walk", "fly"};
    History history;
    const Scene* scene = nullptr;
    std::optional<WorkProgress> work;
    std::string message;
    UiState state;
    int refused = 0;
};

}  // namespace fb::test
