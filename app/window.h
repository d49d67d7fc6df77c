// The window: GLFW, the OpenGL context, Dear ImGui's backends, input for the camera, screenshots.
#pragma once

#include <glm/glm.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/fly_camera.h"
#include "base/result.h"

struct GLFWwindow;

namespace fb {

class Window {
  public:
    // Errors: no display, no OpenGL 4.5.
    [[nodiscard]] static Result<std::unique_ptr<Window>> open(glm::ivec2 size, const char* title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] bool shouldClose() const;
    // Polls events and starts Dear ImGui's frame. Returns the seconds since the frame before, within [1e-5, 0.1]: Dear
    // ImGui stops the program on anything else.
    double beginFrame();
    // Draws Dear ImGui's frame and presents it.
    void endFrame();
    // Saves what the window shows; call between drawing and presenting, that is from endFrame's picture on.
    [[nodiscard]] Result<void> saveScreenshot(const std::filesystem::path& file);

    // Keys and mouse for the camera: the right or middle button, or Alt with the left one, must be pressed over the view.
    [[nodiscard]] FlyInput readFlyInput(bool viewHovered, double dtSeconds);
    [[nodiscard]] std::vector<std::filesystem::path> takeDropped();
    // Keys (GLFW_KEY_*) pressed since the last call with their modifiers, however short: what Dear ImGui 1.86 polls once a
    // frame misses a key that is pressed and released between two frames.
    struct KeyPress {
        int key = 0, modifiers = 0;
    };
    [[nodiscard]] std::vector<KeyPress> takeKeys();

  private:
    Window() = default;
    void updateGrab(bool viewHovered);

    GLFWwindow* window_ = nullptr;
    std::vector<std::filesystem::path> dropped_;
    std::vector<KeyPress> keys_;
    double lastSeconds_ = 0.0;
    glm::dvec2 lastMouse_{0.0};
    int grabbedButton_ = -1;
    bool grabFresh_ = false;  // the first movement after grabbing says nothing
};

}  // namespace fb
