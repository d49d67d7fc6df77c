#include "build/separate_parts.h"

#include <algorithm>
#include <array>

#include "build/joiner.h"

namespace fb {
namespace {

std::uint64_t spreadBits(std::uint64_t v) {  // 21 bits to every third
    std::uint64_t spread = 0;
    for (int bit = 0; bit < 21; ++bit) spread |= (v >> bit & 1u) << (3 * bit);
    return spread;
}

std::uint64_t mortonCode(const glm::dvec3& p) {
    const glm::dvec3 cell = glm::clamp(p / 8.0, glm::dvec3(0.0), glm::dvec3(kGridSize / 8 - 1));
    return spreadBits(static_cast<std::uint64_t>(cell.x)) |
           spreadBits(static_cast<std::uint64_t>(cell.y)) << 1 |
           spreadBits(static_cast<std::uint64_t>(cell.z)) << 2;
}

class PartFinder {
  public:
    PartFinder(const BlockMesh& mesh, std::span<const glm::uvec3> triangles, Numbering& numbering)
        : mesh_(mesh), triangles_(triangles), numbering_(numbering) {
        numbering_.restart();
    }

    // In the order of their first triangles.
    std::vector<Part> find() {
        std::vector<glm::uvec3> numbered;
        numbered.reserve(triangles_.size());
        for (const glm::uvec3& t : triangles_) numbered.emplace_back(number(t.x), number(t.y), number(t.z));
        Joiner joiner(numbering_.next());
        for (const glm::uvec3& t : numbered) joiner.join(joiner.join(t.x, t.y), t.z);
        std::vector<Part> parts;
        std::vector<std::uint32_t> partOf(numbering_.next(), kNone);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            std::uint32_t& part = partOf[joiner.find(numbered[i].x)];
            if (part == kNone) {
                part = static_cast<std::uint32_t>(parts.size());
                parts.emplace_back();
            }
            add(parts[part], i);
        }
        for (Part& part : parts) {
            part.centre /= part.area;
            part.curve = mortonCode(part.centre);
        }
        return parts;
    }

  private:
    void add(Part& part, std::uint32_t i) const {
        const glm::uvec3& t = triangles_[i];
        const std::array<glm::dvec3, 3> p = {mesh_.positions[t.x], mesh_.positions[t.y],
                                             mesh_.positions[t.z]};
        const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        part.triangles.push_back(i);
        part.area += area;
        part.centre += area / 3.0 * (p[0] + p[1] + p[2]);
        for (const glm::dvec3& corner : p) part.bounds.grow(corner);
    }
    std::uint32_t number(std::uint32_t position) { return numbering_.take(position).value; }

    const BlockMesh& mesh_;
    std::span<const glm::uvec3> triangles_;
    Numbering& numbering_;
};

}  // namespace

std::vector<Part> findParts(const BlockMesh& mesh, std::span<const glm::uvec3> triangles,
                            Numbering& numbering) {
    return PartFinder(mesh, triangles, numbering).find();
}

}  // namespace fb
