// Memory that the CPU writes and the GPU reads once a frame: camera, draw data, commands. One mapped buffer
// of three parts in turn, so that writing a frame never waits for the frame before. In: sizes. Out: places to
// write to.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "draw/gl_objects.h"

namespace fb {

class FrameRing {
  public:
    FrameRing() = default;
    ~FrameRing();
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;

    // Starts a frame that writes up to `bytes` (alignment included); makes the buffer larger where needed.
    // Error: no memory, or the driver does not map it; nothing may be written then.
    [[nodiscard]] Result<void> begin(std::uint64_t bytes);
    // Room for `count` things at a place that may be bound as uniform or storage buffer.
    template <class T>
    struct Place {
        std::span<T> items;
        std::uint64_t offsetBytes = 0;  // in buffer()
        [[nodiscard]] std::uint64_t sizeBytes() const { return items.size() * sizeof(T); }
    };
    template <class T>
    [[nodiscard]] Place<T> take(std::size_t count) {
        std::uint64_t offset = 0;
        auto* at = takeBytes(count * sizeof(T), offset);
        return {{reinterpret_cast<T*>(at), count}, offset};
    }
    // Every place of the frame has been handed to the GPU.
    void end();

    [[nodiscard]] unsigned buffer() const { return buffer_.name(); }
    // Bytes that `count` things of `size` bytes take at most.
    [[nodiscard]] static std::uint64_t roomFor(std::size_t count, std::size_t size);

  private:
    static constexpr std::size_t kParts = 3;
    [[nodiscard]] std::uint8_t* takeBytes(std::uint64_t bytes, std::uint64_t& offset);
    void forgetFences();

    GlBuffer buffer_;
    std::uint8_t* mapped_ = nullptr;
    std::uint64_t partBytes_ = 0, used_ = 0;
    std::size_t part_ = 0;
    std::array<void*, kParts> fences_{};  // GLsync, null: free
};

}  // namespace fb
