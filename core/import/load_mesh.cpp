#include <new>

#include "base/file_io.h"
#include "base/hash.h"
#include "import/import_limits.h"
#include "import/mesh_file.h"
#include "import/textures_of_file.h"

namespace fb {
namespace {

Result<MeshFile> parse(const MeshBytes& input, MeshFormat format, ImportReport& report) {
    switch (format) {
        case MeshFormat::obj:
            return readObj(input, report);
        case MeshFormat::ply:
            return readPly(input, report);
        case MeshFormat::stl:
            return readStl(input, report);
        case MeshFormat::off:
            return readOff(input, report);
        case MeshFormat::gltf:
        case MeshFormat::glb:
            break;
    }
    return readGltf(input, report);
}

}  // namespace

Result<LoadedMesh> parseMesh(const MeshBytes& bytes, const ImportOptions& options, ImportReport& report) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // some editors put it in front of text
    MeshBytes input = bytes;
    if (input.text().substr(0, 3) == kByteOrderMark) input.bytes = input.bytes.subspan(3);
    LoadedMesh loaded;
    loaded.contentHash = hashBytes(bytes.bytes.data(), bytes.bytes.size());
    Result<MeshFormat> format = recogniseFormat(input);
    if (!format) return passOn(format);
    loaded.format = *format;
    Result<MeshFile> mesh = parse(input, *format, report);
    if (!mesh) return passOn(mesh);
    if (mesh->block.mesh.triangles.empty()) {
        return input.failure({}, "contains no triangles",
                             report.ignoredElements > 0 ? "points and lines cannot be shown" : "");
    }
    if (Result<void> checked = checkMesh(mesh->block.mesh, input.file.string()); !checked)
        return passOn(checked);
    if (Result<void> given = addUnnamedTexture(*mesh, input.file, options, report); !given)
        return passOn(given);
    loaded.mesh = std::move(*mesh);
    return loaded;
}

Result<LoadedMesh> loadMesh(const std::filesystem::path& file, const ImportOptions& options,
                            ImportReport& report) {
    std::error_code problem;
    if (!std::filesystem::exists(file, problem)) return failure(file.string(), {}, "does not exist");
    if (!std::filesystem::is_regular_file(file, problem)) return failure(file.string(), {}, "is not a file");
    Result<std::vector<std::uint8_t>> bytes = readFile(file, kMaxMeshFileBytes);
    if (!bytes) return passOn(bytes);
    return parseMesh({file, *bytes}, options, report);
}

Result<SourceBlock> readMeshFile(const std::filesystem::path& file, const ImportOptions& options,
                                 ImportReport& report) {
    try {
        Result<LoadedMesh> loaded = loadMesh(file, options, report);
        if (!loaded) return passOn(loaded);
        return std::move(loaded->mesh.block);
    } catch (const std::bad_alloc&) {
        return failure(file.string(), {}, "needs more memory than there is", "cut it into several files");
    }
}

}  // namespace fb
