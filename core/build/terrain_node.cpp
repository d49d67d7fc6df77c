#include "build/terrain_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "build/make_atlas.h"
#include "build/terrain_error.h"
#include "build/terrain_skirts.h"

namespace fb {
namespace {

// Above this many texels in the whole picture, automatic coding takes JPEG even for a lossless file.
constexpr std::uint64_t kLosslessDrapeTexels = 4'000'000;

// Where a tile's texture lies in a level of the picture.
struct DrapeRect {
    std::uint32_t level = 0;
    std::int64_t column = 0, row = 0;
    int width = 0, height = 0;
};

struct TexelRange {
    std::int64_t first = 0;
    std::uint32_t needed = 0;
};

// Texels around samples `from` to `to`, one more at both ends.
TexelRange texelsBetween(double first, double perCell, std::uint32_t from, std::uint32_t to,
                         std::uint32_t level) {
    const double scale = std::ldexp(1.0, -static_cast<int>(level));
    const double low = std::floor((first + perCell * from) * scale) - 1.0;
    const double high = std::ceil((first + perCell * to) * scale) + 1.0;
    return {static_cast<std::int64_t>(low), static_cast<std::uint32_t>(high - low)};
}

DrapeRect drapeRect(const TerrainLook& look, const TerrainLayout& layout, const TileMesh& mesh,
                    std::uint32_t level) {
    DrapeRect rect;
    rect.level = std::min(look.leafDrapeLevel + layout.depth - level, look.drape.levels() - 1);
    const auto across = texelsBetween(look.info.drapeFirst.x, look.info.texelsPerCell.x, mesh.firstColumn,
                                      mesh.lastColumn, rect.level);
    const auto down = texelsBetween(look.info.drapeFirst.y, look.info.texelsPerCell.y, mesh.firstRow,
                                    mesh.lastRow, rect.level);
    rect.column = across.first;
    rect.row = down.first;
    rect.width = static_cast<int>(atlasSide(across.needed));
    rect.height = static_cast<int>(atlasSide(down.needed));
    return rect;
}

std::uint16_t unorm16(double value) {
    return static_cast<std::uint16_t>(std::floor(std::clamp(value, 0.0, 1.0) * 65535.0 + 0.5));
}

NodeVertex nodeVertex(const TerrainBuild& build, const TerrainLook& look, const DrapeRect& rect,
                      const TileVertex& v) {
    const glm::ivec3 at = build.grid.at(v.across, v.down, v.height);
    NodeVertex vertex{};
    vertex.x = static_cast<std::uint32_t>(at.x);
    vertex.y = static_cast<std::uint32_t>(at.y);
    vertex.z = static_cast<std::uint32_t>(at.z);
    encodeNormal(build.grid.direction(v.normal), vertex.normal);
    glm::vec4 colour(1.0f);
    if (look.drape.isThere()) {
        const double scale = std::ldexp(1.0, -static_cast<int>(rect.level));
        const glm::dvec2 texel =
            (look.info.drapeFirst + look.info.texelsPerCell * glm::dvec2(v.column, v.row)) * scale;
        vertex.u = unorm16((texel.x - static_cast<double>(rect.column)) / rect.width);
        vertex.v = unorm16((texel.y - static_cast<double>(rect.row)) / rect.height);
    } else {
        colour = surfaceColour(nullptr, false);
    }
    for (int c = 0; c < 4; ++c) vertex.colour[c] = static_cast<std::uint8_t>(colour[c] * 255.0f + 0.5f);
    return vertex;
}

float roundUpward(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value
               ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
               : rounded;
}

// Bounds of everything, skirts too; area, benefit and normal of the surface alone.
void measureTile(const TerrainBuild& build, const NodeMesh& mesh, BuiltNode& node) {
    const double step = build.grid.grid.step;
    glm::dvec3 normals(0.0), low(std::numeric_limits<double>::max()),
        high(std::numeric_limits<double>::lowest());
    double area = 0.0;
    std::uint32_t surface = 0;
    const auto place = [&](std::size_t i) {
        const NodeVertex& v = mesh.vertices[mesh.indices[i]];
        return glm::dvec3(v.x, v.y, v.z);
    };
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const glm::dvec3 a = place(t * 3), b = place(t * 3 + 1), c = place(t * 3 + 2);
        for (const glm::dvec3& corner : {a, b, c}) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        if (mesh.isSkirt(t)) continue;
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        normals += 0.5 * cross;
        area += 0.5 * std::sqrt(glm::dot(cross, cross));
        ++surface;
    }
    node.texturedTriangles = mesh.texturedTriangles;
    node.untexturedTriangles = mesh.untexturedTriangles;
    node.skirtTriangles = mesh.texturedSkirts + mesh.untexturedSkirts;
    node.vertices = static_cast<std::uint32_t>(mesh.vertices.size());
    const double squareMetres = area * step * step;
    node.areaSquareMetres = static_cast<float>(squareMetres);
    node.staticBenefit = static_cast<float>(std::sqrt(surface * squareMetres));
    const double length = std::sqrt(glm::dot(normals, normals));
    node.averageNormal = length < 1e-3 * area ? glm::vec3(0.0f) : glm::vec3(normals / length);
    node.normalCoherence = static_cast<float>(std::min(1.0, length / area));
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = build.grid.grid.origin[axis];
        node.bounds.min[axis] = -roundUpward(-(origin + step * low[axis]));
        node.bounds.max[axis] = roundUpward(origin + step * high[axis]);
    }
}

Result<NodeTexture> textureOf(const TerrainLook& look, const DrapeRect& rect) {
    Result<Image> image = look.drape.read(rect.level, rect.column, rect.row, rect.width, rect.height);
    if (!image) return passOn(image);
    const std::uint64_t texels = std::uint64_t(look.info.drapeWidth) * std::uint64_t(look.info.drapeHeight);
    const bool lossless = look.settings.textureCodec == TextureCodec::lossless ||
                          (look.settings.textureCodec == TextureCodec::automatic && look.info.drapeLossless &&
                           texels <= kLosslessDrapeTexels);
    return encodeTexture(*image, lossless ? PayloadCodec::png : PayloadCodec::jpeg,
                         static_cast<int>(look.settings.jpegQuality));
}

}  // namespace

std::uint32_t leafDrapeLevel(const TerrainInfo& info, const TerrainLayout& layout,
                             const BuildSettings& settings) {
    std::uint32_t level = 0;
    const double texels = std::max(info.texelsPerCell.x, info.texelsPerCell.y) * layout.leafCells();
    // Up to two texels more at both ends; sides are rounded up by less than half.
    while (atlasSide(static_cast<std::uint32_t>(
               std::min(1e6, std::ceil(std::ldexp(texels, -static_cast<int>(level)))) + 4.0)) >
           static_cast<std::uint64_t>(settings.maxTextureSide)) {
        ++level;
    }
    return level;
}

Result<TerrainNode> makeTerrainNode(const TerrainBuild& build, const TerrainLook& look,
                                    const TerrainTile& tile) {
    Result<TileMesh> mesh = makeTile(build, tile);
    if (!mesh) return passOn(mesh);
    TerrainNode node;
    node.record.stuck = mesh->stuck;
    DrapeRect rect;
    if (look.drape.isThere()) {
        rect = drapeRect(look, build.layout, *mesh, tile.level);
        Result<NodeTexture> texture = textureOf(look, rect);
        if (!texture) return passOn(texture);
        node.data.texture = std::move(*texture);
        node.record.textureWidth = node.data.texture.width;
        node.record.textureHeight = node.data.texture.height;
    }
    const double step = build.grid.grid.step;
    if (tile.level < build.layout.depth) {
        Result<double> error = terrainError(build.heights, build.grid, *mesh);
        if (!error) return passOn(error);
        node.record.geometricErrorMetres = roundUpward(*error * step);
    }
    const auto surfaceTriangles = static_cast<std::uint32_t>(mesh->triangles.size());
    Result<double> gap = hangSkirts(build, *mesh);
    if (!gap) return passOn(gap);
    node.record.borderErrorMetres = roundUpward(*gap * step);
    NodeMesh& made = node.data.mesh;
    for (const TileVertex& v : mesh->vertices) made.vertices.push_back(nodeVertex(build, look, rect, v));
    for (const glm::uvec3& t : mesh->triangles) made.indices.insert(made.indices.end(), {t.x, t.y, t.z});
    const auto triangles = static_cast<std::uint32_t>(mesh->triangles.size());
    (look.drape.isThere() ? made.texturedTriangles : made.untexturedTriangles) = triangles;
    (look.drape.isThere() ? made.texturedSkirts : made.untexturedSkirts) = triangles - surfaceTriangles;
    measureTile(build, made, node.record);
    return node;
}

}  // namespace fb
