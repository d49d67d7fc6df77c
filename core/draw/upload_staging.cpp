#include "draw/upload_staging.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "draw/gl_messages.h"

namespace fb {

namespace {

constexpr std::uint64_t kStagingAlignBytes = 64;
constexpr std::size_t kMostFences = 64;
constexpr GLbitfield kStagingMapping = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

// `source` is an address, or an offset into the bound unpack buffer.
void copyLevels(const TextureLevels& into, const std::uint8_t* source) {
    for (std::uint32_t level = 0; level < into.levels; ++level) {
        const std::uint32_t width = std::max(1u, into.width >> level),
                            height = std::max(1u, into.height >> level);
        glTextureSubImage3D(into.texture, static_cast<GLint>(level), 0, 0, static_cast<GLint>(into.layer),
                            static_cast<GLsizei>(width), static_cast<GLsizei>(height), 1, GL_RGBA,
                            GL_UNSIGNED_BYTE, source);
        source += std::size_t{4} * width * height;
    }
}

}  // namespace

Result<UploadStaging> UploadStaging::create(std::size_t ringBytes) {
    UploadStaging staging;
    if (ringBytes == 0) return staging;
    clearGlErrors();
    staging.ring_ = GlBuffer::make();
    const auto size = static_cast<GLsizeiptr>(ringBytes);
    glNamedBufferStorage(staging.ring_.name(), size, nullptr, kStagingMapping);
    if (auto made = takeGlError("making the upload ring"); !made) return passOn(made);
    staging.mapped_ =
        static_cast<std::uint8_t*>(glMapNamedBufferRange(staging.ring_.name(), 0, size, kStagingMapping));
    if (staging.mapped_ == nullptr) return failure("", "", "the driver does not map the upload ring");
    staging.ringBytes_ = ringBytes;
    staging.pending_.reserve(kMostFences);
    return staging;
}

UploadStaging::~UploadStaging() {
    forget();
}

UploadStaging::UploadStaging(UploadStaging&& other) noexcept {
    *this = std::move(other);
}

UploadStaging& UploadStaging::operator=(UploadStaging&& other) noexcept {
    if (this == &other) return *this;
    forget();
    ring_ = std::move(other.ring_);
    mapped_ = std::exchange(other.mapped_, nullptr);
    ringBytes_ = std::exchange(other.ringBytes_, 0);
    writtenEnd_ = std::exchange(other.writtenEnd_, 0);
    retiredEnd_ = std::exchange(other.retiredEnd_, 0);
    waits_ = std::exchange(other.waits_, 0);
    pending_ = std::exchange(other.pending_, {});
    return *this;
}

void UploadStaging::forget() {
    for (const Pending& p : pending_) glDeleteSync(static_cast<GLsync>(p.fence));
    pending_.clear();
}

void UploadStaging::retireOldest() {
    FB_CHECK(!pending_.empty());
    const auto sync = static_cast<GLsync>(pending_.front().fence);
    if (glClientWaitSync(sync, 0, 0) == GL_TIMEOUT_EXPIRED) {
        ++waits_;
        // Any other answer than "not yet" ends the wait: the fence has passed, or the context is gone.
        while (glClientWaitSync(sync, GL_SYNC_FLUSH_COMMANDS_BIT, 1'000'000'000) == GL_TIMEOUT_EXPIRED) {
        }
    }
    glDeleteSync(sync);
    retiredEnd_ = pending_.front().endByte;
    pending_.erase(pending_.begin());
}

bool UploadStaging::stage(std::span<const std::uint8_t> bytes, std::uint64_t& ringOffset) {
    if (bytes.size() > ringBytes_) return false;
    std::uint64_t begin = (writtenEnd_ + kStagingAlignBytes - 1) / kStagingAlignBytes * kStagingAlignBytes;
    const std::uint64_t untilWrap = ringBytes_ - begin % ringBytes_;
    if (bytes.size() > untilWrap) begin += untilWrap;
    while (begin + bytes.size() > retiredEnd_ + ringBytes_) {
        if (pending_.empty()) {
            retiredEnd_ = begin;  // nothing is under way: the gap left at the wrap is free as well
        } else {
            retireOldest();
        }
    }
    ringOffset = begin % ringBytes_;
    std::memcpy(mapped_ + ringOffset, bytes.data(), bytes.size());
    writtenEnd_ = begin + bytes.size();
    return true;
}

void UploadStaging::fence() {
    if (pending_.size() == kMostFences) retireOldest();
    pending_.push_back({glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0), writtenEnd_});
}

void UploadStaging::copyToBuffer(unsigned buffer, std::uint64_t offsetBytes,
                                 std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return;
    const auto offset = static_cast<GLintptr>(offsetBytes);
    const auto size = static_cast<GLsizeiptr>(bytes.size());
    std::uint64_t ringOffset = 0;
    if (!stage(bytes, ringOffset)) {
        glNamedBufferSubData(buffer, offset, size, bytes.data());
        return;
    }
    glCopyNamedBufferSubData(ring_.name(), buffer, static_cast<GLintptr>(ringOffset), offset, size);
    fence();
}

void UploadStaging::copyToTexture(const TextureLevels& into, std::span<const std::uint8_t> texels) {
    if (texels.empty()) return;
    std::uint64_t ringOffset = 0;
    if (!stage(texels, ringOffset)) {
        copyLevels(into, texels.data());
        return;
    }
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, ring_.name());
    copyLevels(into, reinterpret_cast<const std::uint8_t*>(ringOffset));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    fence();
}

}  // namespace fb
