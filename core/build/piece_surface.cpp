#include "build/piece_surface.h"

#include <cmath>

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
    return TriangleColours(*this, hit.triangle, sideGridUnits).at(hit.weights);
}

TriangleColours::TriangleColours(const PieceSurface& surface, std::uint32_t triangle, double sideGridUnits) {
    const BlockMesh& mesh = surface.mesh_;
    const MeshTriangle& t = surface.piece_[triangle];
    for (int k = 0; k < 3; ++k) {
        colours_[static_cast<std::size_t>(k)] = glm::vec4(mesh.wedges[t.wedges[k]].colour);
        uvs_[static_cast<std::size_t>(k)] = mesh.wedges[t.wedges[k]].uv;
    }
    oneColour_ = colours_[0] == colours_[1] && colours_[0] == colours_[2];
    const Surface& material = mesh.surfaces[mesh.wedges[t.wedges.x].surface];
    if (material.texture < 0) return;
    hasHoles_ = material.alphaMask;
    texture_.emplace(*surface.textures_.textures[static_cast<std::size_t>(material.texture)],
                     static_cast<float>(surface.density(triangle) * sideGridUnits));
}

glm::u8vec4 TriangleColours::at(const glm::vec3& weights) const {
    glm::vec4 vertex = colours_[0];
    if (!oneColour_) {
        vertex = colours_[0] * weights.x + colours_[1] * weights.y + colours_[2] * weights.z;
        vertex = glm::floor(glm::clamp(vertex + 0.5f, 0.0f, 255.0f));
    }
    if (!texture_) return glm::u8vec4(vertex);
    glm::vec4 colour = texture_->at(uvs_[0] * weights.x + uvs_[1] * weights.y + uvs_[2] * weights.z);
    if (!hasHoles_) colour.w = 255.0f;
    return glm::u8vec4(glm::clamp(colour * vertex / 255.0f + 0.5f, 0.0f, 255.0f));
}

}  // namespace fb
