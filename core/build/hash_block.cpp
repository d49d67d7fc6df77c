#include "build/hash_block.h"

#include "base/hash.h"
#include "settings/knob_table.h"

namespace fb {
namespace {

template <class T>
void addArray(Hasher& hasher, const std::vector<T>& values) {
    hasher.number(std::uint64_t{values.size()});
    if (!values.empty()) hasher.bytes(values.data(), values.size() * sizeof(T));
}

void addTexture(Hasher& hasher, const SourceTexture& texture, TextureStore& store) {
    hasher.text(texture.name);
    if (!texture.file.empty()) {
        hasher.text(texture.file.string());
        hasher.number(store.hashFile(texture.file));
        return;
    }
    addArray(hasher, texture.encoded);
    if (!texture.image) return;
    const Image& image = *texture.image;
    for (const int number : {image.width, image.height, image.channels})
        hasher.number(static_cast<std::uint64_t>(number));
    hasher.number(std::uint64_t{image.lossless ? 1u : 0u});
    addArray(hasher, image.pixels);
}

}  // namespace

std::uint64_t hashBuildSettings(const BuildSettings& build) {
    Settings settings;
    settings.build = build;
    Hasher hasher;
    hasher.number(kBuilderVersion);
    for (const Knob& knob : knobs()) {
        if (knob.group == "build") hasher.text(knob.path).number(knob.get(settings));
    }
    return hasher.digest();
}

std::uint64_t hashBlock(const SourceBlock& block, TextureStore& store) {
    Hasher hasher;
    hasher.text(block.name);
    addArray(hasher, block.mesh.positions);
    addArray(hasher, block.mesh.normals);
    addArray(hasher, block.mesh.uvs);
    addArray(hasher, block.mesh.colours);
    addArray(hasher, block.mesh.triangles);
    addArray(hasher, block.mesh.materials);
    addArray(hasher, block.mesh.shared);
    hasher.number(std::uint64_t{block.materials.size()});
    for (const SourceMaterial& material : block.materials) {
        hasher.text(material.name);
        for (int c = 0; c < 4; ++c) hasher.number(static_cast<double>(material.baseColour[c]));
        hasher.number(static_cast<std::uint64_t>(static_cast<std::int64_t>(material.texture)));
        hasher.number(std::uint64_t{material.alphaMask ? 1u : 0u});
    }
    hasher.number(std::uint64_t{block.textures.size()});
    for (const SourceTexture& texture : block.textures) addTexture(hasher, texture, store);
    return hasher.digest();
}

}  // namespace fb
