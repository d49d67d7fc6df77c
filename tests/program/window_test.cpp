// The real window, under a display of its own, with keys and mouse as from hands.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/program_folder.h"
#include "run_program.h"

namespace fb {
namespace {

using test::ProgramRun;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;

// The columns of frames.csv by name.
std::map<std::string, std::vector<double>> readColumns(const std::filesystem::path& file) {
    std::map<std::string, std::vector<double>> columns;
    std::istringstream lines(readText(file));
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::string> names;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        for (const std::string& name : names) {
            std::getline(cells, cell, ',');
            columns[name].push_back(std::atof(cell.c_str()));
        }
    }
    return columns;
}

TEST(Window, IsFlownAndTunedByHand) {
    for (const char* tool : {"Xvfb", "xdotool"}) {
        if (std::system((std::string("command -v ") + tool + " >/dev/null").c_str()) != 0) {
            GTEST_SKIP() << tool << " is not installed";
        }
    }
    // The optimised program where there is one: the window is drawn by the processor.
    const char* release = std::getenv("FB_RELEASE_PROGRAM");
    const std::string program = release ? release : FB_PROGRAM;
    const TemporaryFolder folder;
    const std::string scene = (folder / "city.fbscene").string();
    ASSERT_EQ(runProgram("city --progress none --blocks 4 --triangles 120K --texels 4M -o " + scene, program).exitCode, 0);
    std::filesystem::create_directory(folder / "session");
    const std::string script = (programFolder() / "tests/program/use_window.sh").string();
    ASSERT_EQ(std::system((script + " " + program + " " + scene + " " + (folder / "session").string()).c_str()), 0);

    EXPECT_EQ(readText(folder / "session/errors"), "");
    const auto columns = readColumns(folder / "session/out/frames.csv");
    const std::vector<double>&target = columns.at("target_ms"), &triangles = columns.at("triangles");
    ASSERT_GT(target.size(), 20u);
    // W for a second: the camera has moved along the street, by its speed or a good part of it.
    const double moved = std::hypot(columns.at("cam_x").back() - columns.at("cam_x").front(),
                                    columns.at("cam_z").back() - columns.at("cam_z").front());
    EXPECT_GT(moved, 2.0);
    EXPECT_EQ(target.front(), 600.0);
    EXPECT_NEAR(target.back(), 1.5, 0.5);
    // With 600 ms everything in view is drawn in full; with 1.5 ms the front goes up to the four roots, but where a root's
    // children in view take less than it does: some thousands of triangles of 120,000.
    const auto tuned = static_cast<std::size_t>(std::ranges::find(target, target.back()) - target.begin());
    EXPECT_GT(triangles[tuned - 1], 3.0 * triangles.back());
    EXPECT_LE(triangles.back(), 6000.0);
    for (int picture = 1; picture <= 3; ++picture) {
        EXPECT_GT(std::filesystem::file_size(folder / ("session/frontbench-" + std::to_string(picture) + ".png")), 20000u);
    }
    const auto summary = nlohmann::json::parse(readText(folder / "session/out/summary.json"));
    EXPECT_EQ(summary["path"], "free flight");
    EXPECT_EQ(summary["frames"], target.size());
}

}  // namespace
}  // namespace fb
