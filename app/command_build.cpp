// `frontbench build` and `frontbench city`: options become a build job.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

#include "app/build_job.h"
#include "app/commands.h"
#include "app/option_text.h"
#include "build/hash_block.h"
#include "import/city.h"
#include "import/import_files.h"
#include "import/open_terrain.h"

namespace fb {
namespace {

Result<BuildSettings> buildSettings(const std::vector<std::string>& sets) {
    Settings settings;
    if (Result<void> taken = applySets(settings, sets); !taken) return passOn(taken);
    for (const std::string& set : sets) {
        if (!set.starts_with("build.")) return usageFailure("--set " + set, "does not matter here", "knobs of build.* do");
    }
    return settings.build;
}

Result<ImportOptions> importOptions(const BuildCommand& command) {
    ImportOptions options;
    options.trianglesPerBlock = command.blockTriangles;
    options.name = command.name;
    if (std::ranges::any_of(command.name, [](char c) { return static_cast<unsigned char>(c) < ' '; })) {
        return usageFailure("--name", "must be one line");
    }
    std::error_code problem;
    if (!command.texture.empty() && !std::filesystem::exists(command.texture, problem)) {
        return failure(command.texture, {}, "there is no such file");
    }
    if (!command.texture.empty()) options.texture = command.texture;
    if (command.up == "y") options.up = UpAxis::y;
    else if (command.up == "z") options.up = UpAxis::z;
    else if (command.up != "auto") return usageFailure("--up " + command.up, "is not an axis", "auto, y or z");
    if (command.split == "none") options.split = BlockSplit::none;
    else if (command.split == "grid") options.split = BlockSplit::grid;
    else if (command.split == "groups") options.split = BlockSplit::groups;
    else if (command.split != "auto")
        return usageFailure("--split " + command.split, "is not a way to split", "auto, none, grid or groups");
    if (command.blockTriangles == 0) return usageFailure("--block-triangles 0", "must be at least 1");
    return options;
}

Result<TerrainOptions> terrainOptions(const BuildCommand& command, const ImportOptions& import) {
    TerrainOptions options;
    options.heights = command.terrain;
    options.up = import.up;
    options.name = command.name;
    if (!command.drape.empty()) options.drape = command.drape;
    const auto take = [](const char* option, const std::string& text, auto& into) -> Result<void> {
        if (text.empty()) return {};
        Result<double> value = parseReal(option, text);
        if (!value) return passOn(value);
        into = *value;
        return {};
    };
    if (Result<void> taken = take("--cell-size", command.cellSize, options.cellMetres); !taken) return passOn(taken);
    if (Result<void> taken = take("--height-scale", command.heightScale, options.heightScale); !taken) return passOn(taken);
    if (Result<void> taken = take("--no-data", command.noData, options.noData); !taken) return passOn(taken);
    return options;
}

// What options of terrains ask of each other.
Result<void> checkInputs(const BuildCommand& command) {
    if (!command.terrain.empty()) return {};
    if (command.inputs.empty()) return usageFailure("INPUT", "no mesh file is given, and no --terrain");
    for (const auto& [option, given] : {std::pair{"--drape", !command.drape.empty()},
                                        {"--cell-size", !command.cellSize.empty()},
                                        {"--height-scale", !command.heightScale.empty()},
                                        {"--no-data", !command.noData.empty()}}) {
        if (given) return usageFailure(option, "needs --terrain");
    }
    return {};
}

Result<void> checkOutput(const std::filesystem::path& output) {
    return output.empty() ? usageFailure("--output", "must name a folder") : Result<void>();
}

// Threads and bytes that a build may take.
Result<BuildResources> buildResources(const BuildingOptions& building) {
    BuildResources resources;
    constexpr std::uint64_t kMostThreads = 4096;
    if (building.threads > kMostThreads) return usageFailure("--threads " + std::to_string(building.threads), "is more than 4096");
    resources.threads = static_cast<std::uint32_t>(building.threads);
    if (building.memoryLimit.empty()) return resources;
    const Result<std::uint64_t> bytes = parseCount(building.memoryLimit);
    if (!bytes) return usageFailure("--memory-limit " + building.memoryLimit, bytes.error().reason, "as in 800M or 4G");
    if (*bytes < kLeastMemoryLimitBytes) {
        return usageFailure("--memory-limit " + building.memoryLimit, "is too little to build in", "at least 256M");
    }
    resources.memoryLimitBytes = *bytes;
    return resources;
}

Result<CityOptions> cityOptions(const CityCommand& command) {
    CityOptions options;
    const std::tuple<const char*, const std::string&, std::uint64_t*> numbers[] = {
        {"--blocks", command.blocks, &options.blocks},
        {"--triangles", command.triangles, &options.triangles},
        {"--texels", command.texels, &options.texels},
        {"--seed", command.seed, &options.seed}};
    for (const auto& [option, text, value] : numbers) {
        if (text.empty()) continue;
        const Result<std::uint64_t> count = parseCount(text);
        if (!count) return usageFailure(option + (" " + text), count.error().reason, count.error().hint);
        *value = *count;
    }
    options.terrain = command.terrain;
    return options;
}

}  // namespace

Result<void> runBuild(const BuildCommand& command) {
    Result<BuildSettings> settings = buildSettings(command.building.sets);
    if (!settings) return passOn(settings);
    Result<ImportOptions> options = importOptions(command);
    if (!options) return passOn(options);
    if (Result<void> named = checkOutput(command.building.output); !named) return named;
    if (Result<void> sound = checkInputs(command); !sound) return sound;
    Result<TerrainOptions> terrain = terrainOptions(command, *options);
    if (!terrain) return passOn(terrain);
    Result<BuildResources> resources = buildResources(command.building);
    if (!resources) return passOn(resources);
    const std::size_t files = command.inputs.size() + (command.terrain.empty() ? 0 : 1);
    std::string what = (command.inputs.empty() ? command.terrain : command.inputs.front()).string();
    if (files > 1) what += " and " + std::to_string(files - 1) + " more";
    const auto openSource = [&](const Progress& progress) {
        Result<std::unique_ptr<BlockSource>> source;
        if (!command.inputs.empty()) source = importFiles(command.inputs, *options, progress);
        if (source && !command.terrain.empty()) source = addTerrain(std::move(*source), *terrain);
        return source;
    };
    return runJob({what, openSource, *settings, *resources, command.building.output, command.building.progress, command.building.phases});
}

Result<void> runCity(const CityCommand& command) {
    Result<BuildSettings> settings = buildSettings(command.building.sets);
    if (!settings) return passOn(settings);
    Result<CityOptions> options = cityOptions(command);
    if (!options) return passOn(options);
    Result<BuildResources> resources = buildResources(command.building);
    if (!resources) return passOn(resources);
    if (Result<void> named = checkOutput(command.building.output); !named) return named;
    const auto openSource = [&](const Progress&) { return makeCity(*options); };
    return runJob({"city", openSource, *settings, *resources, command.building.output, command.building.progress, command.building.phases});
}

std::filesystem::path builtInCityFolder() {
    std::filesystem::path cache;
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder) {
        cache = folder;
    } else {
        const char* home = std::getenv("HOME");
        cache = std::filesystem::path(home && *home ? home : ".") / ".cache";
    }
    return cache / "frontbench" / ("city-" FB_VERSION ".fbscene");
}

bool builtInCityIsThere() {
    const Result<Scene> scene = openScene(builtInCityFolder());
    if (!scene) return false;
    const auto source = makeCity({});
    return source && scene->info.sourceHash == (*source)->info().sourceHash &&
           scene->info.buildSettingsHash == hashBuildSettings({});
}

Result<std::filesystem::path> builtInCity(ProgressStyle progress) {
    const std::filesystem::path folder = builtInCityFolder();
    if (builtInCityIsThere()) return folder;
    if (Result<void> made = makeFolder(folder.parent_path()); !made) return passOn(made);
    std::fprintf(stderr, "making the built-in city in %s (once)\n", folder.string().c_str());
    CityCommand command;
    command.building.output = folder;
    command.building.progress = progress;
    if (Result<void> built = runCity(command); !built) return passOn(built);
    return folder;
}

}  // namespace fb
