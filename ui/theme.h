// Colours, fonts and scale of the workbench.
#pragma once

namespace fb {

enum class Theme { dark, light };

// Sets Dear ImGui's style; `scale` multiplies all sizes.
void applyTheme(Theme theme, float scale);

}  // namespace fb
