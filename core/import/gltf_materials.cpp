#include "import/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "import/find_beside.h"
#include "import/parse_text.h"
#include "import/textures_of_file.h"
#include "import/srgb.h"

namespace fb {
namespace {

template <class T>
const T* at(const std::vector<T>& list, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? &list[static_cast<std::size_t>(index)]
               : nullptr;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

// Element `i` of the array `key`, or `otherwise`.
double numberIn(const tinygltf::Value& object, const char* key, std::size_t i, double otherwise) {
    if (!object.Has(key) || !object.Get(key).IsArray() || i >= object.Get(key).ArrayLen()) return otherwise;
    const tinygltf::Value& value = object.Get(key).Get(static_cast<int>(i));
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
    return std::isfinite(number) ? number : otherwise;
}

int intIn(const tinygltf::Value& object, const char* key, int otherwise) {
    return object.Has(key) && object.Get(key).IsInt() ? object.Get(key).GetNumberAsInt() : otherwise;
}

void takeTransform(const tinygltf::Value& transform, GltfTextureUse& use) {
    const double sx = numberIn(transform, "scale", 0, 1.0), sy = numberIn(transform, "scale", 1, 1.0);
    double angle = 0.0;
    if (transform.Has("rotation") && transform.Get("rotation").IsNumber()) {
        angle = transform.Get("rotation").GetNumberAsDouble();
    }
    if (!std::isfinite(angle)) angle = 0.0;
    // Counter-clockwise as seen with v pointing down. The matrix printed in the extension turns the other
    // way; its text, its example and the programs that read it agree on this one (KhronosGroup/glTF issue
    // 1563).
    const double c = std::cos(angle), s = std::sin(angle);
    use.axes = glm::dmat2(glm::dvec2(c * sx, -s * sx), glm::dvec2(s * sy, c * sy));
    use.offset = {numberIn(transform, "offset", 0, 0.0), numberIn(transform, "offset", 1, 0.0)};
    use.uvSet = intIn(transform, "texCoord", use.uvSet);
    use.isTransformed = true;
}

class Materials {
  public:
    Materials(const tinygltf::Model& model, MeshFile& into, TexturesOfFile& textures, ImportReport& report)
        : model_(model), into_(into), textures_(textures), report_(report) {}

    GltfTextureUse add(const tinygltf::Material& from) {
        SourceMaterial material;
        material.name = from.name;
        std::vector<double> colour = from.pbrMetallicRoughness.baseColorFactor;
        int texture = from.pbrMetallicRoughness.baseColorTexture.index;
        GltfTextureUse use;
        use.uvSet = from.pbrMetallicRoughness.baseColorTexture.texCoord;
        const tinygltf::ExtensionMap* extensions = &from.pbrMetallicRoughness.baseColorTexture.extensions;
        tinygltf::ExtensionMap glossyExtensions;
        // An older way to say the same; files that use it often leave the other one empty.
        const tinygltf::Value* const glossy =
            extension(from.extensions, "KHR_materials_pbrSpecularGlossiness");
        if (glossy != nullptr && texture < 0) {
            for (std::size_t i = 0; i < colour.size(); ++i)
                colour[i] = numberIn(*glossy, "diffuseFactor", i, 1.0);
            if (glossy->Has("diffuseTexture") && glossy->Get("diffuseTexture").IsObject()) {
                const tinygltf::Value& info = glossy->Get("diffuseTexture");
                texture = intIn(info, "index", -1);
                use.uvSet = intIn(info, "texCoord", 0);
                if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) {
                    glossyExtensions["KHR_texture_transform"] =
                        info.Get("extensions").Get("KHR_texture_transform");
                }
                extensions = &glossyExtensions;
            }
        }
        for (std::size_t i = 0; i < 4 && i < colour.size(); ++i) {
            const double value = std::isfinite(colour[i]) ? std::clamp(colour[i], 0.0, 1.0) : 1.0;
            material.baseColour[static_cast<int>(i)] = static_cast<float>(i < 3 ? encodeSrgb(value) : value);
        }
        if (const auto* transform = extension(*extensions, "KHR_texture_transform"))
            takeTransform(*transform, use);
        into_.block.materials.push_back(material);
        if (texture >= 0) giveTexture(texture);
        takeAlpha(from);
        return use;
    }

  private:
    void takeAlpha(const tinygltf::Material& from) {
        SourceMaterial& material = into_.block.materials.back();
        if (from.alphaMode != "MASK" && from.alphaMode != "BLEND") {
            material.baseColour.w = 1.0f;  // opaque materials ignore alpha
            return;
        }
        material.alphaMask = material.texture >= 0;
        // Glass: blended as a whole, which would leave nothing under a mask.
        if (from.alphaMode == "BLEND") material.baseColour.w = 1.0f;
        if (material.alphaMask && from.alphaMode == "MASK" && from.alphaCutoff != 0.5) {
            report_.warnings.push_back("material " + inQuotes(from.name) +
                                       ": its holes begin at alpha 0.5 instead of " +
                                       std::to_string(from.alphaCutoff));
        }
    }

    void giveTexture(int index) {
        const tinygltf::Texture* const texture = at(model_.textures, index);
        int source = texture != nullptr ? texture->source : -1;
        if (texture != nullptr) {
            if (const auto* webp = extension(texture->extensions, "EXT_texture_webp")) {
                source = intIn(*webp, "source", source);
            }
        }
        const auto material = static_cast<std::uint32_t>(into_.block.materials.size() - 1);
        const tinygltf::Image* const image = at(model_.images, source);
        if (image == nullptr) {
            textures_.giveNothing(material, "texture " + std::to_string(index),
                                  "has no image that can be read");
        } else if (image->bufferView < 0 && image->image.empty()) {
            textures_.give(material, percentDecoded(image->uri));
        } else {
            textures_.giveEncoded(material, "image " + std::to_string(source), image->name,
                                  [&] { return bytesOf(*image); });
        }
    }

    // openGltf has held the views against their buffers.
    [[nodiscard]] std::vector<std::uint8_t> bytesOf(const tinygltf::Image& image) const {
        if (image.bufferView < 0) return image.image;
        const tinygltf::BufferView* const view = at(model_.bufferViews, image.bufferView);
        const tinygltf::Buffer* const buffer = view != nullptr ? at(model_.buffers, view->buffer) : nullptr;
        if (buffer == nullptr || view->byteOffset + view->byteLength > buffer->data.size()) return {};
        const auto first = buffer->data.begin() + static_cast<std::ptrdiff_t>(view->byteOffset);
        return {first, first + static_cast<std::ptrdiff_t>(view->byteLength)};
    }

    const tinygltf::Model& model_;
    MeshFile& into_;
    TexturesOfFile& textures_;
    ImportReport& report_;
};

}  // namespace

std::vector<GltfTextureUse> addGltfMaterials(const tinygltf::Model& model, MeshFile& into,
                                             TexturesOfFile& textures, ImportReport& report) {
    Materials materials(model, into, textures, report);
    std::vector<GltfTextureUse> uses;
    for (const tinygltf::Material& material : model.materials) uses.push_back(materials.add(material));
    return uses;
}

}  // namespace fb
