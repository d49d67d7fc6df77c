// The commands of the command line: each a struct of its options and a function that runs it. Errors come back as
// values; program.cpp prints them as one line and picks the exit code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace fb {

enum class ProgressStyle { automatic, bar, lines, none };

// What every command that builds a scene takes.
struct BuildingOptions {
    std::filesystem::path output;
    std::vector<std::string> sets;  // --set build.k=v
    std::string memoryLimit;        // bytes with K, M or G; empty: none
    std::uint64_t threads = 0;      // 0: as many as there are cores
    ProgressStyle progress = ProgressStyle::automatic;
    bool phases = false;
};

struct BuildCommand {
    BuildingOptions building;
    std::vector<std::filesystem::path> inputs;
    std::string up = "auto";
    std::string split = "auto";
    std::uint64_t blockTriangles = 40000;
    std::string texture;
    std::string name;
    std::filesystem::path terrain, drape;         // a height map, alone or below the meshes, and a picture on it
    std::string cellSize, heightScale, noData;    // numbers; empty: as the file says
};
[[nodiscard]] Result<void> runBuild(const BuildCommand& command);

struct CityCommand {
    BuildingOptions building;
    std::string blocks, triangles, texels, seed;  // numbers with K, M or G; empty: the default
    bool terrain = false;                         // on hills
};
[[nodiscard]] Result<void> runCity(const CityCommand& command);
// The built-in city's folder in the user's cache; made there first when it is missing.
[[nodiscard]] Result<std::filesystem::path> builtInCity(ProgressStyle progress);
[[nodiscard]] std::filesystem::path builtInCityFolder();
// Whether that folder holds the city that this program would make.
[[nodiscard]] bool builtInCityIsThere();

[[nodiscard]] Result<void> runInfo(const std::filesystem::path& scene, bool json);
[[nodiscard]] Result<void> runCheck(const std::filesystem::path& scene, ProgressStyle progress);

[[nodiscard]] Result<void> runKnobs(bool json);
[[nodiscard]] Result<void> runPresetsList();
[[nodiscard]] Result<void> runPresetsShow(const std::string& name);
[[nodiscard]] Result<void> runPresetsDiff(const std::string& from, const std::string& to);

// What every command that draws without a window takes.
struct HeadlessOptions {
    std::filesystem::path scene;  // empty: the built-in city
    std::string preset = "default";
    std::string clock = "real";
    std::string size = "1280x720";
    std::vector<std::string> sets;
};

struct ReplayCommand {
    HeadlessOptions headless;
    std::string path = "walk-to-fly";
    std::string policy;  // empty: the preset's
    std::uint64_t frames = 0;  // 0: the whole path
    std::filesystem::path out;
    std::uint32_t screenshots = 0;  // pictures spread over the walk
    bool settle = false;            // load what the first view wants before the walk starts
};
[[nodiscard]] Result<void> runReplay(const ReplayCommand& command);

// Every policy on every path at every target, from the same state each time.
struct CompareCommand {
    CompareCommand() { headless.clock = "model"; }
    HeadlessOptions headless;
    std::vector<std::string> paths = {"walk", "fly"};
    std::vector<std::string> policies;  // empty: all
    std::vector<double> targets;        // ms; empty: the preset's
    std::uint64_t frames = 0;           // 0: the whole path
    std::uint64_t rounds = 1;
    std::filesystem::path out;
    bool settle = false;
};
[[nodiscard]] Result<void> runCompare(const CompareCommand& command);

struct CalibrateCommand {
    HeadlessOptions headless;
    std::filesystem::path out;  // empty: `calibrated` among the user's presets
};
[[nodiscard]] Result<void> runCalibrate(const CalibrateCommand& command);

struct OpenCommand {
    std::vector<std::filesystem::path> inputs;  // one scene, or meshes to build; empty: the built-in city
    std::string preset = "default";
    std::vector<std::string> sets;
    std::string size = "1600x900";
    std::string path;                  // plays from the start; empty: the user flies
    std::filesystem::path screenshot;  // save the window there when it ends
    std::filesystem::path out;         // write what was measured there when it ends, as replay does
    std::uint64_t frames = 0;          // end after so many; 0: when the user closes the window
};
[[nodiscard]] Result<void> runWindow(const OpenCommand& command);

}  // namespace fb
