// A mesh becomes several by a label on each triangle. Used by the splits by group and by ground cell; goes to
// build/.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "import/source_scene.h"

namespace fb {

// One block for each label that a triangle has, in ascending order of the labels; triangles and vertices keep
// their order. Blocks get the vertices, materials and textures that they use and no others.
struct BlockLabels {
    std::span<const std::uint32_t> ofTriangles;
    std::size_t count = 1;  // labels are below this
    std::function<std::string(std::size_t label)> nameOf;
};
[[nodiscard]] std::vector<SourceBlock> splitByLabel(const SourceBlock& block, const BlockLabels& labels);

// Sets `shared` of all blocks' vertices that another block has too: surfaces that go on in another block must not part
// there at coarse levels.
void markSharedVertices(std::span<SourceBlock> blocks);

// The whole block with only the materials and textures that it uses.
[[nodiscard]] SourceBlock withoutUnused(const SourceBlock& block);

}  // namespace fb
