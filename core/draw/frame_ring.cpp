#include "draw/frame_ring.h"

#include <epoxy/gl.h>

#include <bit>

#include "base/check.h"
#include "draw/gl_messages.h"

namespace fb {

namespace {

// The greatest alignment that OpenGL lets a driver ask for uniform and storage buffers.
constexpr std::uint64_t kBindAlignBytes = 256;
constexpr std::uint64_t kSmallestPartBytes = 64 << 10;
constexpr GLbitfield kFrameMapping = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

}  // namespace

FrameRing::~FrameRing() {
    forgetFences();
}

void FrameRing::forgetFences() {
    for (void*& fence : fences_) {
        if (fence != nullptr) glDeleteSync(static_cast<GLsync>(fence));
        fence = nullptr;
    }
}

std::uint64_t FrameRing::roomFor(std::size_t count, std::size_t size) {
    return (count * size + kBindAlignBytes - 1) / kBindAlignBytes * kBindAlignBytes;
}

Result<void> FrameRing::begin(std::uint64_t bytes) {
    if (bytes > partBytes_) {
        const std::uint64_t partBytes = std::bit_ceil(std::max(bytes, kSmallestPartBytes));
        const auto size = static_cast<GLsizeiptr>(partBytes * kParts);
        GlBuffer larger = GlBuffer::make();
        clearGlErrors();
        glNamedBufferStorage(larger.name(), size, nullptr, kFrameMapping);
        if (auto made = takeGlError("making the frame buffer of " + std::to_string(size) + " bytes"); !made)
            return made;
        auto* mapped =
            static_cast<std::uint8_t*>(glMapNamedBufferRange(larger.name(), 0, size, kFrameMapping));
        if (mapped == nullptr) return failure("", "", "the driver does not map the frame buffer");
        // Draws under way keep the old buffer alive until they are done with it.
        buffer_ = std::move(larger);
        mapped_ = mapped;
        partBytes_ = partBytes;
        forgetFences();
    }
    part_ = (part_ + 1) % kParts;
    used_ = 0;
    if (void*& fence = fences_[part_]; fence != nullptr) {
        while (glClientWaitSync(static_cast<GLsync>(fence), GL_SYNC_FLUSH_COMMANDS_BIT, 1'000'000'000) ==
               GL_TIMEOUT_EXPIRED) {
        }
        glDeleteSync(static_cast<GLsync>(fence));
        fence = nullptr;
    }
    return {};
}

std::uint8_t* FrameRing::takeBytes(std::uint64_t bytes, std::uint64_t& offset) {
    const std::uint64_t room = roomFor(bytes, 1);
    FB_CHECK((used_ + room) <= partBytes_);
    offset = part_ * partBytes_ + used_;
    used_ += room;
    return mapped_ + offset;
}

void FrameRing::end() {
    fences_[part_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

}  // namespace fb
