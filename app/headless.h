// What commands without a window begin with: the clock, a scene, and a renderer where pictures or their times are wanted.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/workbench.h"
#include "draw/offscreen_context.h"

namespace fb {

// "real" or "model"; wrong usage otherwise.
[[nodiscard]] Result<ClockKind> parseClock(const std::string& text);

// Opens the scene, or the built-in city where `scene` is empty, with the workbench's settings and clock. `context` must
// live longer than the workbench that draws with it.
[[nodiscard]] Result<void> openHeadless(Workbench& workbench, std::unique_ptr<OffscreenContext>& context,
                                        const std::filesystem::path& scene, bool pictures);

}  // namespace fb
