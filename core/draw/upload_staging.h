// The way of bytes to the GPU. In: bytes of a mesh or texture. Out: copies queued on the GPU, in order with
// its draws. On a GPU the bytes go through a ring of mapped memory, so that neither the driver nor this
// thread waits; a software rasteriser copies straight from the caller's memory, which is up to twice as fast
// there (256 x 256 with mips: 12 against 17 us on llvmpipe).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "draw/gl_objects.h"

namespace fb {

struct TextureLevels {
    unsigned texture = 0;
    std::uint32_t layer = 0, width = 0, height = 0, levels = 0;
};

class UploadStaging {
  public:
    // ringBytes 0: straight from the caller's memory.
    [[nodiscard]] static Result<UploadStaging> create(std::size_t ringBytes);
    UploadStaging() = default;
    ~UploadStaging();
    UploadStaging(UploadStaging&& other) noexcept;
    UploadStaging& operator=(UploadStaging&& other) noexcept;

    void copyToBuffer(unsigned buffer, std::uint64_t offsetBytes, std::span<const std::uint8_t> bytes);
    // RGBA8 levels one after the other, level 0 first.
    void copyToTexture(const TextureLevels& into, std::span<const std::uint8_t> texels);
    // How often the ring was full and this thread waited for the GPU.
    [[nodiscard]] std::uint64_t waits() const { return waits_; }

  private:
    struct Pending {
        void* fence;            // GLsync
        std::uint64_t endByte;  // written before the fence, counted from the start of time
    };
    // Where the bytes stand in the ring after copying them there; false where they do not fit at all.
    [[nodiscard]] bool stage(std::span<const std::uint8_t> bytes, std::uint64_t& ringOffset);
    void fence();
    void retireOldest();
    void forget();

    GlBuffer ring_;
    std::uint8_t* mapped_ = nullptr;
    std::uint64_t ringBytes_ = 0, writtenEnd_ = 0, retiredEnd_ = 0, waits_ = 0;
    std::vector<Pending> pending_;  // oldest first
};

}  // namespace fb
