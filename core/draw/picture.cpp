#include "draw/picture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <vector>

#include "draw/gl_messages.h"

namespace fb {

Result<void> Picture::resize(int width, int height) {
    GLint mostTexels = 1, mostViewport[2] = {1, 1};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostTexels);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, mostViewport);
    width = std::clamp(width, 1, std::min(mostTexels, mostViewport[0]));
    height = std::clamp(height, 1, std::min(mostTexels, mostViewport[1]));
    if (width == width_ && height == height_) return {};

    Picture made;
    made.colour_ = GlTexture::make(unsigned{GL_TEXTURE_2D});
    made.depth_ = GlTexture::make(unsigned{GL_TEXTURE_2D});
    made.framebuffer_ = GlFramebuffer::make();
    clearGlErrors();
    glTextureStorage2D(made.colour_.name(), 1, GL_RGBA8, width, height);
    glTextureStorage2D(made.depth_.name(), 1, GL_DEPTH_COMPONENT32F, width, height);
    const std::string what = "making a picture of " + std::to_string(width) + " x " + std::to_string(height);
    if (auto stored = takeGlError(what); !stored) return stored;
    glTextureParameteri(made.colour_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(made.colour_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(made.colour_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glNamedFramebufferTexture(made.framebuffer_.name(), GL_COLOR_ATTACHMENT0, made.colour_.name(), 0);
    glNamedFramebufferTexture(made.framebuffer_.name(), GL_DEPTH_ATTACHMENT, made.depth_.name(), 0);
    if (glCheckNamedFramebufferStatus(made.framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return failure("", "", "the driver cannot draw into 8-bit colour with 32-bit float depth");
    }
    made.width_ = width;
    made.height_ = height;
    *this = std::move(made);
    return {};
}

void Picture::beginDrawing() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, height_);
    const GLfloat infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &infinitelyFar);
}

Image Picture::read() const {
    Image image;
    image.width = width_;
    image.height = height_;
    image.channels = 3;
    image.lossless = true;
    if (width_ == 0) return image;
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    // RGBA is what the picture holds: three channels would be converted by the driver, and rows padded to 4
    // bytes.
    std::vector<std::uint8_t> rgba(pixels * 4);
    glGetTextureImage(colour_.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()),
                      rgba.data());
    image.pixels.resize(pixels * 3);
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* from = rgba.data() + (height - 1 - y) * width * 4;
        std::uint8_t* into = image.pixels.data() + y * width * 3;
        for (std::size_t x = 0; x < width; ++x, from += 4, into += 3) std::copy_n(from, 3, into);
    }
    return image;
}

}  // namespace fb
