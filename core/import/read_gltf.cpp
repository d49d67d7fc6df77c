#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <optional>

#include "import/gltf_accessor.h"
#include "import/gltf_materials.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/open_gltf.h"
#include "import/textures_of_file.h"
#include "import/srgb.h"

namespace fb {
namespace {

// Matrix, or translation * rotation * scale (glTF 2.0, section 3.5.3).
glm::dmat4 localTransform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 matrix(1.0);
    if (node.rotation.size() == 4) {
        const std::vector<double>& r = node.rotation;
        matrix = glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
    }
    if (node.scale.size() == 3) {
        for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
    }
    if (node.translation.size() == 3) {
        matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
    }
    return matrix;
}

constexpr std::uint32_t kNew = ~std::uint32_t{0};

struct Placed {
    int node;
    glm::dmat4 parent;
};

// The accessors of one primitive; missing ones are empty.
struct Attributes {
    GltfAccessor positions;
    std::optional<GltfAccessor> normals, uvs, colours, indices;
};

class GltfReader {
  public:
    GltfReader(const MeshBytes& input, const tinygltf::Model& model, MeshFile& file, ImportReport& report)
        : input_(input),
          model_(model),
          file_(file),
          report_(report),
          textures_(input, file, report),
          twins_(file.block) {}

    Result<void> read() {
        uses_ = addGltfMaterials(model_, file_, textures_, report_);
        std::vector<bool> placed(model_.nodes.size(), false);
        std::vector<Placed> left;
        const std::vector<int> roots = rootNodes();
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            left.push_back({*root, glm::dmat4(1.0)});
        while (!left.empty()) {
            const Placed next = left.back();
            left.pop_back();
            if (next.node < 0 || static_cast<std::size_t>(next.node) >= model_.nodes.size()) {
                return input_.failure("node " + std::to_string(next.node), "does not exist");
            }
            const auto index = static_cast<std::size_t>(next.node);
            if (placed[index]) {
                return input_.failure("node " + std::to_string(index),
                                      "has two parents or is its own ancestor");
            }
            placed[index] = true;
            const tinygltf::Node& node = model_.nodes[index];
            const glm::dmat4 transform = next.parent * localTransform(node);
            if (Result<void> added = addMesh(node, index, transform); !added) return added;
            for (auto c = node.children.rbegin(); c != node.children.rend(); ++c)
                left.push_back({*c, transform});
        }
        textures_.reportMissing();
        return {};
    }

  private:
    // Of the scene that the file opens with; in a file without scenes, all that are nobody's children.
    [[nodiscard]] std::vector<int> rootNodes() const {
        if (!model_.scenes.empty()) {
            const bool valid = model_.defaultScene >= 0 &&
                               static_cast<std::size_t>(model_.defaultScene) < model_.scenes.size();
            return model_.scenes[valid ? static_cast<std::size_t>(model_.defaultScene) : 0].nodes;
        }
        std::vector<bool> isChild(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) {
                if (child >= 0 && static_cast<std::size_t>(child) < isChild.size()) {
                    isChild[static_cast<std::size_t>(child)] = true;
                }
            }
        }
        std::vector<int> roots;
        for (std::size_t n = 0; n < isChild.size(); ++n) {
            if (!isChild[n]) roots.push_back(static_cast<int>(n));
        }
        return roots;
    }

    Result<void> addMesh(const tinygltf::Node& node, std::size_t index, const glm::dmat4& transform) {
        if (node.mesh < 0) return {};
        if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
            return input_.failure("node " + std::to_string(index), "refers to a mesh that does not exist");
        }
        const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
        file_.groupNames.push_back(!node.name.empty()   ? node.name
                                   : !mesh.name.empty() ? mesh.name
                                                        : "node " + std::to_string(index));
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::string place =
                "mesh " + std::to_string(node.mesh) + ", primitive " + std::to_string(p);
            if (Result<void> added = addPrimitive(mesh.primitives[p], place, transform); !added) return added;
        }
        return {};
    }

    Result<void> addPrimitive(const tinygltf::Primitive& primitive, const std::string& place,
                              const glm::dmat4& transform) {
        Result<Attributes> opened = openAttributes(primitive, place);
        if (!opened) return passOn(opened);
        const Attributes& a = *opened;
        const std::size_t corners = a.indices ? a.indices->count() : a.positions.count();
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            report_.ignoredElements += corners;  // points and lines, by their corners
            return {};
        }
        std::vector<std::uint32_t> vertices;
        if (Result<void> added = addVertices(a, corners, place, transform, usedBy(primitive), vertices);
            !added) {
            return added;
        }
        SourceMesh& mesh = file_.block.mesh;
        const std::size_t before = mesh.triangles.size();
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
            for (std::size_t c = 2; c < corners; c += 3) {
                mesh.triangles.emplace_back(vertices[c - 2], vertices[c - 1], vertices[c]);
            }
        } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            addStrip(mesh, corners, [&](std::size_t i) { return vertices[i]; });
        } else {
            for (std::size_t c = 2; c < corners; ++c)
                mesh.triangles.emplace_back(vertices[0], vertices[c - 1], vertices[c]);
        }
        // A mirroring transform turns triangles over.
        if (glm::determinant(glm::dmat3(transform)) < 0.0) {
            for (std::size_t t = before; t < mesh.triangles.size(); ++t)
                std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
        }
        if (mesh.triangles.size() > kMaxTriangles || mesh.positions.size() > kMaxVertices) {
            return input_.failure(place, "has more triangles than can be read, its copies counted");
        }
        mesh.materials.resize(mesh.triangles.size(), materialOf(primitive, a.uvs.has_value()));
        file_.groups.resize(mesh.triangles.size(), static_cast<std::uint32_t>(file_.groupNames.size() - 1));
        report_.sourceTriangles += mesh.triangles.size() - before;
        return {};
    }

    [[nodiscard]] bool hasMaterial(const tinygltf::Primitive& primitive) const {
        return primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < uses_.size();
    }
    [[nodiscard]] GltfTextureUse usedBy(const tinygltf::Primitive& primitive) const {
        return hasMaterial(primitive) ? uses_[static_cast<std::size_t>(primitive.material)]
                                      : GltfTextureUse{};
    }
    [[nodiscard]] std::uint32_t materialOf(const tinygltf::Primitive& primitive, bool hasUvs) {
        if (!hasMaterial(primitive)) return kNoMaterial;
        const auto material = static_cast<std::uint32_t>(primitive.material);
        return hasUvs ? material : twins_.of(material);
    }

    Result<Attributes> openAttributes(const tinygltf::Primitive& primitive, const std::string& place) const {
        const auto find = [&](const std::string& name) {
            const auto found = primitive.attributes.find(name);
            return found == primitive.attributes.end() ? -1 : found->second;
        };
        if (find("POSITION") < 0) return input_.failure(place, "has no positions");
        Result<GltfAccessor> positions = GltfAccessor::open(input_, model_, find("POSITION"), 3);
        if (!positions) return passOn(positions);
        Attributes a{*positions, {}, {}, {}, {}};
        struct Wanted {
            std::string name;
            int components;
            std::optional<GltfAccessor>* into;
        };
        for (const Wanted& wanted :
             {Wanted{"NORMAL", 3, &a.normals}, Wanted{"COLOR_0", 3, &a.colours},
              Wanted{"TEXCOORD_" + std::to_string(usedBy(primitive).uvSet), 2, &a.uvs}}) {
            if (find(wanted.name) < 0) continue;
            Result<GltfAccessor> opened =
                GltfAccessor::open(input_, model_, find(wanted.name), wanted.components);
            if (!opened) return passOn(opened);
            if (opened->count() != a.positions.count()) {
                return input_.failure(place, "has not as many " + wanted.name + " as positions");
            }
            *wanted.into = *opened;
        }
        if (primitive.indices >= 0) {
            Result<GltfAccessor> indices = GltfAccessor::open(input_, model_, primitive.indices, 1);
            if (!indices) return passOn(indices);
            a.indices = *indices;
        }
        return a;
    }

    // Adds the vertices that the primitive uses, and gives the vertex of each corner. Accessors may be shared
    // by many primitives that use a part of them each.
    Result<void> addVertices(const Attributes& a, std::size_t corners, const std::string& place,
                             const glm::dmat4& transform, const GltfTextureUse& use,
                             std::vector<std::uint32_t>& vertices) {
        const glm::dmat3 axes(transform);
        const bool invertible = std::abs(glm::determinant(axes)) > 0.0;
        const glm::dmat3 normalAxes = invertible ? glm::transpose(glm::inverse(axes)) : axes;
        if (numbers_.size() < a.positions.count()) numbers_.resize(a.positions.count(), kNew);
        std::vector<std::size_t> used;
        vertices.reserve(corners);
        for (std::size_t c = 0; c < corners; ++c) {
            const std::size_t element = a.indices ? a.indices->index(c) : c;
            if (element >= a.positions.count()) {
                return input_.failure(place, "refers to vertex " + std::to_string(element) + " of " +
                                                 std::to_string(a.positions.count()));
            }
            if (numbers_[element] == kNew) {
                numbers_[element] = static_cast<std::uint32_t>(file_.block.mesh.positions.size());
                addVertex(a, element, transform, normalAxes, use);
                used.push_back(element);
            }
            vertices.push_back(numbers_[element]);
        }
        for (const std::size_t element : used) numbers_[element] = kNew;
        return {};
    }

    void addVertex(const Attributes& a, std::size_t element, const glm::dmat4& transform,
                   const glm::dmat3& normalAxes, const GltfTextureUse& use) {
        SourceMesh& mesh = file_.block.mesh;
        const std::size_t before = mesh.positions.size();
        const auto vector = [&](const GltfAccessor& from) {
            return glm::dvec3(from.number(element, 0), from.number(element, 1), from.number(element, 2));
        };
        mesh.positions.push_back(glm::dvec3(transform * glm::dvec4(vector(a.positions), 1.0)));
        // What an earlier primitive lacked is filled up; what this one lacks as well.
        if (a.normals) {
            mesh.normals.resize(before, glm::vec3(0.0f));
            mesh.normals.emplace_back(normalAxes * vector(*a.normals));
        } else if (mesh.hasNormals()) {
            mesh.normals.emplace_back(0.0f);
        }
        if (a.uvs) {
            const glm::dvec2 uv(a.uvs->number(element, 0), a.uvs->number(element, 1));
            mesh.uvs.resize(before, glm::vec2(0.0f));
            mesh.uvs.emplace_back(use.isTransformed ? use.axes * uv + use.offset : uv);
        } else if (mesh.hasUvs()) {
            mesh.uvs.emplace_back(0.0f);
        }
        if (a.colours) {
            const glm::dvec3 linear = vector(*a.colours);
            const double alpha = a.colours->components() > 3 ? a.colours->number(element, 3) : 1.0;
            mesh.colours.resize(before, glm::u8vec4(255));
            mesh.colours.emplace_back(toByte(encodeSrgb(linear.x)), toByte(encodeSrgb(linear.y)),
                                      toByte(encodeSrgb(linear.z)), toByte(alpha));
        } else if (mesh.hasColours()) {
            mesh.colours.emplace_back(255);
        }
    }

    const MeshBytes& input_;
    const tinygltf::Model& model_;
    MeshFile& file_;
    ImportReport& report_;
    TexturesOfFile textures_;
    UntexturedTwins twins_;
    std::vector<GltfTextureUse> uses_;  // by material of the model
    std::vector<std::uint32_t>
        numbers_;  // in the mesh, of the current primitive's vertices; kNew between primitives
};

}  // namespace

Result<MeshFile> readGltf(const MeshBytes& input, ImportReport& report) {
    MeshFile file;
    Result<std::unique_ptr<tinygltf::Model>> model = openGltf(input, file, report);
    if (!model) return passOn(model);
    if (Result<void> read = GltfReader(input, **model, file, report).read(); !read) return passOn(read);
    return file;
}

}  // namespace fb
