#include "ui/theme.h"

#include <imgui.h>

#include <filesystem>

namespace fb {

void applyTheme(Theme theme, float scale) {
    ImGuiStyle style;
    if (theme == Theme::dark) {
        ImGui::StyleColorsDark(&style);
    } else {
        ImGui::StyleColorsLight(&style);
    }
    style.WindowRounding = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

void loadFonts(float scale) {
    constexpr float kPixels = 15.0f;
    constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    // Latin, Greek, arrows, mathematical operators: pairs of first and last, ended by 0. The atlas is built later from
    // this very array.
    static constexpr ImWchar kRanges[] = {0x20, 0x17f, 0x370, 0x3ff, 0x2010, 0x2044, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};
    ImFontAtlas* fonts = ImGui::GetIO().Fonts;
    if (std::filesystem::exists(kFont) && fonts->AddFontFromFileTTF(kFont, kPixels * scale, nullptr, kRanges)) return;
    ImFontConfig config;
    config.SizePixels = 13.0f * scale;
    fonts->AddFontDefault(&config);
}

}  // namespace fb
