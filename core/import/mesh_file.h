// What the reader of one format makes of one file, before clean-up and splitting, and the steps that readers
// share. Comes from read_*.cpp; goes to cleanMesh and to the block splits (import_files.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "import/import_files.h"

namespace fb {

// A file as read from disk: what a reader starts from.
struct MeshBytes {
    std::filesystem::path file;
    std::span<const std::uint8_t> bytes;

    [[nodiscard]] std::string_view text() const {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    [[nodiscard]] tl::unexpected<Error> failure(std::string place, std::string reason,
                                                std::string hint = {}) const {
        return fb::failure(file.string(), std::move(place), std::move(reason), std::move(hint));
    }
};

struct MeshFile {
    SourceBlock block;
    std::vector<std::uint32_t> groups;  // one a triangle, index into groupNames; empty without groups
    std::vector<std::string> groupNames;
    std::vector<std::filesystem::path> otherFiles;  // material files, buffers and textures that it refers to
    bool namesTextures = false;                     // it names at least one, found or not
};

enum class MeshFormat : std::uint8_t { obj, ply, stl, off, gltf, glb };

// By content; where that says nothing, by the file's extension.
[[nodiscard]] Result<MeshFormat> recogniseFormat(const MeshBytes& input);

[[nodiscard]] Result<MeshFile> readObj(const MeshBytes& input, ImportReport& report);
[[nodiscard]] Result<MeshFile> readPly(const MeshBytes& input, ImportReport& report);
[[nodiscard]] Result<MeshFile> readStl(const MeshBytes& input, ImportReport& report);
[[nodiscard]] Result<MeshFile> readOff(const MeshBytes& input, ImportReport& report);
[[nodiscard]] Result<MeshFile> readGltf(const MeshBytes& input, ImportReport& report);

// Recognises, parses and checks one file, and gives it the texture of the options where it names none.
struct LoadedMesh {
    MeshFile mesh;
    MeshFormat format = MeshFormat::obj;
    std::uint64_t contentHash = 0;  // of the file's bytes
};
[[nodiscard]] Result<LoadedMesh> parseMesh(const MeshBytes& input, const ImportOptions& options, ImportReport& report);
[[nodiscard]] Result<LoadedMesh> loadMesh(const std::filesystem::path& file, const ImportOptions& options,
                                          ImportReport& report);

// What the rest of the import relies on: attributes as many as positions or none, indices and materials in
// range, positions that a triangle uses finite and below kMaxCoordinate.
[[nodiscard]] bool isUsablePosition(const glm::dvec3& p);
[[nodiscard]] Result<void> checkMesh(const SourceMesh& mesh, const std::string& what);

// Appends one polygon as triangles and counts it. Its corners are vertices of the mesh.
void addPolygon(MeshFile& into, std::span<const std::uint32_t> corners, std::uint32_t material,
                std::uint32_t group, ImportReport& report);

// Appends the triangles of a strip; every second one is turned over. `at(i)` gives its i-th vertex.
template <class At>
void addStrip(SourceMesh& mesh, std::size_t vertices, const At& at) {
    for (std::size_t i = 2; i < vertices; ++i) {
        const bool odd = i % 2 == 1;
        mesh.triangles.emplace_back(at(odd ? i - 1 : i - 2), at(odd ? i - 2 : i - 1), at(i));
    }
}

// Copies of materials without their texture, for triangles that lack texture coordinates.
class UntexturedTwins {
  public:
    explicit UntexturedTwins(SourceBlock& block) : block_(block) {}
    // The twin of a textured material, otherwise the material itself.
    [[nodiscard]] std::uint32_t of(std::uint32_t material);

  private:
    SourceBlock& block_;
    std::map<std::uint32_t, std::uint32_t> twins_;
};

// A colour channel of 0 to 1 as 8 bits; out of range is clamped, not a number is 0.
[[nodiscard]] std::uint8_t toByte(double zeroToOne);

}  // namespace fb
