// What commands without a window begin with: the clock, a scene, and a renderer where pictures or their times are wanted.
#pragma once

#include <memory>

#include "app/commands.h"
#include "app/workbench.h"
#include "draw/offscreen_context.h"

namespace fb {

// Takes the knobs and the clock of the options, before anything is opened. Returns the size of the picture.
[[nodiscard]] Result<glm::ivec2> takeOptions(Workbench& workbench, const HeadlessOptions& options);

// Opens the scene, or the built-in city where `scene` is empty, with the workbench's settings and clock. `context` must
// live longer than the workbench that draws with it.
[[nodiscard]] Result<void> openHeadless(Workbench& workbench, std::unique_ptr<OffscreenContext>& context,
                                        const std::filesystem::path& scene, bool pictures);

}  // namespace fb
