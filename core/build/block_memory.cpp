#include "build/block_memory.h"

#include <algorithm>
#include <cmath>

namespace fb {
namespace {

// In pictures, by texture; at most one, since tiles are held once.
std::vector<double> shownShares(const SourceBlock& block) {
    std::vector<double> shares(block.textures.size(), 0.0);
    const SourceMesh& mesh = block.mesh;
    if (!mesh.hasUvs()) return shares;
    for (std::size_t t = 0; t < mesh.triangles.size() && t < mesh.materials.size(); ++t) {
        const std::uint32_t material = mesh.materials[t];
        if (material >= block.materials.size() || block.materials[material].texture < 0) continue;
        const glm::uvec3& i = mesh.triangles[t];
        const glm::dvec2 a(mesh.uvs[i.x]), b = glm::dvec2(mesh.uvs[i.y]) - a,
                                           c = glm::dvec2(mesh.uvs[i.z]) - a;
        const double area = 0.5 * std::abs(b.x * c.y - b.y * c.x);
        const auto texture = static_cast<std::size_t>(block.materials[material].texture);
        if (texture < shares.size() && std::isfinite(area)) shares[texture] += area;
    }
    for (double& share : shares) share = std::min(share, 1.0);
    return shares;
}

}  // namespace

std::uint64_t estimateBlockBytes(const SourceBlock& block, TextureStore& store) {
    double texels = 0.0;
    const std::vector<double> shares = shownShares(block);
    for (std::size_t t = 0; t < shares.size(); ++t) {
        if (shares[t] == 0.0) continue;
        const Result<StoredTexture> texture = store.open(block.textures[t]);
        if (texture) texels += shares[t] * texture->header.width * texture->header.height;
    }
    return block.mesh.triangles.size() * kBytesPerTriangle +
           static_cast<std::uint64_t>(texels * static_cast<double>(kBytesPerTexel));
}

}  // namespace fb
