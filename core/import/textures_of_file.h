// The textures that one model file names: found once each, listed in its block, and when missing reported
// once each with the triangles that have to do without.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "import/mesh_file.h"

namespace fb {

class TexturesOfFile {
  public:
    TexturesOfFile(const MeshBytes& input, MeshFile& into, ImportReport& report)
        : model_(input.file), into_(into), report_(report) {}

    // Gives material `material` of the block the texture of that name, or notes that it is missing.
    void give(std::uint32_t material, std::string_view name);

    // The same for an image inside the model file; `key` tells images apart, `bytes` is called once per
    // image.
    void giveEncoded(std::uint32_t material, const std::string& key, const std::string& name,
                     const std::function<std::vector<std::uint8_t>()>& bytes);

    // Notes a texture that cannot be given at all.
    void giveNothing(std::uint32_t material, const std::string& name, const std::string& why);

    // One warning per missing texture. Call it when all triangles have been added.
    void reportMissing() const;

  private:
    struct Named {
        int texture = -1;
        std::string why;
        std::vector<std::uint32_t> materials;
    };

    // Notes that the material uses `named`, and gives it the texture, if there is one.
    void use(std::uint32_t material, Named& named);

    std::filesystem::path model_;
    MeshFile& into_;
    ImportReport& report_;
    std::map<std::string, Named, std::less<>> byName_;
};

// "1 triangle is", "120 triangles are"
[[nodiscard]] std::string trianglesAre(std::uint64_t count);

// Triangles of each material, and at the end of those without.
[[nodiscard]] std::vector<std::uint64_t> trianglesByMaterial(const SourceBlock& block);

// For a file that has texture coordinates and names no texture: the texture of the options, or the only image
// that goes by the file's name.
[[nodiscard]] Result<void> addUnnamedTexture(MeshFile& mesh, const std::filesystem::path& file,
                                             const ImportOptions& options, ImportReport& report);

}  // namespace fb
