#include "build/block_mesh.h"

namespace fb {

std::uint32_t BlockMesh::findOrAddPosition(const GridPoint& point) {
    const auto bits = [](std::int32_t v) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v));
    };
    const std::uint64_t hash = mixBits((bits(point.x) | bits(point.y) << 32) ^ mixBits(bits(point.z) + 1));
    const std::uint32_t found =
        positionIndex.find(hash, [&](std::uint32_t index) { return positions[index] == point; });
    if (found != kNone) return found;
    const auto added = static_cast<std::uint32_t>(positions.size());
    positions.push_back(point);
    onCut.push_back(0);
    positionIndex.insert(hash, added);
    return added;
}

}  // namespace fb
