#include "draw/offscreen_context.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace fb {

namespace {

class EglContext final : public OffscreenContext {
  public:
    explicit EglContext(EGLDisplay display) : display_(display) {}
    // The display stays open: a process has one for each device, and closing it would end every other context
    // on it.
    ~EglContext() override {
        if (context_ == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context_) {
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    // Null where the display does not give OpenGL 4.5 core without a surface; `why` then says what failed.
    [[nodiscard]] static std::unique_ptr<EglContext> open(EGLDisplay display, std::string& why) {
        if (display == EGL_NO_DISPLAY) return refuse(why, "no such display");
        EGLint major = 0, minor = 0;
        if (eglInitialize(display, &major, &minor) != EGL_TRUE) return refuse(why, "eglInitialize failed");
        auto context = std::make_unique<EglContext>(display);
        if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
            return refuse(why, "no contexts without a surface");
        }
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return refuse(why, "no OpenGL, only OpenGL ES");
        const EGLint configWishes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
        EGLConfig config = EGL_NO_CONFIG_KHR;
        EGLint configs = 0;
        if (eglChooseConfig(display, configWishes, &config, 1, &configs) != EGL_TRUE || configs < 1) {
            return refuse(why, "no usable configuration");
        }
        const EGLint wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifndef NDEBUG
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
#endif
                                 EGL_NONE};
        context->context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, wishes);
        if (context->context_ == EGL_NO_CONTEXT) return refuse(why, "no OpenGL 4.5 core");
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context_) != EGL_TRUE) {
            return refuse(why, "the context cannot be made current");
        }
        return context;
    }

  private:
    [[nodiscard]] static std::unique_ptr<EglContext> refuse(std::string& why, const char* reason) {
        why = reason;
        return nullptr;
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

// Devices with graphics hardware first: where Mesa's software device and a vendor's driver are both
// installed, the surfaceless platform would answer with the software device.
std::vector<EGLDeviceEXT> listDevices(bool software) {
    std::vector<EGLDeviceEXT> devices;
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
        return devices;
    }
    EGLint count = 0;
    if (eglQueryDevicesEXT(0, nullptr, &count) != EGL_TRUE || count <= 0) return devices;
    devices.resize(static_cast<std::size_t>(count));
    if (eglQueryDevicesEXT(count, devices.data(), &count) != EGL_TRUE) return {};
    devices.resize(static_cast<std::size_t>(std::max(count, 0)));
    const bool canAsk = epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query") ||
                        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base");
    std::erase_if(devices, [&](EGLDeviceEXT device) {
        const char* extensions = canAsk ? eglQueryDeviceStringEXT(device, EGL_EXTENSIONS) : nullptr;
        const bool isSoftware =
            extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
        return isSoftware != software;
    });
    return devices;
}

}  // namespace

Result<std::unique_ptr<OffscreenContext>> OffscreenContext::create() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        return failure("", "EGL", "the EGL library cannot open devices without a display server",
                       "install libegl1 and a driver (libegl-mesa0)");
    }
    std::string tried;
    std::unique_ptr<EglContext> context;
    const auto attempt = [&](EGLenum platform, void* native, const char* name) {
        if (context) return;
        std::string why;
        context = EglContext::open(eglGetPlatformDisplayEXT(platform, native, nullptr), why);
        if (!context) tried += (tried.empty() ? "" : "; ") + std::string(name) + ": " + why;
    };
    for (EGLDeviceEXT device : listDevices(false))
        attempt(EGL_PLATFORM_DEVICE_EXT, device, "graphics device");
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        attempt(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless");
    }
    for (EGLDeviceEXT device : listDevices(true)) attempt(EGL_PLATFORM_DEVICE_EXT, device, "software device");
    if (!context) {
        return failure("", "EGL",
                       "no device offers OpenGL 4.5 core (" + (tried.empty() ? "none found" : tried) + ")",
                       "install libegl-mesa0 and libgl1-mesa-dri, or a driver for the graphics card");
    }
    return std::unique_ptr<OffscreenContext>(std::move(context));
}

}  // namespace fb
