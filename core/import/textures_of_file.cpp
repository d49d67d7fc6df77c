#include "import/textures_of_file.h"

#include <algorithm>

#include "import/find_beside.h"
#include "import/parse_text.h"

namespace fb {

std::string trianglesAre(std::uint64_t count) {
    return count == 1 ? "1 triangle is" : std::to_string(count) + " triangles are";
}

std::vector<std::uint64_t> trianglesByMaterial(const SourceBlock& block) {
    std::vector<std::uint64_t> counts(block.materials.size() + 1, 0);
    for (const std::uint32_t material : block.mesh.materials) {
        ++counts[std::min<std::size_t>(material, block.materials.size())];
    }
    return counts;
}

void TexturesOfFile::use(std::uint32_t material, Named& named) {
    into_.namesTextures = true;
    named.materials.push_back(material);
    into_.block.materials[material].texture = named.texture;
}

void TexturesOfFile::giveEncoded(std::uint32_t material, const std::string& key, const std::string& name,
                                 const std::function<std::vector<std::uint8_t>()>& bytes) {
    // No file name contains a line end: keys do not meet names.
    const auto [at, isNew] = byName_.try_emplace("\n" + key);
    if (isNew) {
        at->second.texture = static_cast<int>(into_.block.textures.size());
        into_.block.textures.push_back({name.empty() ? key : name, {}, bytes(), {}});
    }
    use(material, at->second);
}

void TexturesOfFile::giveNothing(std::uint32_t material, const std::string& name, const std::string& why) {
    Named& named = byName_[name];
    named.why = why;
    use(material, named);
}

void TexturesOfFile::give(std::uint32_t material, std::string_view name) {
    const auto [at, isNew] = byName_.try_emplace(std::string(name));
    Named& named = at->second;
    if (isNew) {
        const FoundFile found = findBeside(model_, name);
        named.why = found.why;
        if (!found.file.empty()) {
            named.texture = static_cast<int>(into_.block.textures.size());
            into_.block.textures.push_back({std::string(name), found.file, {}, {}});
            into_.otherFiles.push_back(found.file);
        }
        if (found.byBareName) {
            report_.warnings.push_back("texture " + inQuotes(name) + " was found as " +
                                       inQuotes(found.file.filename().string()) + " beside the model");
        }
    }
    use(material, named);
}

void TexturesOfFile::reportMissing() const {
    const std::vector<std::uint64_t> counts = trianglesByMaterial(into_.block);
    for (const auto& [name, named] : byName_) {
        if (named.texture >= 0) continue;
        std::uint64_t triangles = 0;
        for (const std::uint32_t material : named.materials) triangles += counts[material];
        report_.warnings.push_back("texture " + inQuotes(name) + " " + named.why + ": " +
                                   trianglesAre(triangles) + " drawn with the base colour");
    }
}

Result<void> addUnnamedTexture(MeshFile& mesh, const std::filesystem::path& file,
                               const ImportOptions& options, ImportReport& report) {
    SourceBlock& block = mesh.block;
    if (mesh.namesTextures || !block.textures.empty()) return {};
    if (!block.mesh.hasUvs()) {
        if (options.texture) {
            report.warnings.push_back(file.filename().string() + " has no texture coordinates: the texture " +
                                      options.texture->filename().string() + " is not used for it");
        }
        return {};
    }
    std::filesystem::path texture;
    if (options.texture) {
        std::error_code problem;
        texture = std::filesystem::canonical(*options.texture, problem);
        if (problem || !std::filesystem::is_regular_file(texture, problem)) {
            return failure(options.texture->string(), {},
                           "the texture given for " + file.string() + " is not a file");
        }
    } else {
        const std::vector<std::filesystem::path> images = imagesNamedLike(file);
        if (images.size() != 1) return {};
        texture = images.front();
        report.warnings.push_back(file.filename().string() + " names no texture: " +
                                  texture.filename().string() + " beside it is taken");
    }
    block.textures.push_back({texture.filename().string(), texture, {}, {}});
    mesh.otherFiles.push_back(texture);
    for (SourceMaterial& material : block.materials) material.texture = 0;
    if (trianglesByMaterial(block).back() == 0) return {};
    SourceMaterial plain;
    plain.name = texture.stem().string();
    plain.texture = 0;
    block.materials.push_back(plain);
    const auto added = static_cast<std::uint32_t>(block.materials.size() - 1);
    std::replace(block.mesh.materials.begin(), block.mesh.materials.end(), kNoMaterial, added);
    return {};
}

}  // namespace fb
