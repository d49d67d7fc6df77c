// The draws of a front in the order that changes least state. In: the front and where its nodes lie on the
// GPU. Out: draws grouped by program, texture page and mesh page, nearest first within a group, so that
// hidden surfaces are refused by the depth test before they are shaded. Each group becomes one multi-draw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "draw/mesh_pages.h"
#include "draw/renderer.h"
#include "draw/texture_pages.h"

namespace fb {

// What a program for nodes does; an effect that is off is not in the program at all.
inline constexpr std::uint32_t kTextured = 1, kLit = 2, kMask = 4, kLevel = 8;
inline constexpr std::uint32_t kVariants = 16;

// A node's content on the GPU; `resident` is false where there is none.
struct GpuNode {
    bool resident = false, alphaMask = false;
    std::uint32_t texturedIndices = 0, untexturedIndices = 0;  // in this order
    MeshSlot mesh;
    TextureSlot texture;
    std::uint64_t textureBytes = 0;
};

struct Draw {
    std::uint32_t variant, texturePage, meshPage;  // texturePage is kNoPage without TEXTURED
    float distanceMetres;
    NodeId node;
    std::uint32_t layer, firstIndex, indexCount, baseVertex;
};

struct Batch {
    std::uint32_t variant, texturePage, meshPage;
    std::uint32_t first, count;  // in DrawLists::draws
};

struct DrawLists {
    std::vector<NodeId> nodes;  // of the front, those that can be drawn
    std::vector<Draw> draws;
    std::vector<Batch> batches;
    std::uint64_t triangles = 0;
};

// Nodes of the front that are not resident or not in the hierarchy are left out.
void orderDraws(const DrawInput& input, std::span<const GpuNode> gpuNodes, DrawLists& lists);

}  // namespace fb
