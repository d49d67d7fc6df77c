#include "draw/mesh_pages.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "base/check.h"
#include "draw/gl_messages.h"
#include "draw/orient_triangles.h"
#include "shaders/shared.h"

namespace fb {

namespace {

constexpr std::uint32_t kUnitBytes = sizeof(GpuVertex);
constexpr std::uint32_t kIndicesPerUnit = kUnitBytes / sizeof(std::uint32_t);
static_assert(kIndicesPerUnit == gpu::kWordsPerVertex && kIndicesPerUnit % 3 == 0);
// Offsets in indices stay below 2^32, offsets in bytes below 2^31 as some drivers want them.
constexpr std::uint64_t kMostUnits = (std::uint64_t{1} << 31) / kUnitBytes;

}  // namespace

MeshPages::MeshPages(std::uint64_t pageBytes)
    : unitsPerPage_(
          static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pageBytes / kUnitBytes, 1, kMostUnits))) {}

Result<MeshPages::Page> MeshPages::makePage(std::uint32_t units) const {
    Page page;
    page.buffer = GlBuffer::make();
    clearGlErrors();
    glNamedBufferStorage(page.buffer.name(), static_cast<GLsizeiptr>(units) * kUnitBytes, nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    if (auto made = takeGlError("making a mesh page of " + std::to_string(units * std::uint64_t{kUnitBytes}) +
                                " bytes");
        !made) {
        return passOn(made);
    }
    page.vertexArray = GlVertexArray::make();
    const unsigned array = page.vertexArray.name();
    glVertexArrayVertexBuffer(array, 0, page.buffer.name(), 0, kUnitBytes);
    glVertexArrayElementBuffer(array, page.buffer.name());
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, position));
    glVertexArrayAttribFormat(array, 1, 2, GL_SHORT, GL_TRUE, offsetof(GpuVertex, normal));
    glVertexArrayAttribFormat(array, 2, 2, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(GpuVertex, u));
    glVertexArrayAttribFormat(array, 3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(GpuVertex, colour));
    for (unsigned attribute = 0; attribute < 4; ++attribute) {
        glVertexArrayAttribBinding(array, attribute, 0);
        glEnableVertexArrayAttrib(array, attribute);
    }
    page.ranges = RangeAllocator(units);
    page.units = units;
    return page;
}

Result<MeshSlot> MeshPages::allocate(std::size_t vertices, std::size_t indices) {
    MeshSlot slot;
    const std::uint64_t units = vertices + (indices + kIndicesPerUnit - 1) / kIndicesPerUnit;
    if (units == 0) return slot;
    if (units > kMostUnits)
        return failure("", "", "a mesh of " + std::to_string(vertices) + " vertices is too large");
    slot.units = static_cast<std::uint32_t>(units);
    slot.vertices = static_cast<std::uint32_t>(vertices);
    slot.indices = static_cast<std::uint32_t>(indices);
    std::size_t hole = pages_.size();
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        if (!pages_[i]) {
            hole = std::min(hole, i);
            continue;
        }
        if (const auto place = pages_[i]->ranges.allocate(slot.units)) {
            slot.page = static_cast<std::uint32_t>(i);
            slot.firstUnit = *place;
            return slot;
        }
    }
    auto page = makePage(std::max(slot.units, unitsPerPage_));
    if (!page) return passOn(page);
    if (hole == pages_.size()) pages_.emplace_back();
    pages_[hole].emplace(std::move(*page));
    slot.page = static_cast<std::uint32_t>(hole);
    slot.firstUnit = pages_[hole]->ranges.allocate(slot.units).value();
    return slot;
}

void MeshPages::write(const MeshSlot& slot, const DecodedNode& content, UploadStaging& staging) {
    if (slot.page == kNoPage) return;
    FB_CHECK(content.vertices.size() == slot.vertices);
    FB_CHECK(content.indices.size() == slot.indices);
    // Vertices and indices side by side, in one copy.
    scratch_.resize(slot.sizeBytes());
    const std::size_t vertexBytes = content.vertices.size() * sizeof(GpuVertex);
    std::memcpy(scratch_.data(), content.vertices.data(), vertexBytes);
    orientTriangles(content, normals_, scratch_.data() + vertexBytes);
    staging.copyToBuffer(pages_[slot.page]->buffer.name(), slot.firstUnit * std::uint64_t{kUnitBytes},
                         scratch_);
}

void MeshPages::release(const MeshSlot& slot) {
    if (slot.page == kNoPage) return;
    FB_CHECK(slot.page < pages_.size());
    FB_CHECK(pages_[slot.page].has_value());
    Page& page = *pages_[slot.page];
    page.ranges.release(slot.firstUnit, slot.units);
    if (page.ranges.empty()) pages_[slot.page].reset();
}

std::uint64_t MeshPages::pageBytes(std::uint32_t page) const {
    return pages_[page]->units * std::uint64_t{kUnitBytes};
}

std::uint64_t MeshPages::allocatedBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& page : pages_) bytes += page ? page->units * std::uint64_t{kUnitBytes} : 0;
    return bytes;
}

std::size_t MeshPages::pageCount() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(pages_, [](const auto& page) { return page.has_value(); }));
}

}  // namespace fb
