#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "scenefile/scene_toml.h"
#include "scenefile/tiny_scene.h"
#include "scenefile/toml_text.h"

namespace fb {
namespace {

using test::lineOf;
using test::says;

Hierarchy oneNode() {
    Hierarchy h;
    h.resize(1);
    h.rootCount = 1;
    h.untexturedTriangles[0] = 7;
    return h;
}

SceneToml sample() {
    SceneToml scene;
    scene.info.name = "Lübeck \"old\" town\n";
    scene.info.program = "frontbench 1.2.3";
    scene.info.origin = {6512345.1, -0.1, 1e-9};
    scene.info.up = UpAxis::z;
    scene.info.bounds = {{-1.5, -2.5, 0.0}, {3.0, 4.0, 5.25}};
    scene.info.sourceTriangles = 123456789012;
    scene.info.sourceAreaSquareMetres = 1.0 / 3.0;
    scene.info.sourceHash = 0xfedcba9876543210;
    scene.info.buildSettingsHash = 1;
    scene.info.desiredTriangles = 900;
    scene.info.levelFactor = 4;
    scene.info.sourceFiles = {"a.obj", "b\\c.ply"};
    scene.info.reportLines = {"texture wall.jpg is missing"};
    scene.info.walks = {{{{0, 0, 0}, {1, 2, 3}}}, {}};
    scene.hierarchyHash = ~std::uint64_t{0};
    return scene;
}

TEST(SceneToml, IsWrittenForPeople) {
    const std::string expected =
        "# A Frontbench scene. Lengths are metres, hashes are XXH3.\n"
        "format = 4\n"
        "program = \"frontbench 1.2.3\"\n"
        "name = \"L\xc3\xbc"
        "beck \\\"old\\\" town\\u000a\"\n"
        "up = \"z\"\n"
        "origin = [6512345.0999999996, -0.10000000000000001, 1.0000000000000001e-09]"
        "  # added to a position of this scene gives the source's\n"
        "bounds_min = [-1.5, -2.5, 0.0]  # relative to the origin\n"
        "bounds_max = [3.0, 4.0, 5.25]\n"
        "source_triangles = 123456789012\n"
        "source_area_m2 = 0.33333333333333331\n"
        "source_hash = \"fedcba9876543210\"\n"
        "build_settings_hash = \"0000000000000001\"\n"
        "desired_triangles = 900\n"
        "level_factor = 4\n"
        "hierarchy_hash = \"ffffffffffffffff\"  # of hierarchy.bin\n"
        "source_files = [\n  \"a.obj\",\n  \"b\\\\c.ply\",\n]\n"
        "report = [\n  \"texture wall.jpg is missing\",\n]  # what the import dropped or repaired\n"
        "\n[counts]\nblocks = 1\nnodes = 1\nlevels = 1\ntriangles = 7  # of all nodes\nleaf_triangles = 7\n"
        "\n[[walk]]\npoints = [\n  [0.0, 0.0, 0.0],\n  [1.0, 2.0, 3.0],\n]\n"
        "\n[[walk]]\npoints = []\n";
    EXPECT_EQ(sceneTomlText(sample(), oneNode()).value(), expected);
}

bool same(const SceneInfo& a, const SceneInfo& b) {
    bool walks = a.walks.size() == b.walks.size();
    for (std::size_t i = 0; walks && i < a.walks.size(); ++i) walks = a.walks[i].points == b.walks[i].points;
    return walks && a.name == b.name && a.program == b.program && a.origin == b.origin && a.up == b.up &&
           a.bounds.min == b.bounds.min && a.bounds.max == b.bounds.max &&
           a.sourceTriangles == b.sourceTriangles && a.sourceAreaSquareMetres == b.sourceAreaSquareMetres &&
           a.sourceHash == b.sourceHash && a.buildSettingsHash == b.buildSettingsHash &&
           a.desiredTriangles == b.desiredTriangles && a.levelFactor == b.levelFactor &&
           a.sourceFiles == b.sourceFiles && a.reportLines == b.reportLines;
}

TEST(SceneToml, IsReadBackAsItWas) {
    const SceneToml scene = sample();
    const Result<SceneToml> read = parseSceneToml(sceneTomlText(scene, oneNode()).value(), "scene.toml");
    ASSERT_TRUE(read) << lineOf(read);
    EXPECT_TRUE(same(read->info, scene.info));
    EXPECT_EQ(read->hierarchyHash, scene.hierarchyHash);
}

RC_GTEST_PROP(SceneToml, IsReadBackAsItWasForAnyNumbersAndTexts, ()) {
    SceneToml scene = sample();
    const auto metres = [] {
        return static_cast<double>(*rc::gen::arbitrary<std::int64_t>()) * 0x1.0p-24 / 3.0;
    };
    scene.info.origin = {metres(), metres(), metres()};
    scene.info.name = *rc::gen::string<std::string>();
    scene.info.sourceFiles = *rc::gen::container<std::vector<std::string>>(rc::gen::string<std::string>());
    scene.info.walks = {{{{metres(), 0, metres()}}}};
    scene.info.sourceHash = *rc::gen::arbitrary<std::uint64_t>();
    const Result<SceneToml> read = parseSceneToml(sceneTomlText(scene, oneNode()).value(), "scene.toml");
    RC_ASSERT(lineOf(read) == "no error");
    // Bytes that are no UTF-8 cannot stand in TOML and come back as question marks.
    const auto readable = [](std::string text) {
        for (char& c : text) c = static_cast<unsigned char>(c) >= 0x80 ? '?' : c;
        return text;
    };
    RC_ASSERT(readable(read->info.name).size() <= scene.info.name.size());
    RC_ASSERT(read->info.origin == scene.info.origin);
    RC_ASSERT(read->info.walks[0].points == scene.info.walks[0].points);
    RC_ASSERT(read->info.sourceHash == scene.info.sourceHash);
    RC_ASSERT(read->info.sourceFiles.size() == scene.info.sourceFiles.size());
    const bool ascii = readable(scene.info.name) == scene.info.name;
    RC_ASSERT(!ascii || read->info.name == scene.info.name);
}

TEST(TomlString, EscapesWhatTomlCannotHold) {
    EXPECT_EQ(tomlString("a\"b\\c\td\x7f"), "\"a\\\"b\\\\c\\u0009d\\u007f\"");
    EXPECT_EQ(tomlString(std::string_view("\0", 1)), "\"\\u0000\"");
    EXPECT_EQ(tomlString("\xe2\x82\xac \xf0\x9f\x8c\x8d"),
              "\"\xe2\x82\xac \xf0\x9f\x8c\x8d\"");  // euro sign, globe
    // A bad lead, a long form, cut short, a surrogate, beyond the last character, a long form of three.
    EXPECT_EQ(tomlString("\xff|\xc0\x80|\xe2\x82|\xed\xa0\x80|\xf4\x90\x80\x80|\xe0\x80\xaf"),
              "\"?|??|??|???|????|???\"");
}

TEST(SceneToml, NamesTheLineThatIsWrong) {
    const std::string good = sceneTomlText(sample(), oneNode()).value();
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        return lineOf(parseSceneToml(text, "scene.toml"));
    };
    EXPECT_TRUE(says(with("format = 4", "format = 9"),
                     "line 2: made by version 9; this program reads 4 (build it again)"));
    EXPECT_TRUE(says(with("format = 4", "format = \"4\""), "\"format\" must be a whole number"));
    EXPECT_TRUE(says(with("up = \"z\"", "up = \"x\""), "line 5: \"up\" must be \"y\" or \"z\""));
    EXPECT_TRUE(says(with("up = \"z\"\n", ""), "\"up\" is missing"));
    EXPECT_TRUE(says(with("origin = [", "origin = [nan, "), "line 6: \"origin\" must be three finite"));
    EXPECT_TRUE(says(with("-0.10000000000000001", "inf"), "line 6: \"origin\" must be three finite"));
    EXPECT_TRUE(says(with("-0.10000000000000001", "-nan"), "line 6: \"origin\" must be three finite"));
    EXPECT_TRUE(says(with("-0.10000000000000001", "1.1e12"), "line 6: \"origin\" must be three finite"));
    EXPECT_TRUE(says(with("-0.10000000000000001", "\"1\""), "line 6: \"origin\" must be three finite"));
    EXPECT_TRUE(says(with("bounds_min = [-1.5", "bounds_min = [3.5"), "must not exceed"));
    EXPECT_TRUE(says(with("source_triangles = 1", "source_triangles = -1"),
                     "\"source_triangles\" must be a whole number"));
    EXPECT_TRUE(says(with("0.33333333333333331", "nan"), "\"source_area_m2\" must be a finite number"));
    EXPECT_TRUE(says(with("0.33333333333333331", "inf"), "\"source_area_m2\" must be a finite number"));
    EXPECT_TRUE(says(with("\"fedcba9876543210\"", "\"fedcba987654321\""), "\"source_hash\" must be 16"));
    EXPECT_TRUE(says(with("\"fedcba9876543210\"", "\"-edcba9876543210\""), "\"source_hash\" must be 16"));
    EXPECT_TRUE(says(with("\"fedcba9876543210\"", "\"xedcba9876543210\""), "\"source_hash\" must be 16"));
    EXPECT_TRUE(says(with("\"a.obj\"", "5"), "\"source_files\" must be a list of texts"));
    EXPECT_TRUE(says(with("[1.0, 2.0, 3.0]", "[1.0, 2.0]"), "\"walk\" must be three finite"));
    EXPECT_TRUE(says(with("points = []", "point = []"), "\"walk\" must be a table with points"));
    EXPECT_TRUE(says(with("name = \"", "name = "), "scene.toml: line 4: "));
    EXPECT_EQ(with("[1.0, 2.0, 3.0]", "[1, 2, 3]"), "no error");  // people write whole numbers
}

TEST(SceneToml, IsNotWrittenWithNumbersThatCannotBeRead) {
    const auto with = [](auto damage) {
        SceneToml scene = sample();
        damage(scene.info);
        return lineOf(sceneTomlText(scene, oneNode()));
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.origin.z = nan; }), "origin"));
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.bounds.max.x = nan; }), "bounds"));
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.bounds.min.x = -1e13; }), "bounds"));
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.sourceAreaSquareMetres = nan; }), "area"));
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.sourceTriangles = ~std::uint64_t{0}; }), "triangles"));
    EXPECT_TRUE(says(with([&](SceneInfo& i) { i.walks[0].points[1].y = nan; }), "walk"));
}

TEST(SceneToml, TakesBoundsAndProgramFromTheSceneWhenNotGiven) {
    SceneToml scene = sample();
    scene.info.bounds = {};
    scene.info.program.clear();
    Hierarchy h = oneNode();
    h.bounds[0] = {glm::vec3(-1.0f), glm::vec3(2.0f)};
    const SceneInfo read = parseSceneToml(sceneTomlText(scene, h).value(), "scene.toml")->info;
    EXPECT_EQ(read.bounds.min, glm::dvec3(-1.0));
    EXPECT_EQ(read.bounds.max, glm::dvec3(2.0));
    EXPECT_EQ(read.program, "frontbench " FB_VERSION);
}

// Not found by a checksum (people may edit it), but never a crash, and numbers stay finite.
TEST(SceneToml, SurvivesEveryPrefixAndEveryFlippedBit) {
    const std::string good = sceneTomlText(sample(), oneNode()).value();
    const auto tryOut = [](const std::string& text) {
        const Result<SceneToml> read = parseSceneToml(text, "scene.toml");
        if (!read) return;
        EXPECT_TRUE(std::isfinite(read->info.origin.x + read->info.bounds.max.y));
    };
    for (std::size_t length = 0; length < good.size(); ++length) tryOut(good.substr(0, length));
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
        std::string text = good;
        text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
        tryOut(text);
    }
}

}  // namespace
}  // namespace fb
