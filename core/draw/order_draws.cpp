#include "draw/order_draws.h"

#include <algorithm>
#include <tuple>

namespace fb {

namespace {

auto groupOf(const Draw& d) {
    return std::tie(d.variant, d.texturePage, d.meshPage);
}

bool drawnBefore(const Draw& a, const Draw& b) {
    if (groupOf(a) != groupOf(b)) return groupOf(a) < groupOf(b);
    if (a.distanceMetres != b.distanceMetres) return a.distanceMetres < b.distanceMetres;
    return a.node < b.node;
}

}  // namespace

void orderDraws(const DrawInput& input, std::span<const GpuNode> gpuNodes, DrawLists& lists) {
    const Hierarchy& hierarchy = input.hierarchy;
    lists.nodes.clear();
    lists.draws.clear();
    lists.batches.clear();
    lists.triangles = 0;

    const bool texturing = input.effects[Effect::texturing];
    const std::uint32_t everywhere = (input.effects[Effect::lighting] ? kLit : 0u) |
                                     (input.settings.colour == ColourMode::level ? kLevel : 0u);
    for (const NodeId node : input.front) {
        if (node >= hierarchy.size() || node >= gpuNodes.size() || !gpuNodes[node].resident) continue;
        if (hierarchy.block[node] >= hierarchy.grids.size()) continue;
        const GpuNode& gpu = gpuNodes[node];
        lists.nodes.push_back(node);
        if (gpu.mesh.page == kNoPage) continue;
        lists.triangles += gpu.mesh.indices / 3;
        const Box3f& box = hierarchy.bounds[node];
        const Box3d bounds{glm::dvec3(box.min), glm::dvec3(box.max)};
        // Not a number sorts as 0: a comparison that contradicts itself would be undefined behaviour.
        const auto distance = static_cast<float>(bounds.distance(input.view.camera.eye));
        Draw draw{everywhere,
                  kNoPage,
                  gpu.mesh.page,
                  distance >= 0.0f ? distance : 0.0f,
                  node,
                  0,
                  gpu.mesh.firstIndex(),
                  gpu.mesh.indices,
                  gpu.mesh.baseVertex()};
        if (texturing && gpu.texturedIndices > 0) {
            Draw textured = draw;
            textured.variant |= kTextured | (gpu.alphaMask ? kMask : 0u);
            textured.texturePage = gpu.texture.page;
            textured.layer = gpu.texture.layer;
            textured.indexCount = gpu.texturedIndices;
            lists.draws.push_back(textured);
            draw.firstIndex += gpu.texturedIndices;
            draw.indexCount -= gpu.texturedIndices;
        }
        if (draw.indexCount > 0) lists.draws.push_back(draw);
    }
    std::ranges::sort(lists.draws, drawnBefore);
    for (std::uint32_t i = 0; i < lists.draws.size(); ++i) {
        const Draw& draw = lists.draws[i];
        if (i == 0 || groupOf(draw) != groupOf(lists.draws[i - 1])) {
            lists.batches.push_back({draw.variant, draw.texturePage, draw.meshPage, i, 0});
        }
        ++lists.batches.back().count;
    }
}

}  // namespace fb
