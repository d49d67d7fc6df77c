// Colours, fonts and scale of the workbench.
#pragma once

namespace fb {

enum class Theme { dark, light };

// Sets Dear ImGui's style; `scale` multiplies all sizes.
void applyTheme(Theme theme, float scale);

// DejaVu Sans with Latin, Greek and mathematical signs where it is installed, else the font that Dear ImGui brings.
void loadFonts(float scale);

}  // namespace fb
