// First step of building a block: positions go onto the block's integer grid, once, so that whatever is cut
// or simplified later meets exactly; attributes become wedges. Triangles that the grid makes degenerate are
// dropped. Comes from import/ (SourceBlock), goes to split_mesh.
#pragma once

#include "build/block_mesh.h"
#include "build/block_textures.h"

namespace fb {

struct QuantisedBlock {
    BlockMesh mesh;
    std::vector<MeshTriangle> triangles;
    std::uint64_t degenerateTriangles = 0;  // dropped: no area on the grid
    std::uint64_t unusableUvs = 0;          // triangles drawn untextured: coordinates not finite or absurd
    double sourceAreaSquareMetres = 0.0;    // before quantising
};

// The finest grid with a power of two as step whose 2^24 points hold the box; its origin is a multiple of the
// step, so that blocks of equal step lie on one common grid.
[[nodiscard]] BlockGrid gridFor(const Box3d& bounds);

// `block` has passed checkBlock().
[[nodiscard]] QuantisedBlock quantiseBlock(const SourceBlock& block, const BlockTextures& textures);

}  // namespace fb
