// `frontbench build` and `frontbench city`: a source becomes a scene folder, in a guarded child process.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

#include "app/commands.h"
#include "app/counted.h"
#include "app/guarded_child.h"
#include "app/option_text.h"
#include "app/progress_display.h"
#include "build/build_scene.h"
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

void tell(const SourceInfo& info, const BuildReport& report, const std::filesystem::path& folder) {
    for (const std::string& line : info.report.lines()) std::fprintf(stderr, "note: %s\n", line.c_str());
    for (const std::string& line : report.warnings) std::fprintf(stderr, "note: %s\n", line.c_str());
    std::string line = folder.string() + ": " + counted(report.sourceTriangles, "triangle") + " in " +
                       counted(report.blocks, "block") + " became " + counted(report.nodes, "node");
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, " in %.1f s", report.seconds);
    line += seconds;
    if (report.reusedBlocks > 0) line += ", " + counted(report.reusedBlocks, "block") + " taken over";
    if (report.stuckNodes > 0) line += "; " + counted(report.stuckNodes, "node") + " could not be simplified enough";
    std::fprintf(stderr, "%s\n", line.c_str());
}

void tellPhases(const BuildPhases& phases) {
    const std::pair<const char*, double> all[] = {
        {"load", phases.load},     {"textures", phases.textures}, {"simplify", phases.simplify},
        {"errors", phases.errors}, {"skirts", phases.skirts},     {"dress", phases.dress},
        {"atlas", phases.atlas},   {"encode", phases.encode},     {"write", phases.write}};
    std::string line = "thread seconds:";
    for (const auto& [name, seconds] : all) {
        char text[48];
        std::snprintf(text, sizeof text, " %s %.2f", name, seconds);
        line += text;
    }
    std::fprintf(stderr, "%s\n", line.c_str());
}

Result<void> checkOutput(const std::filesystem::path& output) {
    return output.empty() ? usageFailure("--output", "must name a folder") : Result<void>();
}

Result<void> buildFrom(const BlockSource& source, const BuildSettings& settings, const std::filesystem::path& output,
                       ProgressStyle style, bool phases) {
    Result<BuildReport> report = buildScene(source, settings, output, showProgress(style));
    endProgress(style);
    if (!report) return passOn(report);
    tell(source.info(), *report, output);
    if (phases) tellPhases(report->phases);
    return {};
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
    Result<BuildSettings> settings = buildSettings(command.sets);
    if (!settings) return passOn(settings);
    Result<ImportOptions> options = importOptions(command);
    if (!options) return passOn(options);
    if (Result<void> named = checkOutput(command.output); !named) return named;
    if (Result<void> sound = checkInputs(command); !sound) return sound;
    Result<TerrainOptions> terrain = terrainOptions(command, *options);
    if (!terrain) return passOn(terrain);
    const std::size_t files = command.inputs.size() + (command.terrain.empty() ? 0 : 1);
    std::string what = (command.inputs.empty() ? command.terrain : command.inputs.front()).string();
    if (files > 1) what += " and " + std::to_string(files - 1) + " more";
    return runGuarded(what, [&]() -> Result<void> {
        Result<std::unique_ptr<BlockSource>> source;
        if (!command.inputs.empty()) source = importFiles(command.inputs, *options, showProgress(command.progress));
        if (source && !command.terrain.empty()) source = addTerrain(std::move(*source), *terrain);
        if (!source) return passOn(source);
        return buildFrom(**source, *settings, command.output, command.progress, command.phases);
    });
}

Result<void> runCity(const CityCommand& command) {
    Result<BuildSettings> settings = buildSettings(command.sets);
    if (!settings) return passOn(settings);
    Result<CityOptions> options = cityOptions(command);
    if (!options) return passOn(options);
    if (Result<void> named = checkOutput(command.output); !named) return named;
    return runGuarded("city", [&]() -> Result<void> {
        auto source = makeCity(*options);
        if (!source) return passOn(source);
        return buildFrom(**source, *settings, command.output, command.progress, command.phases);
    });
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
    command.output = folder;
    command.progress = progress;
    if (Result<void> built = runCity(command); !built) return passOn(built);
    return folder;
}

}  // namespace fb
