// Finding a camera path by its name: built in, a file, or a file of resources/paths/.
#include <algorithm>

#include "base/program_folder.h"
#include "base/file_io.h"
#include "measure/built_in_path.h"
#include "measure/camera_path.h"

namespace fb {
namespace {

constexpr std::uint64_t kFileCapBytes = 64u << 20;

std::filesystem::path shippedFolder() {
    return programFolder() / "resources" / "paths";
}

std::string knownNames() {
    std::vector<std::string> shipped;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(shippedFolder(), missing)) {
        if (entry.path().extension() == ".toml") shipped.push_back(entry.path().filename().string());
    }
    std::ranges::sort(shipped);
    std::string names;
    for (std::string_view name : builtInPathNames()) names += (names.empty() ? "" : ", ") + std::string(name);
    for (const std::string& name : shipped) names += ", " + name;
    return names;
}

}  // namespace

Result<CameraPath> loadPath(std::string_view nameOrFile, const SceneInfo& scene) {
    if (std::ranges::count(builtInPathNames(), nameOrFile) > 0) return makeBuiltInPath(nameOrFile, scene);

    std::filesystem::path file{std::string(nameOrFile)};
    std::error_code problem;
    const bool bare = !file.has_parent_path() && !std::filesystem::exists(file, problem);
    if (bare) {
        file = shippedFolder() / file;
        if (file.extension() != ".toml") file += ".toml";
        if (!std::filesystem::exists(file, problem)) {
            return failure(std::string(nameOrFile), {}, "there is no camera path of this name",
                           "there are: " + knownNames() + ", or give a .toml file");
        }
    }
    Result<std::vector<std::uint8_t>> bytes = readFile(file, kFileCapBytes);
    if (!bytes) return passOn(bytes);
    return parsePath({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
}

}  // namespace fb
