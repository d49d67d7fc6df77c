#include "import/split_blocks.h"

#include <algorithm>
#include <numeric>

#include "base/check.h"
#include "base/hash.h"

namespace fb {
namespace {

constexpr std::uint32_t kNotTaken = ~std::uint32_t{0};

// Makes one block after another out of parts of the same source.
class Extractor {
  public:
    explicit Extractor(const SourceBlock& from)
        : from_(from),
          vertices_(from.mesh.positions.size(), kNotTaken),
          materials_(from.materials.size(), kNotTaken) {}

    SourceBlock take(std::span<const std::uint32_t> triangles, const std::string& name) {
        SourceBlock block;
        block.name = name;
        takeVertices(triangles, block.mesh);
        for (const std::uint32_t t : triangles) {
            const glm::uvec3 old = from_.mesh.triangles[t];
            block.mesh.triangles.emplace_back(vertices_[old.x], vertices_[old.y], vertices_[old.z]);
            block.mesh.materials.push_back(takeMaterial(from_.mesh.materials[t], block));
        }
        forget(triangles);
        return block;
    }

  private:
    // In the order of the source, so that what lay close together stays so.
    void takeVertices(std::span<const std::uint32_t> triangles, SourceMesh& into) {
        std::vector<std::uint32_t> used;
        for (const std::uint32_t t : triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = from_.mesh.triangles[t][corner];
                if (vertices_[vertex] != kNotTaken) continue;
                vertices_[vertex] = 0;
                used.push_back(vertex);
            }
        }
        std::sort(used.begin(), used.end());
        const SourceMesh& mesh = from_.mesh;
        for (std::uint32_t i = 0; i < used.size(); ++i) {
            const std::uint32_t vertex = used[i];
            vertices_[vertex] = i;
            into.positions.push_back(mesh.positions[vertex]);
            if (mesh.hasNormals()) into.normals.push_back(mesh.normals[vertex]);
            if (mesh.hasUvs()) into.uvs.push_back(mesh.uvs[vertex]);
            if (mesh.hasColours()) into.colours.push_back(mesh.colours[vertex]);
        }
    }

    std::uint32_t takeMaterial(std::uint32_t material, SourceBlock& block) {
        if (material == kNoMaterial) return kNoMaterial;
        FB_CHECK(material < materials_.size());
        if (materials_[material] == kNotTaken) {
            materials_[material] = static_cast<std::uint32_t>(block.materials.size());
            block.materials.push_back(from_.materials[material]);
            int& texture = block.materials.back().texture;
            if (texture >= 0) texture = takeTexture(texture, block);
        }
        return materials_[material];
    }

    int takeTexture(int texture, SourceBlock& block) {
        for (std::size_t i = 0; i < textures_.size(); ++i) {
            if (textures_[i] == texture) return static_cast<int>(i);
        }
        textures_.push_back(texture);
        block.textures.push_back(from_.textures[static_cast<std::size_t>(texture)]);
        return static_cast<int>(textures_.size() - 1);
    }

    void forget(std::span<const std::uint32_t> triangles) {
        for (const std::uint32_t t : triangles) {
            const glm::uvec3 old = from_.mesh.triangles[t];
            vertices_[old.x] = vertices_[old.y] = vertices_[old.z] = kNotTaken;
            if (from_.mesh.materials[t] != kNoMaterial) materials_[from_.mesh.materials[t]] = kNotTaken;
        }
        textures_.clear();
    }

    const SourceBlock& from_;
    std::vector<std::uint32_t> vertices_, materials_;  // number in the block being made, or kNotTaken
    std::vector<int> textures_;                        // of the source, those of the block being made
};

}  // namespace

std::vector<SourceBlock> splitByLabel(const SourceBlock& block, const BlockLabels& labels) {
    FB_CHECK(labels.ofTriangles.size() == block.mesh.triangles.size());
    FB_CHECK(block.mesh.materials.size() == block.mesh.triangles.size());
    // Counting sort: the triangles of label l stand from starts[l] on.
    std::vector<std::size_t> starts(labels.count + 1, 0);
    for (const std::uint32_t label : labels.ofTriangles) {
        FB_CHECK(label < labels.count);
        ++starts[label + 1];
    }
    for (std::size_t l = 1; l < starts.size(); ++l) starts[l] += starts[l - 1];
    std::vector<std::uint32_t> sorted(labels.ofTriangles.size());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::uint32_t t = 0; t < sorted.size(); ++t) sorted[next[labels.ofTriangles[t]]++] = t;

    Extractor extractor(block);
    std::vector<SourceBlock> blocks;
    for (std::size_t l = 0; l < labels.count; ++l) {
        if (starts[l] == starts[l + 1]) continue;
        const std::span<const std::uint32_t> triangles(sorted);
        blocks.push_back(
            extractor.take(triangles.subspan(starts[l], starts[l + 1] - starts[l]), labels.nameOf(l)));
    }
    return blocks;
}

void markSharedVertices(std::span<SourceBlock> blocks) {
    // Positions by their hash: a collision only marks a vertex too many.
    const auto hashOf = [](const glm::dvec3& p) { return hashBytes(&p, sizeof(p)); };
    std::vector<std::pair<std::uint64_t, std::uint32_t>> seen;
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        for (const glm::dvec3& p : blocks[b].mesh.positions) seen.emplace_back(hashOf(p), b);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<std::uint64_t> inSeveral;
    for (std::size_t i = 1; i < seen.size(); ++i) {
        if (seen[i].first == seen[i - 1].first) inSeveral.push_back(seen[i].first);
    }
    for (SourceBlock& block : blocks) {
        SourceMesh& mesh = block.mesh;
        mesh.shared.assign(mesh.positions.size(), 0);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            mesh.shared[v] = std::binary_search(inSeveral.begin(), inSeveral.end(), hashOf(mesh.positions[v])) ? 1 : 0;
        }
    }
}

SourceBlock withoutUnused(const SourceBlock& block) {
    std::vector<std::uint32_t> all(block.mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return Extractor(block).take(all, block.name);
}

}  // namespace fb
