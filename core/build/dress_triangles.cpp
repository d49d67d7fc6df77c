#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "build/joiner.h"
#include "build/node_triangles.h"

namespace fb {
namespace {

glm::vec3 faceNormal(const BlockMesh& mesh, const glm::uvec3& positions) {
    return glm::vec3(normalOf(mesh, positions));
}

struct OriginalCorner {
    std::uint32_t position, wedge, normal;

    auto operator<=>(const OriginalCorner&) const = default;
};

// The corners of the original at the positions that the simplified triangles still use.
class OriginalCorners {
  public:
    OriginalCorners(const BlockMesh& mesh, std::span<const MeshTriangle> piece,
                    const SimplifiedPiece& simplified, std::vector<std::uint32_t>& scratch)
        : mesh_(mesh), simplified_(simplified), scratch_(scratch) {
        FB_CHECK(scratch.size() == mesh.positions.size());
        setAll(0);
        for (const MeshTriangle& triangle : piece) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t position = mesh.wedges[triangle.wedges[k]].position;
                if (scratch_[position] != kNone)
                    corners_.push_back({position, triangle.wedges[k], triangle.normals[k]});
            }
        }
        std::sort(corners_.begin(), corners_.end());
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
        for (std::size_t i = corners_.size(); i-- > 0;)
            scratch_[corners_[i].position] = static_cast<std::uint32_t>(i);
    }
    ~OriginalCorners() { setAll(kNone); }
    OriginalCorners(const OriginalCorners&) = delete;
    OriginalCorners& operator=(const OriginalCorners&) = delete;

    // None at a position that is not the original's.
    [[nodiscard]] std::span<const OriginalCorner> at(std::uint32_t position) const {
        const std::size_t begin = scratch_[position];
        std::size_t end = begin;
        while (end < corners_.size() && corners_[end].position == position) ++end;
        return std::span(corners_).subspan(begin, end - begin);
    }

  private:
    void setAll(std::uint32_t value) {
        for (const glm::uvec3& ids : simplified_.triangles) {
            for (int k = 0; k < 3; ++k)
                scratch_[simplified_.welded ? ids[k] : mesh_.wedges[ids[k]].position] = value;
        }
    }

    const BlockMesh& mesh_;
    const SimplifiedPiece& simplified_;
    std::vector<OriginalCorner> corners_;
    std::vector<std::uint32_t>& scratch_;
};

// Of the normals that the original has at a wedge (or, for kNone, at a position) the one closest to the
// face's.
glm::vec3 chooseNormal(const BlockMesh& mesh, std::span<const OriginalCorner> corners, std::uint32_t wedge,
                       const glm::vec3& face) {
    glm::vec3 best = face;
    float bestDot = -2.0f;
    for (const OriginalCorner& corner : corners) {
        if ((wedge != kNone && corner.wedge != wedge) || corner.normal == kNone) continue;
        const float dot = glm::dot(mesh.normals[corner.normal], face);
        if (dot <= bestDot) continue;
        bestDot = dot;
        best = mesh.normals[corner.normal];
    }
    return best;
}

NodeTriangle dressWedges(const BlockMesh& mesh, const glm::uvec3& wedges) {
    NodeTriangle triangle;
    triangle.wedges = wedges;
    triangle.surface = mesh.wedges[wedges.x].surface;
    for (int k = 0; k < 3; ++k) {
        triangle.positions[k] = mesh.wedges[wedges[k]].position;
        triangle.colours[static_cast<std::size_t>(k)] = mesh.wedges[wedges[k]].colour;
    }
    return triangle;
}

class WeldedDresser {
  public:
    WeldedDresser(const WeldedDress& dress, const OriginalCorners& corners)
        : dress_(dress), corners_(corners) {}

    NodeTriangle dress(const glm::uvec3& positions) {
        const BlockMesh& mesh = dress_.mesh;
        const glm::vec3 face = faceNormal(mesh, positions);
        NodeTriangle triangle;
        const glm::uvec3 wedges = commonWedges(positions);
        if (wedges.x != kNone && agrees(positions, wedges, face)) {
            triangle = dressWedges(mesh, wedges);
        } else {
            triangle.positions = positions;
            triangle.baked = isTextured(positions, face);
            for (int k = 0; k < 3; ++k) {
                triangle.colours[static_cast<std::size_t>(k)] =
                    triangle.baked ? glm::u8vec4(255) : colourNear(positions, k, face);
            }
        }
        for (int k = 0; k < 3; ++k) {
            triangle.normals[static_cast<std::size_t>(k)] =
                chooseNormal(mesh, corners_.at(positions[k]), triangle.wedges[k], face);
        }
        return triangle;
    }

  private:
    // One wedge per corner, all of one chart; of several possibilities the one smallest in the texture.
    [[nodiscard]] glm::uvec3 commonWedges(const glm::uvec3& positions) const {
        glm::uvec3 best(kNone);
        float bestSize = std::numeric_limits<float>::infinity();
        for (const OriginalCorner& first : corners_.at(positions.x)) {
            glm::uvec3 wedges(first.wedge, kNone, kNone);
            float size = 0.0f;
            for (int k = 1; k < 3; ++k) {
                float nearest = std::numeric_limits<float>::infinity();
                for (const OriginalCorner& other : corners_.at(positions[k])) {
                    if (dress_.chartOfWedge[other.wedge] != dress_.chartOfWedge[first.wedge]) continue;
                    const glm::vec2 apart =
                        dress_.mesh.wedges[other.wedge].uv - dress_.mesh.wedges[first.wedge].uv;
                    if (glm::dot(apart, apart) >= nearest) continue;
                    nearest = glm::dot(apart, apart);
                    wedges[k] = other.wedge;
                }
                size += nearest;
            }
            if (size >= bestSize) continue;
            bestSize = size;
            best = wedges;
        }
        return best;
    }

    [[nodiscard]] glm::vec3 pointOf(const glm::uvec3& positions, const glm::vec3& weights) const {
        glm::vec3 point(0.0f);
        for (int k = 0; k < 3; ++k) point += glm::vec3(dress_.mesh.positions[positions[k]]) * weights[k];
        return point;
    }

    static constexpr std::array<glm::vec3, 4> kProbes = {glm::vec3(1.0f / 3.0f), glm::vec3(0.5f, 0.5f, 0.0f),
                                                         glm::vec3(0.0f, 0.5f, 0.5f),
                                                         glm::vec3(0.5f, 0.0f, 0.5f)};

    // Whether the original between the corners shows what the triangle would: the same chart, and texels that
    // lie within a tenth of the triangle's size, or two texels of the node.
    [[nodiscard]] bool agrees(const glm::uvec3& positions, const glm::uvec3& wedges,
                              const glm::vec3& face) const {
        const BlockMesh& mesh = dress_.mesh;
        const Surface& surface = mesh.surfaces[mesh.wedges[wedges.x].surface];
        if (surface.texture < 0) return true;
        const TextureLevels& texture = *dress_.textures.textures[static_cast<std::size_t>(surface.texture)];
        const glm::vec2 texels(texture.width(), texture.height());
        float size = 0.0f;
        for (int k = 0; k < 3; ++k) {
            size = std::max(
                size,
                glm::length((mesh.wedges[wedges[k]].uv - mesh.wedges[wedges[(k + 1) % 3]].uv) * texels));
        }
        const float tolerance = std::max(0.1f * size, static_cast<float>(2.0 / dress_.texelScale));
        for (const glm::vec3& weights : kProbes) {
            const PieceSurface::Hit hit = dress_.surface.closest(pointOf(positions, weights), face, kNone);
            const std::uint32_t chart = dress_.chartOfWedge[dress_.surface.triangle(hit.triangle).wedges.x];
            if (chart != dress_.chartOfWedge[wedges.x]) return false;
            glm::vec2 uv(0.0f);
            for (int k = 0; k < 3; ++k) uv += mesh.wedges[wedges[k]].uv * weights[k];
            if (glm::length((uv - dress_.surface.uvAt(hit)) * texels) > tolerance) return false;
        }
        return true;
    }

    [[nodiscard]] bool isTextured(const glm::uvec3& positions, const glm::vec3& face) const {
        return std::any_of(kProbes.begin(), kProbes.end(), [&](const glm::vec3& weights) {
            return dress_.surface.surfaceOf(
                       dress_.surface.closest(pointOf(positions, weights), face, kNone)) != 0;
        });
    }

    // The original's colour near a corner, a little inside: at the corner itself several meet.
    [[nodiscard]] glm::u8vec4 colourNear(const glm::uvec3& positions, int corner,
                                         const glm::vec3& face) const {
        glm::vec3 weights(0.05f);
        weights[corner] = 0.9f;
        return dress_.surface.vertexColourAt(
            dress_.surface.closest(pointOf(positions, weights), face, kNone));
    }

    const WeldedDress& dress_;
    const OriginalCorners& corners_;
};

}  // namespace

std::vector<NodeTriangle> dressOriginal(const BlockMesh& mesh, std::span<const MeshTriangle> piece) {
    std::vector<NodeTriangle> result;
    result.reserve(piece.size());
    for (const MeshTriangle& source : piece) {
        NodeTriangle triangle = dressWedges(mesh, source.wedges);
        for (int k = 0; k < 3; ++k) {
            triangle.normals[static_cast<std::size_t>(k)] = source.normals[k] != kNone
                                                                ? mesh.normals[source.normals[k]]
                                                                : faceNormal(mesh, triangle.positions);
        }
        result.push_back(triangle);
    }
    return result;
}

std::vector<NodeTriangle> dressSeamed(const BlockMesh& mesh, std::span<const MeshTriangle> piece,
                                      const SimplifiedPiece& simplified,
                                      std::vector<std::uint32_t>& scratch) {
    FB_CHECK(!simplified.welded);
    const OriginalCorners corners(mesh, piece, simplified, scratch);
    std::vector<NodeTriangle> result;
    result.reserve(simplified.triangles.size());
    for (const glm::uvec3& wedges : simplified.triangles) {
        NodeTriangle triangle = dressWedges(mesh, wedges);
        const glm::vec3 face = faceNormal(mesh, triangle.positions);
        for (int k = 0; k < 3; ++k) {
            triangle.normals[static_cast<std::size_t>(k)] =
                chooseNormal(mesh, corners.at(triangle.positions[k]), wedges[k], face);
        }
        result.push_back(triangle);
    }
    return result;
}

std::vector<NodeTriangle> dressWelded(const WeldedDress& dress, const SimplifiedPiece& simplified,
                                      std::vector<std::uint32_t>& scratch) {
    FB_CHECK(simplified.welded);
    const OriginalCorners corners(dress.mesh, dress.piece, simplified, scratch);
    WeldedDresser dresser(dress, corners);
    std::vector<NodeTriangle> result;
    result.reserve(simplified.triangles.size());
    for (const glm::uvec3& positions : simplified.triangles) result.push_back(dresser.dress(positions));
    return result;
}

std::vector<std::uint32_t> chartsOfWedges(const BlockMesh& mesh, std::span<const MeshTriangle> triangles) {
    Joiner joiner(mesh.wedges.size());
    for (const MeshTriangle& t : triangles) joiner.join(joiner.join(t.wedges.x, t.wedges.y), t.wedges.z);
    std::vector<std::uint32_t> chart(mesh.wedges.size());
    for (std::uint32_t wedge = 0; wedge < chart.size(); ++wedge) chart[wedge] = joiner.find(wedge);
    return chart;
}

}  // namespace fb
