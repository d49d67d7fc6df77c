#include "build/quantise_block.h"

#include <array>
#include <bit>
#include <cmath>

#include "base/check.h"
#include "scenefile/limits.h"

namespace fb {
namespace {

// Below this step the areas of triangles would no longer be normal floats.
const double kSmallestStep = std::ldexp(1.0, kMinGridExponent);

// Room around the block, in lengths of its longest side: for skirts that hang below and beyond it.
constexpr double kRoom = 1.0 / 32.0;

// What a material makes of a vertex.
struct Coating {
    std::uint32_t surface = 0;
    glm::vec4 colour{1.0f};
    bool masked = false;
};

class Quantiser {
  public:
    Quantiser(const SourceBlock& block, const BlockTextures& textures) : block_(block) {
        Box3d bounds;
        for (const glm::uvec3& corners : block.mesh.triangles) {
            for (int k = 0; k < 3; ++k) bounds.grow(block.mesh.positions[corners[k]]);
        }
        result_.mesh.grid = gridFor(bounds);
        makeCoatings(textures);
        positions_.assign(block.mesh.positions.size(), kNone);
        normals_.assign(block.mesh.positions.size(), kNone);
        result_.triangles.reserve(block.mesh.triangles.size());
        result_.mesh.positions.reserve(block.mesh.positions.size());
    }

    QuantisedBlock run() {
        const SourceMesh& source = block_.mesh;
        for (std::size_t i = 0; i < source.triangles.size(); ++i) {
            const glm::uvec3& corners = source.triangles[i];
            const glm::dvec3& a = source.positions[corners.x];
            result_.sourceAreaSquareMetres += 0.5 * glm::length(glm::cross(source.positions[corners.y] - a,
                                                                           source.positions[corners.z] - a));
            addTriangle(corners, coatingOf(i, corners));
        }
        return std::move(result_);
    }

  private:
    void makeCoatings(const BlockTextures& textures) {
        std::vector<Surface>& surfaces = result_.mesh.surfaces;
        surfaces.push_back({});
        for (const SourceMaterial& material : block_.materials) {
            Coating coating{0, surfaceColour(&material, false), material.alphaMask};
            const auto texture = static_cast<std::size_t>(std::max(material.texture, 0));
            if (material.texture >= 0 && block_.mesh.hasUvs() && textures.textures[texture]) {
                const bool masked = material.alphaMask && textures.textures[texture]->hasAlpha();
                const auto same = [&](const Surface& s) {
                    return s.texture == material.texture && s.alphaMask == masked;
                };
                while (coating.surface < surfaces.size() && !same(surfaces[coating.surface]))
                    ++coating.surface;
                if (coating.surface == surfaces.size()) surfaces.push_back({material.texture, masked});
            }
            coatings_.push_back(coating);
        }
        coatings_.push_back({0, surfaceColour(nullptr, block_.mesh.hasColours()), false});  // of kNoMaterial
    }

    Coating coatingOf(std::size_t triangle, const glm::uvec3& corners) {
        const std::vector<std::uint32_t>& materials = block_.mesh.materials;
        if (materials.empty() || materials[triangle] == kNoMaterial) return coatings_.back();
        Coating coating = coatings_[materials[triangle]];
        if (coating.surface == 0) return coating;
        for (int k = 0; k < 3; ++k) {
            const glm::vec2& uv = block_.mesh.uvs[corners[k]];
            if (std::abs(uv.x) <= kLargestUv && std::abs(uv.y) <= kLargestUv) continue;
            ++result_.unusableUvs;
            coating.surface = 0;
            break;
        }
        return coating;
    }

    void addTriangle(const glm::uvec3& corners, const Coating& coating) {
        BlockMesh& mesh = result_.mesh;
        MeshTriangle triangle;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = corners[k];
            if (positions_[vertex] == kNone) {
                const glm::dvec3 scaled = (block_.mesh.positions[vertex] - mesh.grid.origin) / mesh.grid.step;
                positions_[vertex] = mesh.findOrAddPosition(GridPoint(glm::round(scaled)));
                if (block_.mesh.hasNormals()) addNormal(vertex);
                mesh.onBlockBorder.resize(mesh.positions.size(), 0);
                if (!block_.mesh.shared.empty() && block_.mesh.shared[vertex] != 0)
                    mesh.onBlockBorder[positions_[vertex]] = 1;
            }
            triangle.normals[k] = normals_[vertex];
            triangle.wedges[k] = positions_[vertex];
        }
        if (isDegenerate(mesh.positions[triangle.wedges.x], mesh.positions[triangle.wedges.y],
                         mesh.positions[triangle.wedges.z])) {
            ++result_.degenerateTriangles;
            return;
        }
        for (int k = 0; k < 3; ++k) triangle.wedges[k] = findOrAddWedge(corners[k], coating);
        result_.triangles.push_back(triangle);
    }

    void addNormal(std::uint32_t vertex) {
        const glm::vec3& normal = block_.mesh.normals[vertex];
        const float length = glm::length(normal);
        if (!(length > 1e-6f) || !std::isfinite(length)) return;
        normals_[vertex] = static_cast<std::uint32_t>(result_.mesh.normals.size());
        result_.mesh.normals.push_back(normal / length);
    }

    std::uint32_t findOrAddWedge(std::uint32_t vertex, const Coating& coating) {
        Wedge wedge{positions_[vertex], coating.surface, {}, {}};
        if (coating.surface != 0) wedge.uv = block_.mesh.uvs[vertex] + 0.0f;  // -0 becomes 0
        glm::vec4 colour = coating.colour * 255.0f;
        if (block_.mesh.hasColours()) colour *= glm::vec4(block_.mesh.colours[vertex]) / 255.0f;
        if (!coating.masked) colour.w = 255.0f;  // only a masking material cuts holes
        wedge.colour = glm::u8vec4(colour + 0.5f);

        const std::uint64_t place = std::uint64_t{wedge.position} << 32 | wedge.surface;
        const std::uint64_t look = std::uint64_t{std::bit_cast<std::uint32_t>(wedge.uv.x)} << 32 |
                                   std::bit_cast<std::uint32_t>(wedge.uv.y);
        const std::uint64_t hash =
            mixBits(place ^ mixBits(look ^ mixBits(std::bit_cast<std::uint32_t>(wedge.colour))));
        std::vector<Wedge>& wedges = result_.mesh.wedges;
        const std::uint32_t found = wedgeIndex_.find(hash, [&](std::uint32_t index) {
            const Wedge& other = wedges[index];
            return other.position == wedge.position && other.surface == wedge.surface &&
                   other.uv == wedge.uv && other.colour == wedge.colour;
        });
        if (found != kNone) return found;
        wedgeIndex_.insert(hash, static_cast<std::uint32_t>(wedges.size()));
        wedges.push_back(wedge);
        return static_cast<std::uint32_t>(wedges.size() - 1);
    }

    const SourceBlock& block_;
    QuantisedBlock result_;
    std::vector<Coating> coatings_;         // by material, the last one for kNoMaterial
    std::vector<std::uint32_t> positions_;  // by source vertex
    std::vector<std::uint32_t> normals_;    // by source vertex
    HashIndex wedgeIndex_;
};

}  // namespace

BlockGrid gridFor(const Box3d& bounds) {
    BlockGrid grid;
    if (bounds.empty()) return grid;
    const glm::dvec3 size = bounds.size();
    const double extent = std::max(size.x, std::max(size.y, size.z));
    // Two points are kept back: one for rounding the origin down, one for rounding positions up.
    const double wanted = std::max(extent * (1.0 + 2.0 * kRoom) / (kGridSize - 2), kSmallestStep);
    int exponent = 0;
    const double fraction =
        std::frexp(wanted, &exponent);  // wanted = fraction * 2^exponent, fraction in [0.5, 1)
    grid.step = std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
    grid.origin = glm::floor((bounds.min - kRoom * extent) / grid.step) * grid.step;
    return grid;
}

QuantisedBlock quantiseBlock(const SourceBlock& block, const BlockTextures& textures) {
    QuantisedBlock result = Quantiser(block, textures).run();
    for (const GridPoint& point : result.mesh.positions) {
        FB_CHECK(glm::all(glm::greaterThanEqual(point, GridPoint(0))));
        FB_CHECK(glm::all(glm::lessThan(point, GridPoint(kGridSize))));
    }
    return result;
}

}  // namespace fb
