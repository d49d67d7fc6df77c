// An OpenGL 4.5 core context without a window or a display server (EGL, surfaceless): headless replays and
// tests.
#pragma once

#include <memory>

#include "base/result.h"

namespace fb {

class OffscreenContext {
  public:
    // Makes the new context current on this thread. Error: no EGL device offers OpenGL 4.5.
    [[nodiscard]] static Result<std::unique_ptr<OffscreenContext>> create();
    virtual ~OffscreenContext() = default;
};

}  // namespace fb
