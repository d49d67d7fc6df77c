// Meshes on the GPU: pages of a few MiB, each one buffer that holds vertices and indices of many nodes, so
// that a front is drawn with few binds. In: decoded nodes. Out: where they lie. A node too large for a page
// gets one of its own; a page that runs empty is deleted.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "draw/allocate_ranges.h"
#include "draw/gl_objects.h"
#include "draw/upload_staging.h"
#include "scenefile/node_data.h"

namespace fb {

inline constexpr std::uint32_t kNoPage = ~std::uint32_t{0};

// Pages count in units of one vertex (24 bytes = 6 indices): vertices start at a whole vertex, and the first
// index is a multiple of 3, which the wireframe needs to tell corners apart.
struct MeshSlot {
    std::uint32_t page = kNoPage;  // kNoPage: a node without triangles
    std::uint32_t firstUnit = 0, units = 0;
    std::uint32_t vertices = 0, indices = 0;

    [[nodiscard]] std::uint32_t baseVertex() const { return firstUnit; }
    [[nodiscard]] std::uint32_t firstIndex() const { return (firstUnit + vertices) * 6; }
    [[nodiscard]] std::uint64_t sizeBytes() const {
        return vertices * std::uint64_t{sizeof(GpuVertex)} + indices * std::uint64_t{sizeof(std::uint32_t)};
    }
};

class MeshPages {
  public:
    explicit MeshPages(std::uint64_t pageBytes);

    // Error: the GPU has no memory for another page; nothing has changed then.
    [[nodiscard]] Result<MeshSlot> allocate(std::size_t vertices, std::size_t indices);
    void write(const MeshSlot& slot, const DecodedNode& content, UploadStaging& staging);
    void release(const MeshSlot& slot);

    [[nodiscard]] unsigned vertexArray(std::uint32_t page) const { return pages_[page]->vertexArray.name(); }
    [[nodiscard]] unsigned buffer(std::uint32_t page) const { return pages_[page]->buffer.name(); }
    [[nodiscard]] std::uint64_t pageBytes(std::uint32_t page) const;
    [[nodiscard]] std::uint64_t allocatedBytes() const;
    [[nodiscard]] std::size_t pageCount() const;

  private:
    struct Page {
        GlBuffer buffer;
        GlVertexArray vertexArray;
        RangeAllocator ranges;
        std::uint32_t units = 0;
    };
    [[nodiscard]] Result<Page> makePage(std::uint32_t units) const;

    std::uint32_t unitsPerPage_;
    std::vector<std::optional<Page>> pages_;  // numbers of pages stay while they live
    std::vector<std::uint8_t> scratch_;
    std::vector<glm::vec3> normals_;  // scratch
};

}  // namespace fb
