// What is drawn into: 8-bit colour and 32-bit float depth of the view's size. In: width and height. Out: a
// texture for the GUI and pixels for files and tests.
#pragma once

#include "base/result.h"
#include "draw/gl_objects.h"
#include "import/source_scene.h"

namespace fb {

class Picture {
  public:
    // Sides are brought into [1, what the driver takes]. Error: no memory; the picture stays as it was.
    [[nodiscard]] Result<void> resize(int width, int height);
    // Makes it the target of draws and clears it: depth to 0, which is infinitely far.
    void beginDrawing() const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] unsigned texture() const { return colour_.name(); }
    // RGB, row 0 at the top; waits for the GPU.
    [[nodiscard]] Image read() const;

  private:
    GlTexture colour_, depth_;
    GlFramebuffer framebuffer_;
    int width_ = 0, height_ = 0;
};

}  // namespace fb
