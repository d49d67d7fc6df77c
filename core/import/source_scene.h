// What importing produces and building takes: one block of the source at a time, meshes in double precision.
// Comes from the readers of this folder or from the procedural city; goes to build/ (thesis ch. 3).
// Positions are metres relative to SourceInfo::origin, axes as in the source file; `up` says which axis is up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/result.h"

namespace fb {

enum class UpAxis : std::uint8_t { y, z };

// 8-bit pixels, row 0 at the top, channels 1 to 4, tightly packed.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> pixels;
    bool lossless = false;  // decoded from a lossless format (PNG, TIFF, …), or generated
};

// A texture that is decoded when it is needed: from a file, from bytes inside a model file, or already pixels.
struct SourceTexture {
    std::string name;
    std::filesystem::path file;                      // used when not empty
    std::vector<std::uint8_t> encoded;               // else these bytes (PNG, JPEG, …)
    std::shared_ptr<const Image> image;              // else these pixels
};

struct SourceMaterial {
    std::string name;
    glm::vec4 baseColour{1.0f};  // multiplied with texture and vertex colour; sRGB as in the file, alpha linear
    int texture = -1;            // index into SourceBlock::textures, -1 for none
    bool alphaMask = false;      // texels with alpha < 0.5 are holes
};

inline constexpr std::uint32_t kNoMaterial = ~std::uint32_t{0};
// What a surface is tinted with: its material's colour; where it has none, white under vertex colours, and else a light
// grey, since on white no shading would show.
[[nodiscard]] inline glm::vec4 surfaceColour(const SourceMaterial* material, bool hasVertexColours) {
    if (material != nullptr) return glm::clamp(material->baseColour, 0.0f, 1.0f);
    return glm::vec4(glm::vec3(hasVertexColours ? 1.0f : 0.8f), 1.0f);
}

// Triangles over shared vertices. A vertex is one combination of position, normal, texture coordinate and colour:
// two vertices at exactly one position are a seam, not a gap. Vectors of attributes are empty or of the same length
// as positions.
struct SourceMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;         // unit length, or (0,0,0) where unknown
    std::vector<glm::vec2> uvs;             // (0,0) is the top left corner of the texture's row 0; may repeat beyond [0,1]
    std::vector<glm::u8vec4> colours;       // sRGB, alpha linear
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materials;   // one a triangle, index into SourceBlock::materials or kNoMaterial
    std::vector<std::uint8_t> shared;       // one a vertex: 1 where the surface goes on in another block; may be empty

    [[nodiscard]] bool hasNormals() const { return !normals.empty(); }
    [[nodiscard]] bool hasUvs() const { return !uvs.empty(); }
    [[nodiscard]] bool hasColours() const { return !colours.empty(); }
};

struct SourceBlock {
    std::string name;
    SourceMesh mesh;
    std::vector<SourceMaterial> materials;
    std::vector<SourceTexture> textures;
};

// A place worth walking: the built-in paths follow it where a scene has one.
struct WalkHint {
    std::vector<glm::dvec3> points;  // relative to the origin, at ground level
};

// Everything dropped, repaired or missing, counted; each line is told to the user once.
struct ImportReport {
    std::uint64_t sourceTriangles = 0;  // as the files say, polygons triangulated
    std::uint64_t keptTriangles = 0;
    std::uint64_t weldedVertices = 0;
    std::uint64_t degenerateTriangles = 0;
    std::uint64_t duplicateTriangles = 0;
    std::uint64_t droppedVertices = 0;       // used by no triangle that was kept
    std::uint64_t repairedAttributes = 0;    // normals and texture coordinates that were not finite, set to 0
    std::uint64_t ignoredElements = 0;       // points, lines, faces of fewer than 3 corners
    std::vector<std::string> warnings;       // "texture wall.jpg is missing: its 120 triangles are drawn grey"

    void add(const ImportReport& other);
    [[nodiscard]] std::vector<std::string> lines() const;  // for people; empty when nothing was done
};

struct SourceInfo {
    std::string name;
    glm::dvec3 origin{0.0};  // subtracted from every position of the files
    UpAxis up = UpAxis::y;
    Box3d bounds;            // relative to the origin
    std::vector<std::filesystem::path> files;
    std::uint64_t sourceHash = 0;  // of the files' contents or the generator's parameters
    std::vector<WalkHint> walks;
    ImportReport report;
};

class TerrainSource;

// Blocks are made one at a time, so that a scene need not fit into memory. `load` may be called from several threads
// at once and gives the same block for the same index every time.
class BlockSource {
  public:
    virtual ~BlockSource() = default;
    [[nodiscard]] virtual const SourceInfo& info() const = 0;
    [[nodiscard]] virtual std::size_t blockCount() const = 0;
    [[nodiscard]] virtual Result<SourceBlock> load(std::size_t block) const = 0;
    // The ground below, a hierarchy of its own (terrain_source.h); none where there is no height map.
    [[nodiscard]] virtual const TerrainSource* terrain() const { return nullptr; }
};

// Decodes a texture: width, height and channels are checked against caps before any pixel is read; 16-bit, float and
// grey sources become 8-bit; alpha is kept.
[[nodiscard]] Result<Image> loadTexture(const SourceTexture& texture);

// Whether `texture.image` has as many pixels as its size says.
[[nodiscard]] Result<void> checkPixels(const SourceTexture& texture);

// fraction in [0, 1] of phase; returns false to ask the work to stop (Ctrl-C).
using Progress = std::function<bool(std::string_view phase, double fraction)>;

}  // namespace fb
