#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "import/first_appearance.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/parse_text.h"
#include "import/ply_body.h"
#include "import/ply_header.h"
#include "import/textures_of_file.h"

namespace fb {
namespace {

// Where the properties of an element are, by what they mean; kNone for those that it lacks.
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::size_t findProperty(const PlyElement& element, std::initializer_list<std::string_view> names,
                         bool isList) {
    for (const std::string_view name : names) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (element.properties[i].isList == isList && lowerCase(element.properties[i].name) == name)
                return i;
        }
    }
    return kNone;
}

struct ColourProperties {
    std::size_t red, green, blue, alpha;

    explicit ColourProperties(const PlyElement& e)
        : red(findProperty(e, {"red", "diffuse_red", "r"}, false)),
          green(findProperty(e, {"green", "diffuse_green", "g"}, false)),
          blue(findProperty(e, {"blue", "diffuse_blue", "b"}, false)),
          alpha(findProperty(e, {"alpha", "diffuse_alpha", "a"}, false)) {}

    [[nodiscard]] bool present() const { return red != kNone && green != kNone && blue != kNone; }

    [[nodiscard]] glm::u8vec4 of(const PlyElement& e, const PlyRow& row) const {
        return {channel(e, row, red), channel(e, row, green), channel(e, row, blue),
                alpha == kNone ? std::uint8_t{255} : channel(e, row, alpha)};
    }

  private:
    // Reals go from 0 to 1, 16 bits to 65535, other integers to 255.
    static std::uint8_t channel(const PlyElement& e, const PlyRow& row, std::size_t at) {
        const PlyType type = e.properties[at].type;
        const bool is16Bit = type == PlyType::uint16 || type == PlyType::int16;
        return toByte(row.scalars[at] / (isReal(type) ? 1.0 : is16Bit ? 65535.0 : 255.0));
    }
};

// Faces as the file has them; vertices may follow behind them.
struct Faces {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint64_t> firstCorner;  // one a face
    std::vector<glm::vec2> uvs;          // one a corner, turned to our convention; empty if no face has any
    std::vector<bool> hasUvs;            // one a face, likewise
    std::vector<glm::u8vec4> colours;    // one a face, or empty
    std::vector<std::int64_t> textures;  // one a face, or empty
    std::vector<std::vector<std::int64_t>> strips;

    [[nodiscard]] std::uint64_t endOf(std::size_t face) const {
        return face + 1 < firstCorner.size() ? firstCorner[face + 1] : corners.size();
    }
};

class PlyReader {
  public:
    PlyReader(const MeshBytes& input, const PlyHeader& header, ImportReport& report)
        : input_(input),
          header_(header),
          report_(report),
          body_(input, header),
          textures_(input, file_, report) {}

    Result<MeshFile> read() {
        for (const PlyElement& element : header_.elements) {
            if (Result<void> taken = takeElement(element); !taken) return passOn(taken);
        }
        if (!hasVertices_) return input_.failure({}, "has no element 'vertex'");
        if (body_.hasMore()) {
            report_.warnings.push_back(input_.file.filename().string() +
                                       ": what stands behind the last element was left out (" +
                                       body_.place() + ")");
        }
        addMaterials();
        if (Result<void> built = build(); !built) return passOn(built);
        textures_.reportMissing();
        file_.groups.clear();
        return std::move(file_);
    }

  private:
    // Calls take(row) for every row.
    template <class Take>
    Result<void> forRows(const PlyElement& element, const Take& take) {
        PlyRow row;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (Result<void> read = body_.readRow(element, row); !read) return read;
            if (Result<void> taken = take(row); !taken) return taken;
        }
        return {};
    }

    Result<void> takeElement(const PlyElement& element) {
        if (element.properties.empty()) return {};
        if (Result<void> checked = body_.checkCount(element); !checked) return checked;
        if (element.name == "vertex") return takeVertices(element);
        const std::size_t indices = findProperty(element, {"vertex_indices", "vertex_index"}, true);
        if (element.name == "face" && indices != kNone) return takeFaces(element, indices);
        if (element.name == "tristrips" && indices != kNone) return takeStrips(element, indices);
        if (element.name == "edge" || element.name == "face") report_.ignoredElements += element.count;
        return forRows(element, [](const PlyRow&) { return Result<void>{}; });
    }

    Result<void> takeVertices(const PlyElement& e) {
        const std::size_t x = findProperty(e, {"x"}, false), y = findProperty(e, {"y"}, false),
                          z = findProperty(e, {"z"}, false);
        const std::size_t nx = findProperty(e, {"nx"}, false), ny = findProperty(e, {"ny"}, false),
                          nz = findProperty(e, {"nz"}, false);
        const std::size_t u = findProperty(e, {"u", "s", "texture_u", "texture_s"}, false),
                          v = findProperty(e, {"v", "t", "texture_v", "texture_t"}, false);
        const ColourProperties colour(e);
        if (hasVertices_) return input_.failure(body_.place(), "has two elements 'vertex'");
        if (x == kNone || y == kNone || z == kNone)
            return input_.failure({}, "its vertices have no x, y and z");
        if (e.count > kMaxVertices) return input_.failure({}, "has more vertices than can be read");
        const bool hasNormals = nx != kNone && ny != kNone && nz != kNone, hasUvs = u != kNone && v != kNone;
        hasVertices_ = true;
        vertexCount_ = e.count;
        verticesHaveUvs_ = hasUvs;
        vertices_.positions.reserve(e.count);
        return forRows(e, [&](const PlyRow& row) -> Result<void> {
            const std::vector<double>& n = row.scalars;
            vertices_.positions.emplace_back(n[x], n[y], n[z]);
            if (hasNormals) vertices_.normals.emplace_back(glm::dvec3(n[nx], n[ny], n[nz]));
            if (hasUvs) vertices_.uvs.emplace_back(glm::dvec2(n[u], 1.0 - n[v]));
            if (colour.present()) vertices_.colours.push_back(colour.of(e, row));
            return {};
        });
    }

    Result<void> takeFaces(const PlyElement& e, std::size_t indices) {
        const std::size_t uvs = findProperty(e, {"texcoord"}, true);
        const std::size_t texture = findProperty(e, {"texnumber"}, false);
        const ColourProperties colour(e);
        if (hasFaces_) return input_.failure(body_.place(), "has two elements 'face'");
        hasFaces_ = true;
        faces_.corners.reserve(3 * e.count);
        faces_.firstCorner.reserve(e.count);
        return forRows(e, [&](const PlyRow& row) -> Result<void> {
            faces_.firstCorner.push_back(faces_.corners.size());
            for (const double index : row.lists[indices]) {
                // Held against the number of vertices in build(): they may stand behind the faces.
                if (!(index >= 0.0 && index <= 4294967295.0 && index == std::floor(index)))
                    return wrongIndex(index);
                faces_.corners.push_back(static_cast<std::uint32_t>(index));
            }
            if (uvs != kNone) takeFaceUvs(row.lists[uvs], row.lists[indices].size());
            if (colour.present()) faces_.colours.push_back(colour.of(e, row));
            if (texture != kNone) faces_.textures.push_back(toWhole(row.scalars[texture]));
            return {};
        });
    }

    // Two numbers a corner; a face with another number of them has none.
    void takeFaceUvs(const std::vector<double>& numbers, std::size_t corners) {
        const bool has = numbers.size() == 2 * corners;
        faces_.hasUvs.push_back(has);
        for (std::size_t c = 0; c < corners; ++c) {
            faces_.uvs.emplace_back(has ? glm::dvec2(numbers[2 * c], 1.0 - numbers[2 * c + 1])
                                        : glm::dvec2(0.0));
        }
    }

    // Strips of scanners: one list, -1 begins the next strip.
    Result<void> takeStrips(const PlyElement& e, std::size_t indices) {
        return forRows(e, [&](const PlyRow& row) -> Result<void> {
            faces_.strips.emplace_back();
            for (const double index : row.lists[indices]) {
                if (!(index >= -1.0 && index <= 4294967295.0 && index == std::floor(index)))
                    return wrongIndex(index);
                if (index < 0.0) {
                    faces_.strips.emplace_back();
                } else {
                    faces_.strips.back().push_back(static_cast<std::int64_t>(index));
                }
            }
            return {};
        });
    }

    static std::int64_t toWhole(double value) {
        return std::abs(value) < 1e9 ? static_cast<std::int64_t>(value) : std::int64_t{-1};
    }

    [[nodiscard]] tl::unexpected<Error> wrongIndex(double index) const {
        return input_.failure(
            body_.place(), "a face refers to vertex " + shown(index) + " of " + std::to_string(vertexCount_));
    }

    static std::string shown(double index) {
        std::string text = std::to_string(index);
        return text.substr(0, index == std::floor(index) ? text.find('.') : text.size());
    }

    // One material for each texture that the header names.
    void addMaterials() {
        if (header_.textureFiles.empty()) return;
        if (!verticesHaveUvs_ && faces_.uvs.empty()) {
            report_.warnings.push_back(input_.file.filename().string() +
                                       " names a texture, but has no texture coordinates: it is not used");
            return;
        }
        if (header_.textureFiles.size() > 1 && faces_.textures.empty()) {
            report_.warnings.push_back(
                input_.file.filename().string() +
                " names several textures, but not which face has which: the first is used");
        }
        for (const std::string& name : header_.textureFiles) {
            SourceMaterial material;
            material.name = name;
            file_.block.materials.push_back(material);
            textures_.give(static_cast<std::uint32_t>(file_.block.materials.size() - 1), name);
        }
    }

    [[nodiscard]] std::uint32_t materialOf(std::size_t face) const {
        if (file_.block.materials.empty()) return kNoMaterial;
        if (!verticesHaveUvs_ && !faces_.hasUvs[face]) return kNoMaterial;
        if (faces_.textures.empty()) return 0;
        const std::int64_t texture = faces_.textures[face];
        const auto count = static_cast<std::int64_t>(file_.block.materials.size());
        return texture >= 0 && texture < count ? static_cast<std::uint32_t>(texture) : kNoMaterial;
    }

    Result<void> build() {
        SourceMesh& mesh = file_.block.mesh;
        for (const std::uint32_t corner : faces_.corners) {
            if (corner >= vertexCount_) return wrongIndex(corner);
        }
        if (faces_.uvs.empty() && faces_.colours.empty()) {
            mesh = std::move(vertices_);
            for (std::size_t f = 0; f < faces_.firstCorner.size(); ++f) {
                const std::span<const std::uint32_t> corners(faces_.corners);
                const std::uint64_t first = faces_.firstCorner[f];
                addPolygon(file_, corners.subspan(first, faces_.endOf(f) - first), materialOf(f), 0, report_);
            }
        } else {
            buildByCorner();
        }
        return addStrips();
    }

    // Corners of one vertex may differ in colour and texture coordinates: each combination becomes a vertex.
    void buildByCorner() {
        FirstAppearance<4> numbers(vertices_.positions.size());
        std::vector<std::uint32_t> corners;
        for (std::size_t f = 0; f < faces_.firstCorner.size(); ++f) {
            corners.clear();
            for (std::uint64_t c = faces_.firstCorner[f]; c < faces_.endOf(f); ++c) {
                corners.push_back(vertexOf(faces_.corners[c], c, f, numbers));
            }
            addPolygon(file_, corners, materialOf(f), 0, report_);
        }
        if (faces_.strips.empty()) return;
        // Strips know no corners: they get vertices of their own behind the others.
        stripBase_ = file_.block.mesh.positions.size();
        for (std::uint32_t v = 0; v < vertices_.positions.size(); ++v) addVertex(v, kNone, kNone);
    }

    std::uint32_t vertexOf(std::uint32_t vertex, std::uint64_t corner, std::size_t face,
                           FirstAppearance<4>& numbers) {
        const glm::vec2 uv = faces_.uvs.empty() ? glm::vec2(0.0f) : faces_.uvs[corner];
        const std::uint32_t colour =
            faces_.colours.empty() ? 0 : std::bit_cast<std::uint32_t>(faces_.colours[face]);
        const std::uint32_t number = numbers.numberOf(
            {vertex, std::bit_cast<std::uint32_t>(uv.x), std::bit_cast<std::uint32_t>(uv.y), colour});
        if (number == file_.block.mesh.positions.size()) {
            addVertex(vertex, faces_.uvs.empty() ? kNone : corner, faces_.colours.empty() ? kNone : face);
        }
        return number;
    }

    void addVertex(std::uint32_t vertex, std::uint64_t corner, std::size_t face) {
        SourceMesh& mesh = file_.block.mesh;
        mesh.positions.push_back(vertices_.positions[vertex]);
        if (vertices_.hasNormals()) mesh.normals.push_back(vertices_.normals[vertex]);
        if (corner != kNone) {
            mesh.uvs.push_back(faces_.uvs[corner]);
        } else if (vertices_.hasUvs()) {
            mesh.uvs.push_back(vertices_.uvs[vertex]);
        } else if (!faces_.uvs.empty()) {
            mesh.uvs.emplace_back(0.0f);
        }
        if (face != kNone) {
            mesh.colours.push_back(faces_.colours[face]);
        } else if (vertices_.hasColours()) {
            mesh.colours.push_back(vertices_.colours[vertex]);
        } else if (!faces_.colours.empty()) {
            mesh.colours.emplace_back(255);
        }
    }

    Result<void> addStrips() {
        SourceMesh& mesh = file_.block.mesh;
        const bool textured = !file_.block.materials.empty() && mesh.hasUvs() && faces_.uvs.empty();
        for (const std::vector<std::int64_t>& strip : faces_.strips) {
            for (const std::int64_t index : strip) {
                if (static_cast<std::uint64_t>(index) >= vertexCount_)
                    return wrongIndex(static_cast<double>(index));
            }
            const std::size_t before = mesh.triangles.size();
            addStrip(mesh, strip.size(), [&](std::size_t i) {
                return static_cast<std::uint32_t>(static_cast<std::uint64_t>(strip[i]) + stripBase_);
            });
            report_.sourceTriangles += mesh.triangles.size() - before;
        }
        mesh.materials.resize(mesh.triangles.size(), textured ? 0 : kNoMaterial);
        return {};
    }

    const MeshBytes& input_;
    const PlyHeader& header_;
    ImportReport& report_;
    PlyBody body_;
    MeshFile file_;
    TexturesOfFile textures_;
    SourceMesh vertices_;
    Faces faces_;
    std::uint64_t vertexCount_ = 0;
    std::size_t stripBase_ = 0;
    bool hasVertices_ = false, hasFaces_ = false, verticesHaveUvs_ = false;
};

}  // namespace

Result<MeshFile> readPly(const MeshBytes& input, ImportReport& report) {
    Result<PlyHeader> header = parsePlyHeader(input);
    if (!header) return passOn(header);
    return PlyReader(input, *header, report).read();
}

}  // namespace fb
