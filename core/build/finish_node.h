// Turns a node's triangles into what is stored: vertices and indices, and the numbers that the hierarchy
// keeps. Comes from make_atlas, goes to build_block (thesis 3.3, algorithms section 1).
#pragma once

#include <span>

#include "build/node_triangles.h"
#include "scenefile/scene.h"

namespace fb {

// Vertices made unique, textured triangles first. The atlas is what NodeTriangle::texels count in; 0 by 0
// without texture. encodePayload() puts both into an order that suits the vertex cache.
[[nodiscard]] NodeMesh makeNodeMesh(const BlockMesh& mesh, std::span<const NodeTriangle> triangles,
                                    int atlasWidth, int atlasHeight);

// Cost inputs, static benefit, average normal, area and the bounds of the node's own triangles (rounded
// outward).
void measureNode(const BlockMesh& mesh, std::span<const NodeTriangle> triangles, const NodeMesh& made,
                 BuiltNode& node);

}  // namespace fb
