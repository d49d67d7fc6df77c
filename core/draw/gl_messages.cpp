#include "draw/gl_messages.h"

#include <epoxy/gl.h>

namespace fb {

namespace {

const char* errorName(GLenum error) {
    switch (error) {
        case GL_OUT_OF_MEMORY:
            return "the driver is out of memory";
        case GL_INVALID_ENUM:
            return "the driver refused a name (GL_INVALID_ENUM)";
        case GL_INVALID_VALUE:
            return "the driver refused a number (GL_INVALID_VALUE)";
        case GL_INVALID_OPERATION:
            return "the driver refused an operation (GL_INVALID_OPERATION)";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "the framebuffer is not complete";
        case GL_CONTEXT_LOST:
            return "the graphics context was lost";
        default:
            return "the driver reports an unknown error";
    }
}

void onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
               const void* user) {
    const bool grave = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                       (severity == GL_DEBUG_SEVERITY_HIGH && type != GL_DEBUG_TYPE_PERFORMANCE);
    if (!grave) return;
    // The driver keeps the pointer as const; the constructor gave it a listener that is not.
    auto* listener = static_cast<GlMessages*>(const_cast<void*>(user));
    listener->add(std::string(text, static_cast<std::size_t>(length < 0 ? 0 : length)));
}

}  // namespace

void clearGlErrors() {
    // A lost context may report its loss for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

Result<void> takeGlError(const std::string& while_) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return {};
    clearGlErrors();
    return failure("", "", std::string(errorName(error)) + " while " + while_,
                   error == GL_OUT_OF_MEMORY ? "lower load.budget" : "");
}

GlMessages::GlMessages() {
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    listening_ = (flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0;
    if (!listening_) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, this);
}

GlMessages::~GlMessages() {
    if (!listening_) return;
    glDebugMessageCallback(nullptr, nullptr);
    glDisable(GL_DEBUG_OUTPUT);
}

}  // namespace fb
