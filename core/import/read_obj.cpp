#include <cmath>
#include <map>

#include "base/file_io.h"
#include "import/find_beside.h"
#include "import/first_appearance.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/parse_obj_text.h"
#include "import/parse_text.h"
#include "import/read_mtl.h"
#include "import/textures_of_file.h"

namespace fb {
namespace {

constexpr glm::vec4 kUndefinedColour(0.8f, 0.8f, 0.8f, 1.0f);

struct Libraries {
    std::map<std::string, MtlMaterial, std::less<>> materials;
    bool complete = true;  // every library was found
};

// A line after mtllib names one file, possibly with blanks, or several without.
std::vector<std::string> namesOfLibraries(const std::filesystem::path& model, std::string_view line) {
    if (!findBeside(model, line).file.empty()) return {std::string(line)};
    std::vector<std::string> names;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
        names.emplace_back(word);
    return names;
}

Libraries readLibraries(const MeshBytes& input, const ObjText& text, MeshFile& into, ImportReport& report) {
    Libraries libraries;
    std::map<std::string, bool> seen;
    for (const std::string& line : text.materialLibraries) {
        for (const std::string& name : namesOfLibraries(input.file, line)) {
            if (!seen.try_emplace(name).second) continue;
            const FoundFile found = findBeside(input.file, name);
            std::string why = found.why;
            if (!found.file.empty()) {
                const Result<std::vector<std::uint8_t>> bytes = readFile(found.file, kMaxMaterialFileBytes);
                if (bytes) {
                    into.otherFiles.push_back(found.file);
                    for (MtlMaterial& material : parseMtl(MeshBytes{found.file, *bytes}.text())) {
                        libraries.materials.try_emplace(material.name, material);
                    }
                    continue;
                }
                why = bytes.error().reason;
            }
            libraries.complete = false;
            report.warnings.push_back("material file " + inQuotes(name) + " " + why +
                                      ": its materials are drawn grey, without texture");
        }
    }
    return libraries;
}

class ObjReader {
  public:
    ObjReader(const MeshBytes& input, const ObjText& text, ImportReport& report)
        : input_(input),
          text_(text),
          report_(report),
          textures_(input, file_, report),
          twins_(file_.block),
          numbers_(text.positions.size()) {}

    Result<MeshFile> read() {
        addMaterials();
        hasUvs_ = hasNormals_ = false;
        for (const ObjText::Corner& corner : text_.corners) {
            hasUvs_ = hasUvs_ || corner.uv != ObjText::kAbsent;
            hasNormals_ = hasNormals_ || corner.normal != ObjText::kAbsent;
        }
        for (const glm::vec3& c : text_.colours) {
            // Some programs write 0 to 255 instead of 0 to 1.
            if (c.x > 1.0f || c.y > 1.0f || c.z > 1.0f) colourScale_ = 1.0 / 255.0;
        }
        std::vector<std::uint32_t> corners;
        for (std::size_t f = 0; f < text_.faces.size(); ++f) {
            const ObjText::Face& face = text_.faces[f];
            const std::uint64_t end =
                f + 1 < text_.faces.size() ? text_.faces[f + 1].firstCorner : text_.corners.size();
            corners.clear();
            bool everyCornerHasUv = true;
            for (std::uint64_t c = face.firstCorner; c < end; ++c) {
                Result<std::uint32_t> vertex = vertexOf(text_.corners[c], face);
                if (!vertex) return passOn(vertex);
                corners.push_back(*vertex);
                everyCornerHasUv = everyCornerHasUv && text_.corners[c].uv != ObjText::kAbsent;
            }
            addPolygon(file_, corners, materialOf(face, everyCornerHasUv), face.group, report_);
            if (file_.block.mesh.triangles.size() > kMaxTriangles) return tooLarge(face);
        }
        textures_.reportMissing();
        reportUndefined();
        file_.groupNames = text_.groupNames;
        return std::move(file_);
    }

  private:
    void addMaterials() {
        const Libraries libraries = readLibraries(input_, text_, file_, report_);
        nameUndefined_ = libraries.complete;
        for (const std::string& name : text_.materialNames) {
            SourceMaterial material;
            material.name = name;
            const auto found = libraries.materials.find(name);
            const bool defined = found != libraries.materials.end();
            material.baseColour = defined ? found->second.colour : kUndefinedColour;
            file_.block.materials.push_back(material);
            layOn_.push_back(defined ? found->second : MtlMaterial{});
            undefined_.push_back(!defined);
            if (!defined) continue;
            const auto index = static_cast<std::uint32_t>(file_.block.materials.size() - 1);
            if (!found->second.texture.empty()) textures_.give(index, found->second.texture);
            takeAlphaTexture(found->second, file_.block.materials.back());
        }
    }

    // One texture holds colour and holes; a separate map of holes cannot be kept.
    void takeAlphaTexture(const MtlMaterial& from, SourceMaterial& material) {
        if (from.alphaTexture.empty()) return;
        if (from.alphaTexture == from.texture) {
            material.alphaMask = material.texture >= 0;
        } else {
            report_.warnings.push_back("material " + inQuotes(from.name) + ": its opacity texture " +
                                       inQuotes(from.alphaTexture) +
                                       " is not used, only the alpha of map_Kd is");
        }
    }

    void reportUndefined() {
        if (!nameUndefined_) return;  // a whole library is missing, which has been said
        const std::vector<std::uint64_t> counts = trianglesByMaterial(file_.block);
        for (std::size_t m = 0; m < undefined_.size(); ++m) {
            if (!undefined_[m]) continue;
            report_.warnings.push_back("material " + inQuotes(text_.materialNames[m]) +
                                       " is not defined: " + trianglesAre(counts[m]) + " drawn grey");
        }
    }

    std::uint32_t materialOf(const ObjText::Face& face, bool everyCornerHasUv) {
        if (face.material == ObjText::kAbsent) return kNoMaterial;
        return everyCornerHasUv ? face.material : twins_.of(face.material);
    }

    Result<std::uint32_t> vertexOf(const ObjText::Corner& corner, const ObjText::Face& face) {
        const bool hasUv = corner.uv != ObjText::kAbsent, hasNormal = corner.normal != ObjText::kAbsent;
        if (corner.position >= text_.positions.size()) return outOfRange("vertex", corner.position, face);
        if (hasUv && corner.uv >= text_.uvs.size()) return outOfRange("texture coordinate", corner.uv, face);
        if (hasNormal && corner.normal >= text_.normals.size())
            return outOfRange("normal", corner.normal, face);
        const bool laidOn = hasUv && face.material != ObjText::kAbsent && isLaidOn(layOn_[face.material]);
        const std::uint32_t number =
            numbers_.numberOf({corner.position, corner.uv, corner.normal, laidOn ? face.material + 1 : 0});
        if (number == file_.block.mesh.positions.size()) {
            if (!isUsablePosition(text_.positions[corner.position])) {
                return input_.failure(
                    "line " + std::to_string(face.line),
                    "the face refers to vertex " + std::to_string(corner.position + 1) +
                        ", which has a coordinate that is not a finite number, or above 1e15");
            }
            addVertex(corner, laidOn ? &layOn_[face.material] : nullptr);
        }
        return number;
    }

    static bool isLaidOn(const MtlMaterial& material) {
        return material.uvScale != glm::vec2(1.0f) || material.uvOffset != glm::vec2(0.0f);
    }

    void addVertex(const ObjText::Corner& corner, const MtlMaterial* laidOn) {
        SourceMesh& mesh = file_.block.mesh;
        mesh.positions.push_back(text_.positions[corner.position]);
        if (hasNormals_) {
            mesh.normals.push_back(corner.normal == ObjText::kAbsent ? glm::vec3(0.0f)
                                                                     : text_.normals[corner.normal]);
        }
        if (hasUvs_) {
            glm::vec2 uv = corner.uv == ObjText::kAbsent ? glm::vec2(0.0f) : text_.uvs[corner.uv];
            if (laidOn != nullptr) {
                const glm::vec2 fromBottom =
                    glm::vec2(uv.x, 1.0f - uv.y) * laidOn->uvScale + laidOn->uvOffset;
                uv = {fromBottom.x, 1.0f - fromBottom.y};
            }
            mesh.uvs.push_back(uv);
        }
        if (!text_.colours.empty()) mesh.colours.push_back(colourOf(text_.colours[corner.position]));
    }

    glm::u8vec4 colourOf(const glm::vec3& colour) const {
        if (!(colour.x >= 0.0f)) return glm::u8vec4(255);
        return {toByte(colour.x * colourScale_), toByte(colour.y * colourScale_),
                toByte(colour.z * colourScale_), 255};
    }

    [[nodiscard]] tl::unexpected<Error> outOfRange(const char* what, std::uint32_t index,
                                                   const ObjText::Face& face) const {
        return input_.failure("line " + std::to_string(face.line), "the face refers to " + std::string(what) +
                                                                       " " + std::to_string(index + 1) +
                                                                       ", which the file does not have");
    }
    [[nodiscard]] tl::unexpected<Error> tooLarge(const ObjText::Face& face) const {
        return input_.failure("line " + std::to_string(face.line), "has more triangles than can be read",
                              "cut it into several files");
    }

    const MeshBytes& input_;
    const ObjText& text_;
    ImportReport& report_;
    MeshFile file_;
    TexturesOfFile textures_;
    UntexturedTwins twins_;
    FirstAppearance<4> numbers_;
    std::vector<MtlMaterial> layOn_;  // by material
    std::vector<bool> undefined_;
    bool nameUndefined_ = true, hasUvs_ = false, hasNormals_ = false;
    double colourScale_ = 1.0;
};

}  // namespace

Result<MeshFile> readObj(const MeshBytes& input, ImportReport& report) {
    Result<ObjText> text = parseObjText(input, report);
    if (!text) return passOn(text);
    return ObjReader(input, *text, report).read();
}

}  // namespace fb
