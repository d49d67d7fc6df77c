#include "app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>

#include "app/save_picture.h"
#include "ui/theme.h"

namespace fb {
namespace {

constexpr double kRadiansPerPixel = 0.003;
constexpr double kRollRadiansPerSecond = 1.0;
constexpr double kShiftFactor = 5.0;

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

float contentScale(GLFWwindow* window) {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(window, &x, &y);
    return std::clamp(x, 0.5f, 4.0f);
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(glm::ivec2 size, const char* title) {
    if (!glfwInit()) {
        return failure("window", {}, glfwReason(), "without a display use `frontbench replay`");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    std::unique_ptr<Window> window(new Window);
    window->window_ = glfwCreateWindow(size.x, size.y, title, nullptr, nullptr);
    if (!window->window_) {
        return failure("window", {}, glfwReason(), "the renderer needs OpenGL 4.5");
    }
    glfwMakeContextCurrent(window->window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window->window_, window.get());
    glfwSetDropCallback(window->window_, [](GLFWwindow* w, int count, const char** paths) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
        self->dropped_.assign(paths, paths + count);
    });
    // Before Dear ImGui's own, which call these on.
    glfwSetKeyCallback(window->window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
        if (action == GLFW_PRESS) self->keys_.push_back({key, modifiers});
    });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the workbench keeps its own session
    const float scale = contentScale(window->window_);
    loadFonts(scale);
    applyTheme(Theme::dark, scale);
    ImGui_ImplGlfw_InitForOpenGL(window->window_, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
    window->lastSeconds_ = glfwGetTime();
    return window;
}

Window::~Window() {
    if (window_) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        glfwDestroyWindow(window_);
    }
    glfwTerminate();
}

bool Window::shouldClose() const { return glfwWindowShouldClose(window_) != 0; }

double Window::beginFrame() {
    glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = std::clamp(io.DeltaTime, 1e-5f, 0.1f);
    io.DisplaySize = ImVec2(std::max(io.DisplaySize.x, 1.0f), std::max(io.DisplaySize.y, 1.0f));
    ImGui::NewFrame();
    const double now = glfwGetTime();
    const double dt = std::clamp(now - lastSeconds_, 1e-5, 0.1);
    lastSeconds_ = now;
    return dt;
}

void Window::endFrame() {
    ImGui::Render();
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window_);
}

Result<void> Window::saveScreenshot(const std::filesystem::path& file) {
    Image picture;
    glfwGetFramebufferSize(window_, &picture.width, &picture.height);
    picture.channels = 3;
    const std::size_t row = static_cast<std::size_t>(picture.width) * 3;
    picture.pixels.resize(row * static_cast<std::size_t>(picture.height));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());  // the picture before was given away by the swap
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(picture.height); top + 1 < bottom; ++top) {
        --bottom;
        std::swap_ranges(picture.pixels.begin() + static_cast<std::ptrdiff_t>(top * row),
                         picture.pixels.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                         picture.pixels.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    }
    return savePicture(picture, file);
}

void Window::updateGrab(bool viewHovered) {
    const auto pressed = [&](int button) { return glfwGetMouseButton(window_, button) == GLFW_PRESS; };
    const bool alt = glfwGetKey(window_, GLFW_KEY_LEFT_ALT) == GLFW_PRESS;
    if (grabbedButton_ >= 0) {
        if (!pressed(grabbedButton_)) grabbedButton_ = -1;
        return;
    }
    if (!viewHovered) return;
    if (pressed(GLFW_MOUSE_BUTTON_RIGHT)) grabbedButton_ = GLFW_MOUSE_BUTTON_RIGHT;
    else if (pressed(GLFW_MOUSE_BUTTON_MIDDLE)) grabbedButton_ = GLFW_MOUSE_BUTTON_MIDDLE;
    else if (alt && pressed(GLFW_MOUSE_BUTTON_LEFT)) grabbedButton_ = GLFW_MOUSE_BUTTON_LEFT;
    grabFresh_ = grabbedButton_ >= 0;
}

FlyInput Window::readFlyInput(bool viewHovered, double dtSeconds) {
    FlyInput input;
    updateGrab(viewHovered);
    glm::dvec2 mouse(0.0);
    glfwGetCursorPos(window_, &mouse.x, &mouse.y);
    const glm::dvec2 moved = grabFresh_ ? glm::dvec2(0.0) : mouse - lastMouse_;
    grabFresh_ = false;
    lastMouse_ = mouse;
    if (grabbedButton_ == GLFW_MOUSE_BUTTON_RIGHT) input.look = glm::dvec2(moved.x, -moved.y) * kRadiansPerPixel;
    if (grabbedButton_ == GLFW_MOUSE_BUTTON_LEFT) input.orbit = glm::dvec2(moved.x, -moved.y) * kRadiansPerPixel;
    if (grabbedButton_ == GLFW_MOUSE_BUTTON_MIDDLE) {
        const double height = std::max(1.0f, ImGui::GetIO().DisplaySize.y);
        input.pan = moved / height;
    }
    if (viewHovered) input.wheel = ImGui::GetIO().MouseWheel;
    if (ImGui::GetIO().WantTextInput || (!viewHovered && grabbedButton_ < 0)) return input;
    const auto key = [&](int code) { return glfwGetKey(window_, code) == GLFW_PRESS ? 1.0 : 0.0; };
    input.move = glm::dvec3(key(GLFW_KEY_D) - key(GLFW_KEY_A), key(GLFW_KEY_E) - key(GLFW_KEY_Q),
                            key(GLFW_KEY_W) - key(GLFW_KEY_S));
    if (key(GLFW_KEY_LEFT_SHIFT) > 0.0) input.move *= kShiftFactor;
    input.roll = (key(GLFW_KEY_T) - key(GLFW_KEY_R)) * kRollRadiansPerSecond * dtSeconds;
    return input;
}

std::vector<Window::KeyPress> Window::takeKeys() { return std::exchange(keys_, {}); }

std::vector<std::filesystem::path> Window::takeDropped() { return std::exchange(dropped_, {}); }

}  // namespace fb
