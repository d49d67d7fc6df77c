#include <cmath>

#include "build/node_triangles.h"

namespace fb {
namespace {

TriangleCorners cornersOf(const BlockMesh& mesh, const MeshTriangle& triangle) {
    return {glm::vec3(mesh.at(triangle.wedges.x)), glm::vec3(mesh.at(triangle.wedges.y)),
            glm::vec3(mesh.at(triangle.wedges.z))};
}

std::vector<TriangleCorners> allCorners(const BlockMesh& mesh, std::span<const MeshTriangle> piece) {
    std::vector<TriangleCorners> corners;
    corners.reserve(piece.size());
    for (const MeshTriangle& triangle : piece) corners.push_back(cornersOf(mesh, triangle));
    return corners;
}

double gridArea(const BlockMesh& mesh, const MeshTriangle& t) {
    return 0.5 * glm::length(crossOf(mesh.at(t.wedges.x), mesh.at(t.wedges.y), mesh.at(t.wedges.z)));
}

double texelArea(const BlockMesh& mesh, const MeshTriangle& t, const TextureLevels& texture) {
    const glm::dvec2 size(texture.width(), texture.height());
    const glm::dvec2 a = glm::dvec2(mesh.wedges[t.wedges.x].uv) * size;
    const glm::dvec2 b = glm::dvec2(mesh.wedges[t.wedges.y].uv) * size - a;
    const glm::dvec2 c = glm::dvec2(mesh.wedges[t.wedges.z].uv) * size - a;
    return 0.5 * std::abs(b.x * c.y - b.y * c.x);
}

}  // namespace

PieceSurface::PieceSurface(const BlockMesh& mesh, std::span<const MeshTriangle> piece,
                           BlockTextures& textures)
    : mesh_(mesh), piece_(piece), textures_(textures), tree_(allCorners(mesh, piece)) {
    double texels = 0.0;
    for (const MeshTriangle& t : piece) {
        normals_.push_back(glm::vec3(
            glm::normalize(crossOf(mesh.at(t.wedges.x), mesh.at(t.wedges.y), mesh.at(t.wedges.z)))));
        const int texture = mesh.surfaces[mesh.wedges[t.wedges.x].surface].texture;
        if (texture < 0) continue;
        texels += texelArea(mesh, t, *textures.textures[static_cast<std::size_t>(texture)]);
        texturedGridArea_ += gridArea(mesh, t);
    }
    if (texturedGridArea_ > 0.0) texelsPerGridUnit_ = std::sqrt(texels / texturedGridArea_);
}

PieceSurface::Hit PieceSurface::closest(const glm::vec3& point, const glm::vec3& normal,
                                        std::uint32_t near) const {
    const auto facing = [&](std::uint32_t i) { return glm::dot(normals_[i], normal) > 0.0f; };
    ClosestPoint start;
    if (near != kNone && facing(near)) start = tree_.closestOn(near, point);
    ClosestPoint found = tree_.closest(point, start, 0.0f, facing);
    if (found.triangle == kNone) found = tree_.closest(point);
    return {found.triangle, found.weights};
}

void PieceSurface::findCandidates(const glm::vec3& centre, float reach, const glm::vec3& normal,
                                  std::uint32_t near, std::vector<std::uint32_t>& candidates) const {
    candidates.clear();
    const Hit hit = closest(centre, normal, near);
    const bool anyFaces = glm::dot(normals_[hit.triangle], normal) > 0.0f;
    const float distance = std::sqrt(tree_.closestOn(hit.triangle, centre).squaredDistance);
    // A point `reach` away has a triangle within distance + reach, which is within distance + 2 reach of the centre; a
    // little more for rounding.
    tree_.visitNear(
        centre, (distance + 2.0f * reach) * 1.0001f,
        [&](std::uint32_t i) { return !anyFaces || glm::dot(normals_[i], normal) > 0.0f; },
        [&](std::uint32_t i) { candidates.push_back(i); });
    if (candidates.empty()) candidates.push_back(hit.triangle);
}

PieceSurface::Hit PieceSurface::closestOf(std::span<const std::uint32_t> candidates,
                                          const glm::vec3& point) const {
    ClosestPoint best;
    for (const std::uint32_t candidate : candidates) {
        const ClosestPoint found = tree_.closestOn(candidate, point);
        if (found.squaredDistance < best.squaredDistance) best = found;
    }
    return {best.triangle, best.weights};
}

std::uint32_t PieceSurface::surfaceOf(const Hit& hit) const {
    return mesh_.wedges[piece_[hit.triangle].wedges.x].surface;
}

glm::vec2 PieceSurface::uvAt(const Hit& hit) const {
    glm::vec2 uv(0.0f);
    for (int k = 0; k < 3; ++k) uv += mesh_.wedges[piece_[hit.triangle].wedges[k]].uv * hit.weights[k];
    return uv;
}

glm::u8vec4 PieceSurface::vertexColourAt(const Hit& hit) const {
    glm::vec4 colour(0.5f);
    for (int k = 0; k < 3; ++k) {
        colour += glm::vec4(mesh_.wedges[piece_[hit.triangle].wedges[k]].colour) * hit.weights[k];
    }
    return glm::u8vec4(glm::clamp(colour, 0.0f, 255.0f));
}

double PieceSurface::density(std::uint32_t triangle) const {
    const MeshTriangle& t = piece_[triangle];
    const int texture = mesh_.surfaces[mesh_.wedges[t.wedges.x].surface].texture;
    return std::sqrt(texelArea(mesh_, t, *textures_.textures[static_cast<std::size_t>(texture)]) /
                     gridArea(mesh_, t));
}

glm::u8vec4 PieceSurface::colourAt(const Hit& hit, double sideGridUnits) const {
    const glm::u8vec4 vertex = vertexColourAt(hit);
    const Surface& surface = mesh_.surfaces[surfaceOf(hit)];
    if (surface.texture < 0) return vertex;
    TextureLevels& texture = *textures_.textures[static_cast<std::size_t>(surface.texture)];
    const auto footprint = static_cast<float>(density(hit.triangle) * sideGridUnits);
    glm::vec4 colour = sampleTexture(texture, uvAt(hit), footprint);
    if (!surface.alphaMask) colour.w = 255.0f;
    return glm::u8vec4(glm::clamp(colour * glm::vec4(vertex) / 255.0f + 0.5f, 0.0f, 255.0f));
}

}  // namespace fb
