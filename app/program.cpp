#include "app/program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "app/commands.h"

namespace fb {
namespace {

// What to run, filled in by the command line.
struct CommandLine {
    BuildCommand build;
    CityCommand city;
    ReplayCommand replay;
    CalibrateCommand calibrate;
    CompareCommand compare;
    OpenCommand open;
    std::filesystem::path scene;
    bool json = false;
    ProgressStyle progress = ProgressStyle::automatic;
    std::string presetA, presetB;
    std::function<Result<void>()> run;
};

// "-1" would be read as the largest whole number.
const CLI::Validator kNotNegative = CLI::NonNegativeNumber;

const std::map<std::string, ProgressStyle> kProgressStyles = {{"auto", ProgressStyle::automatic},
                                                              {"bar", ProgressStyle::bar},
                                                              {"lines", ProgressStyle::lines},
                                                              {"none", ProgressStyle::none}};

void addProgress(CLI::App* command, ProgressStyle& style) {
    command->add_option("--progress", style, "How progress is shown: auto, bar, lines (for programs), none")
        ->transform(CLI::Transformer(kProgressStyles, CLI::ignore_case).description(""));
}

void addBuilding(CLI::App* command, BuildingOptions& c) {
    command->add_option("-o,--output", c.output, "The scene's folder, NAME.fbscene")->required();
    command->add_option("--set", c.sets, "Set a knob: build.NAME=VALUE");
    command->add_option("--memory-limit", c.memoryLimit, "Memory for blocks and textures while building, as in 800M or 4G");
    command->add_option("--threads", c.threads, "Threads that build; 0 or left out: one a core")->check(kNotNegative);
    command->add_flag("--phases", c.phases, "Tell at the end where the time went");
    addProgress(command, c.progress);
}

void addBuild(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("build", "Build a scene from meshes (OBJ, PLY, STL, OFF, glTF, GLB), a height map, or both");
    BuildCommand& b = line.build;
    command->add_option("INPUT", b.inputs, "Mesh files; several become several blocks");
    command->add_option("--up", b.up, "Axis that points up: auto, y, z");
    command->add_option("--split", b.split, "How a mesh becomes blocks: auto, none, grid, groups");
    command->add_option("--block-triangles", b.blockTriangles, "Triangles that a block of the grid should have")->check(kNotNegative);
    command->add_option("--texture", b.texture, "Texture for a file that names none");
    command->add_option("--terrain", b.terrain, "Height map (TIFF, PNG, OpenEXR), alone or below the meshes");
    command->add_option("--drape", b.drape, "Picture over the whole height map");
    command->add_option("--cell-size", b.cellSize, "Metres between heights, instead of what a GeoTIFF says");
    command->add_option("--height-scale", b.heightScale, "Metres a unit of the height map");
    command->add_option("--no-data", b.noData, "Value that means no height, instead of what a GeoTIFF says");
    command->add_option("--name", b.name, "The scene's name");
    addBuilding(command, b.building);
    command->callback([&line] { line.run = [&line] { return runBuild(line.build); }; });
}

void addCity(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("city", "Make a procedural city and build it");
    CityCommand& c = line.city;
    command->add_option("--blocks", c.blocks, "Number of blocks");
    command->add_option("--triangles", c.triangles, "Triangles of the whole city, as in 480K or 8.95M");
    command->add_option("--texels", c.texels, "Texels of the whole city, as in 24M");
    command->add_option("--seed", c.seed, "Another seed makes another city");
    command->add_flag("--terrain", c.terrain, "Put the city on hills, with the country around it");
    addBuilding(command, c.building);
    command->callback([&line] { line.run = [&line] { return runCity(line.city); }; });
}

void addSceneCommands(CLI::App& program, CommandLine& line) {
    CLI::App* info = program.add_subcommand("info", "Counts, sizes and errors per level (`check` verifies the data)");
    info->add_option("SCENE", line.scene, "A scene's folder")->required();
    info->add_flag("--json", line.json, "As JSON");
    info->callback([&line] { line.run = [&line] { return runInfo(line.scene, line.json); }; });

    CLI::App* check = program.add_subcommand("check", "Verify every checksum and invariant of a scene");
    check->add_option("SCENE", line.scene, "A scene's folder")->required();
    addProgress(check, line.progress);
    check->callback([&line] { line.run = [&line] { return runCheck(line.scene, line.progress); }; });
}

// `preset` is the option's name: of calibrate it gives only what is not measured.
void addHeadless(CLI::App* command, HeadlessOptions& o, const std::string& preset, const std::string& presetHelp) {
    command->add_option("SCENE", o.scene, "A scene's folder; the built-in city when left out");
    command->add_option(preset, o.preset, presetHelp);
    command->add_option("--clock", o.clock, "real: times measured on this machine; model: those of the simulated device, the same everywhere");
    command->add_option("--size", o.size, "Size of the picture, as in 1280x720");
    command->add_option("--set", o.sets, "Set a knob: NAME=VALUE, as `frontbench knobs` lists them");
}

constexpr const char* kPresetHelp = "A preset's name or .toml file";

void addReplay(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("replay", "Walk a path without a window and report");
    ReplayCommand& r = line.replay;
    addHeadless(command, r.headless, "--preset", kPresetHelp);
    command->add_option("--path", r.path, "still walk drive fly walk-to-fly shake jump, or a .toml file");
    command->add_option("--policy", r.policy, "Selection policy instead of the preset's");
    command->add_option("--frames", r.frames, "Number of frames; 0 or left out: the whole path")->check(kNotNegative);
    command->add_option("--screenshot", r.screenshots, "Save this many frames, spread over the walk, as PNG")->check(kNotNegative);
    command->add_flag("--settle", r.settle, "Load what the first view wants before the walk starts");
    command->add_option("--out", r.out, "Folder for frames.csv, summary.json, plots and pictures")->required();
    command->callback([&line] { line.run = [&line] { return runReplay(line.replay); }; });
}

void addCompare(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("compare", "Policies against each other: every path and target, the same start each time");
    CompareCommand& c = line.compare;
    addHeadless(command, c.headless, "--preset", kPresetHelp);
    command->add_option("--path", c.paths, "still walk drive fly walk-to-fly shake jump, or .toml files");
    command->add_option("--policy", c.policies, "Selection policies; left out: all");
    command->add_option("--target", c.targets, "Target times in ms; left out: the preset's");
    command->add_option("--frames", c.frames, "Number of frames; 0 or left out: the whole path")->check(kNotNegative);
    command->add_option("--rounds", c.rounds, "Walk everything this often; what else the machine does falls on all alike")->check(CLI::PositiveNumber);
    command->add_flag("--settle", c.settle, "Load what the first view wants before each walk starts");
    command->add_option("--out", c.out, "Folder for compare.csv")->required();
    command->callback([&line] { line.run = [&line] { return runCompare(line.compare); }; });
}

void addCalibrate(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("calibrate", "Measure the constants of the cost model and save them as a preset");
    CalibrateCommand& c = line.calibrate;
    addHeadless(command, c.headless, "--from", "Preset (name or .toml file) that gives all other knobs");
    command->add_option("--out", c.out, "The preset's file, NAME.toml; left out: `calibrated` among your presets");
    command->callback([&line] { line.run = [&line] { return runCalibrate(line.calibrate); }; });
}

void addKnobs(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("knobs", "Every knob: path, symbol, unit, default, range, equation, help");
    command->add_flag("--json", line.json, "As JSON");
    command->callback([&line] { line.run = [&line] { return runKnobs(line.json); }; });
}

void addPresets(CLI::App& program, CommandLine& line) {
    CLI::App* command = program.add_subcommand("presets", "Presets that ship and your own");
    command->require_subcommand(1);
    command->add_subcommand("list", "Names and what each is for")->callback([&line] { line.run = runPresetsList; });
    CLI::App* show = command->add_subcommand("show", "A preset as TOML");
    show->add_option("PRESET", line.presetA, "Name or .toml file")->required();
    show->callback([&line] { line.run = [&line] { return runPresetsShow(line.presetA); }; });
    CLI::App* diff = command->add_subcommand("diff", "The knobs in which two presets differ");
    diff->add_option("FROM", line.presetA, "Name or .toml file")->required();
    diff->add_option("TO", line.presetB, "Name or .toml file")->required();
    diff->callback([&line] { line.run = [&line] { return runPresetsDiff(line.presetA, line.presetB); }; });
}

void addOpen(CLI::App& program, CommandLine& line) {
    OpenCommand& o = line.open;
    program.add_option("SCENE_OR_MESH", o.inputs, "A scene's folder or mesh files; the built-in city when left out");
    program.add_option("--preset", o.preset, "A preset's name or .toml file");
    program.add_option("--set", o.sets, "Set a knob: NAME=VALUE");
    program.add_option("--size", o.size, "Size of the window, as in 1600x900");
    program.add_option("--path", o.path, "Let this path move the camera at first: still walk drive fly walk-to-fly shake jump");
    program.add_option("--frames", o.frames, "End after this many frames; 0 or left out: when it is closed")->check(kNotNegative);
    program.add_option("--screenshot", o.screenshot, "Save the window as PNG when it ends");
    program.add_option("--out", o.out, "Write frames.csv, summary.json and plots of the session there when it ends");
}

int report(const Error& error) {
    if (error.reason.empty()) return 1;  // was told already
    std::fprintf(stderr, "frontbench: %s\n", error.oneLine().c_str());
    return error.kind == Error::Kind::usage ? 2 : 1;
}

}  // namespace

int runProgram(int argumentCount, char** arguments) {
    CLI::App program("Frontbench: a workbench around an out-of-core HLOD renderer", "frontbench");
    program.set_version_flag("--version", "frontbench " FB_VERSION);
    CommandLine line;
    addOpen(program, line);
    addBuild(program, line);
    addCity(program, line);
    addSceneCommands(program, line);
    addReplay(program, line);
    addCompare(program, line);
    addCalibrate(program, line);
    addKnobs(program, line);
    addPresets(program, line);
    line.run = [&line] { return runWindow(line.open); };
    try {
        program.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& problem) {
        if (problem.get_exit_code() == 0) return program.exit(problem);  // --help, --version
        return report(usageFailure({}, problem.what(), "`frontbench --help` lists commands and options").value());
    }
    try {
        const Result<void> done = line.run();
        return done ? 0 : report(done.error());
    } catch (const std::bad_alloc&) {
        return report({Error::Kind::failed, {}, {}, "there is not enough memory", {}});
    } catch (const std::exception& problem) {  // libraries and the file system
        return report({Error::Kind::failed, {}, {}, problem.what(), {}});
    }
}

}  // namespace fb
