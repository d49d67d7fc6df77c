// Which triangles share an edge: each triangle's three sides, brought together where they join the same two vertices,
// either way round.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace fb {

struct EdgeUse {
    std::uint32_t low, high;  // the two vertices
    std::uint32_t triangle;
    std::uint32_t corner;  // the side goes from this corner to the next one
    auto operator<=>(const EdgeUse&) const = default;
};

inline EdgeUse edgeUse(const glm::uvec3& vertices, std::uint32_t triangle, std::uint32_t corner) {
    const std::uint32_t a = vertices[static_cast<int>(corner)], b = vertices[static_cast<int>((corner + 1) % 3)];
    return {std::min(a, b), std::max(a, b), triangle, corner};
}

// Sorts `uses` and calls visit(std::span<const EdgeUse>) for each edge, in rising order of (low, high), with those that
// use it in rising order of (triangle, corner).
template <class Visit>
void visitEdges(std::vector<EdgeUse>& uses, Visit&& visit) {
    std::sort(uses.begin(), uses.end());
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
        visit(std::span<const EdgeUse>(uses).subspan(begin, end - begin));
    }
}

}  // namespace fb
