// Which folder may include which: the data flows one way. The compiler keeps the layers core, draw, ui, app apart (their
// include roots hold nothing else); inside core/ all stages share one root, so this test does.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "base/program_folder.h"

namespace fb {
namespace {

using Names = std::set<std::string>;

Names includedFolders(const std::filesystem::path& folder) {
    constexpr std::string_view kInclude = "#include \"";
    Names names;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        if (!file.is_regular_file()) continue;
        std::ifstream text(file.path());
        for (std::string line; std::getline(text, line);) {
            const std::size_t slash = line.find('/');
            if (line.starts_with(kInclude) && slash != std::string::npos) {
                names.insert(line.substr(kInclude.size(), slash - kInclude.size()));
            }
        }
    }
    return names;
}

const std::map<std::string, Names> kMayInclude = {
    {"base", {}},
    {"settings", {"base"}},
    {"import", {"base"}},
    {"scenefile", {"base", "import"}},
    {"build", {"base", "settings", "import", "scenefile"}},
    {"effects", {"base", "settings", "scenefile"}},
    {"select", {"base", "settings", "scenefile", "effects"}},
    {"control", {"base", "settings", "scenefile", "select"}},
    {"load", {"base", "settings", "scenefile", "effects", "select"}},
    {"measure", {"base", "settings", "import", "scenefile", "effects", "select", "load"}},
    {"draw", {"base", "settings", "import", "scenefile", "effects", "select", "load", "shaders"}},
};

TEST(Layers, EachStageIncludesOnlyStagesBeforeIt) {
    std::size_t stages = 0;
    for (const auto& folder : std::filesystem::directory_iterator(programFolder() / "core")) {
        if (!folder.is_directory()) continue;
        const std::string stage = folder.path().filename().string();
        ASSERT_TRUE(kMayInclude.contains(stage)) << stage << " is not in the table above";
        for (const std::string& other : includedFolders(folder)) {
            EXPECT_TRUE(other == stage || kMayInclude.at(stage).contains(other)) << stage << " includes " << other;
        }
        ++stages;
    }
    EXPECT_EQ(stages, kMayInclude.size());
}

TEST(Layers, ThePanelsSeeNeitherTheRendererNorTheProgram) {
    for (const std::string& other : includedFolders(programFolder() / "ui")) {
        EXPECT_TRUE(other != "draw" && other != "app") << other;
    }
}

TEST(Layers, OnlyDrawAndAppTouchOpenGl) {
    std::size_t files = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(programFolder() / "core")) {
        if (!file.is_regular_file() || file.path().parent_path().filename() == "draw") continue;
        std::ifstream text(file.path());
        const std::string all{std::istreambuf_iterator<char>(text), {}};
        for (const char* gl : {"#include <epoxy/", "#include <GL/", "#include <GLFW/", "#include <EGL/"}) {
            EXPECT_EQ(all.find(gl), std::string::npos) << file.path();
        }
        ++files;
    }
    EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace fb
