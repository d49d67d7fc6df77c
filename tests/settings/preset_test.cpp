#include "settings/preset.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <fstream>

#include "settings/knob_table.h"
#include "worlds/random_worlds.h"
#include "worlds/scratch_folder.h"

namespace fb {
namespace {

std::string errorOf(std::string_view toml) {
    const Result<Preset> preset = parsePreset(toml, "p.toml");
    return preset ? "parsed" : preset.error().oneLine();
}

void expectSameSettings(const Settings& a, const Settings& b) {
    const std::vector<std::string> differences = presetDifferences(a, b);
    EXPECT_EQ(differences, (std::vector<std::string>{}));
}

Settings randomSettings(Random& r) {
    Settings settings;
    for (std::string_view group : knobGroups()) randomiseGroup(r, settings, group);
    return settings;
}

TEST(ParsePreset, TakesWhatItNamesAndLeavesTheRestAtTheDefaults) {
    const Result<Preset> preset = parsePreset(
        "about = \"for a test\"\n[select]\nc_vis = 2\npolicy = \"full\"\nhyst_band = "
        "false\n[build]\nlevel_factor = 8\n",
        "some/folder/mine.toml");
    ASSERT_TRUE(preset) << preset.error().oneLine();
    EXPECT_EQ(preset->name, "mine");
    EXPECT_EQ(preset->about, "for a test");
    EXPECT_EQ(presetDifferences(Settings{}, preset->settings),
              (std::vector<std::string>{"build.level_factor: 4 -> 8", "select.policy: frontbench -> full",
                                        "select.c_vis: 1.275 -> 2", "select.hyst_band: true -> false"}));
}

TEST(ParsePreset, TakesAnEmptyFileForTheDefaults) {
    const Result<Preset> preset = parsePreset("", "p.toml");
    ASSERT_TRUE(preset);
    EXPECT_EQ(preset->about, "");
    expectSameSettings(preset->settings, Settings{});
}

TEST(ParsePreset, DoesNotMindTheOrderOfKnobsThatDependOnEachOther) {
    for (std::string_view toml : {"[select]\nhyst_switch = 1500\nhyst_limit = 4510\n",
                                  "[select]\nhyst_limit = 4510\nhyst_switch = 1500\n"}) {
        const Result<Preset> preset = parsePreset(toml, "p.toml");
        ASSERT_TRUE(preset) << preset.error().oneLine();
        EXPECT_EQ(preset->settings.select.hystSwitch, 1500.0);
        EXPECT_EQ(preset->settings.select.hystLimit, 4510.0);
    }
    // Both below the defaults, too.
    const Result<Preset> small = parsePreset("[select]\nhyst_limit = 9\nhyst_switch = 3\n", "p.toml");
    ASSERT_TRUE(small) << small.error().oneLine();
}

// The start of the error's line, up to what is asked for.
void expectError(std::string_view toml, const std::string& start) {
    EXPECT_EQ(errorOf(toml).substr(0, start.size()), start);
}

TEST(ParsePreset, NamesTheLineOfARuleThatTheWholePresetBreaks) {
    expectError("[select]\n\nhyst_switch = 1500\n",
                "p.toml: line 3: select.hyst_switch: c_hystSwitch must not be above c_hystLimit");
    expectError("[select]\nhyst_limit = 1\n", "p.toml: line 2: select.hyst_switch: c_hystSwitch must not");
}

TEST(ParsePreset, NamesTheLineOfWhatItDoesNotKnow) {
    expectError("\n[select]\nc_viz = 1\n",
                "p.toml: line 3: select.c_viz: there is no such knob (`frontbench knobs` lists them all)");
    expectError("[select]\nc_vis = 1\n[selct]\nc_fore = 0.3\n",
                "p.toml: line 3: \"selct\" is not part of a preset");
    expectError("[selct]\n",
                "p.toml: line 1: \"selct\" is not part of a preset (knobs stand in the table of their");
    expectError("c_vis = 1\n", "p.toml: line 1: \"c_vis\" is not part of a preset");
    expectError("[[select]]\nc_vis = 1\n", "p.toml: line 1: \"select\" is not part of a preset");
    expectError("[select.more]\nx = 1\n", "p.toml: line 1: select.more: there is no such knob");
}

TEST(ParsePreset, NamesTheLineOfAValueOfTheWrongType) {
    const auto expectWrong = [](const std::string& line, const std::string& rest) {
        expectError("[select]\n" + line + "\n[draw]\n", "p.toml: line 2: select." + rest);
    };
    expectWrong("c_vis = \"much\"", "c_vis: has the wrong type (it should be like 1.275)");
    expectWrong("c_vis = true", "c_vis: has the wrong type");
    expectWrong("c_vis = [1]", "c_vis: has the wrong type");
    expectWrong("c_vis = 2004-01-01", "c_vis: has the wrong type");
    expectWrong("hyst_band = 1", "hyst_band: has the wrong type (it should be like true)");
    expectWrong("policy = 1", "policy: has the wrong type (it should be like \"frontbench\")");
    expectError("about = 7\n", "p.toml: line 1: about: has the wrong type (it should be a text in quotes)");
}

TEST(ParsePreset, NamesTheLineOfAValueThatTheGateRefuses) {
    const auto error = [](const std::string& line) { return errorOf("[select]\n" + line + "\n"); };
    EXPECT_EQ(error("c_fore = 1.0"),
              "p.toml: line 2: select.c_fore: 1 is not allowed (it must be between 0 and 0.99)");
    for (std::string_view bad : {"nan", "inf", "-inf", "-0.001", "1e39", "100.1"}) {
        EXPECT_EQ(error("c_vis = " + std::string(bad)).substr(0, 30), "p.toml: line 2: select.c_vis: ")
            << bad;
    }
    EXPECT_EQ(error("policy = \"fastest\"").substr(0, 31), "p.toml: line 2: select.policy: ");
    EXPECT_EQ(errorOf("[build]\nlevel_factor = 4.5\n"),
              "p.toml: line 2: build.level_factor: 4.5 is not allowed (it must be between 2 and 16)");
}

TEST(ParsePreset, NamesTheLineWhereItIsNoToml) {
    for (std::string_view toml :
         {"[select]\nc_vis =\n", "[select]\nc_vis = 1.2.3\n", "[select]\nc_vis = 1\nc_vis = 2\n", "[select\n",
          "about = \"no end\n", "\xff\xfe", "[select]\n\xc3\x28 = 1\n"}) {
        const Result<Preset> preset = parsePreset(toml, "p.toml");
        ASSERT_FALSE(preset) << toml;
        EXPECT_EQ(preset.error().oneLine().substr(0, 13), "p.toml: line ") << preset.error().oneLine();
    }
}

TEST(ParsePreset, ReadsFilesOfOtherEditors) {
    const Result<Preset> preset =
        parsePreset("\xef\xbb\xbf# saved elsewhere\r\n[select]\r\nc_vis = 2 # more\r\n", "p.toml");
    ASSERT_TRUE(preset) << preset.error().oneLine();
    EXPECT_EQ(preset->settings.select.cVis, 2.0);
}

TEST(PresetToml, HoldsTheKnobsThatDifferAndTheirUnits) {
    Preset preset{"mine", "for \"tests\" \\ and more", {}};
    EXPECT_EQ(presetToml(preset), "about = \"for \\\"tests\\\" \\\\ and more\"\n");
    preset.settings.select.cVis = 2.0;
    preset.settings.control.targetMs = 12.5;
    preset.settings.draw.boxes = true;
    EXPECT_EQ(presetToml(preset),
              "about = \"for \\\"tests\\\" \\\\ and more\"\n\n[select]\nc_vis = 2.0\n\n[control]\ntarget_ms "
              "= 12.5  # ms\n\n"
              "[draw]\nboxes = true\n");
}

TEST(PresetToml, NotesAreCommentsWhateverTheyHold) {
    Preset preset{"p", "measured", {}, {"device: one", "two\nlines = 1", "\x01\x7f \"quoted\" # more"}};
    preset.settings.select.cVis = 2.0;
    EXPECT_EQ(presetToml(preset),
              "about = \"measured\"\n# device: one\n# two lines = 1\n#    \"quoted\" # more\n\n[select]\nc_vis = 2.0\n");
    const Result<Preset> back = parsePreset(presetToml(preset), "p.toml");
    ASSERT_TRUE(back) << back.error().oneLine();
    EXPECT_EQ(back->settings.select.cVis, 2.0);
    EXPECT_TRUE(back->notes.empty());
}

RC_GTEST_PROP(PresetToml, ReadBackGivesTheSameSettings, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    const Preset preset{"p", "all knobs at random", randomSettings(r)};
    const Result<Preset> back = parsePreset(presetToml(preset), "folder/p.toml");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->name == preset.name);
    RC_ASSERT(back->about == preset.about);
    for (const Knob& knob : knobs()) {
        RC_ASSERT(std::bit_cast<std::uint64_t>(knob.get(back->settings)) ==
                  std::bit_cast<std::uint64_t>(knob.get(preset.settings)));
    }
    RC_ASSERT(settingsHash(back->settings) == settingsHash(preset.settings));
}

TEST(PresetToml, WritesAnAboutThatCanBeReadBackWhateverItHolds) {
    for (int c = 0; c < 128; ++c) {
        const std::string about = std::string("a") + static_cast<char>(c) + "b";
        const Result<Preset> back = parsePreset(presetToml({"p", about, {}}), "p.toml");
        ASSERT_TRUE(back) << "character " << c << ": " << back.error().oneLine();
        EXPECT_EQ(back->about, c < 0x20 || c == 0x7f ? "a b" : about) << "character " << c;
    }
    const std::string greek = "\xce\xb5 and \xe2\x80\x94";
    EXPECT_EQ(parsePreset(presetToml({"p", greek, {}}), "p.toml")->about, greek);
}

// A preset with a value of each kind, a comment and both ends of the rule.
constexpr std::string_view kWhole =
    "# a comment\nabout = \"what it is for\"\n\n[select]\npolicy = \"lakhia-naive\"  # words\nc_vis = 2.5\n"
    "hyst_limit = 4510.0\nhyst_switch = 1500.0\nhyst_band = false\n\n[build]\nlevel_factor = "
    "8\n[control]\ntarget_ms = 12\n";

// Whatever is wrong with the answer to a damaged preset; empty where it is settings in range or an error with
// its line.
std::string wrongAnswerTo(const std::string& damaged) {
    const Result<Preset> preset = parsePreset(damaged, "p.toml");
    if (preset) {
        if (!checkTogether(preset->settings, "p.toml")) return "a rule is broken";
        for (const Knob& knob : knobs()) {
            const double value = knob.get(preset->settings);
            if (!(value >= knob.low && value <= knob.high)) return knob.path + " is out of range";
        }
        return {};
    }
    const std::string line = preset.error().oneLine();
    if (line.substr(0, 13) != "p.toml: line ") return "no line: " + line;
    const int number = std::atoi(line.c_str() + 13);
    return number >= 1 && number <= 1 + std::ranges::count(damaged, '\n') ? "" : "no such line: " + line;
}

TEST(ParsePreset, AnswersEveryPrefixOfAPresetWithSettingsOrALine) {
    for (std::size_t length = 0; length <= kWhole.size(); ++length) {
        EXPECT_EQ(wrongAnswerTo(std::string(kWhole.substr(0, length))), "") << length;
    }
    ASSERT_TRUE(parsePreset(kWhole, "p.toml"));
}

RC_GTEST_PROP(ParsePreset, AnswersDamageWithSettingsOrALine, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    std::string text(kWhole);
    const std::uint64_t wounds = 1 + r.index(6);
    for (std::uint64_t i = 0; i < wounds && !text.empty(); ++i) {
        const std::size_t at = r.index(text.size());
        const std::uint64_t kind = r.index(4);
        if (kind == 0) text[at] = static_cast<char>(r.index(256));
        if (kind == 1) text.erase(at, 1 + r.index(20));
        if (kind == 2) text.insert(at, text.substr(r.index(text.size()), r.index(30)));
        if (kind == 3) text.insert(at, 1, "[]{}\"'\\\n=.#-e"[r.index(13)]);
    }
    RC_ASSERT(wrongAnswerTo(text) == "");
}

TEST(ParsePreset, SurvivesDeepNesting) {
    const std::string deep = "a = " + std::string(20000, '[');
    EXPECT_EQ(errorOf(deep).substr(0, 15), "p.toml: line 1:");
}

// --- files ---
class PresetFolders : public testing::Test {
  protected:
    PresetFolders() { ::setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1); }
    ~PresetFolders() override { ::unsetenv("XDG_CONFIG_HOME"); }
    ScratchFolder folder_;
};

TEST_F(PresetFolders, AreTheUsersAndTheShippedOne) {
    EXPECT_EQ(userPresetFolder(), folder_ / "config/frontbench/presets");
    Settings settings;
    settings.select.cVis = 3.0;
    ASSERT_TRUE(savePreset({"mine", "of the user", settings}, userPresetFolder() / "mine.toml"));
    std::ofstream(userPresetFolder() / "notes.txt") << "no preset";
    std::vector<std::string> names;
    for (const PresetFile& file : listPresets()) {
        names.push_back(file.name);
        EXPECT_EQ(file.shipped, file.name != "mine");
    }
    EXPECT_TRUE(std::ranges::is_sorted(names));
    for (const char* name : {"default", "lakhia2004", "mine"}) {
        EXPECT_EQ(std::ranges::count(names, name), 1) << name;
    }
    const Result<Preset> mine = loadPreset("mine");
    ASSERT_TRUE(mine) << mine.error().oneLine();
    EXPECT_EQ(mine->settings.select.cVis, 3.0);
    EXPECT_EQ(mine->about, "of the user");
}

// A report that names the preset `default` means the same everywhere.
TEST_F(PresetFolders, AShippedPresetIsNeverHiddenByOneOfTheUsers) {
    Settings settings;
    settings.select.cVis = 3.0;
    ASSERT_TRUE(savePreset({"default", "my own", settings}, userPresetFolder() / "default.toml"));
    const Result<Preset> mine = loadPreset("default");  // and by its path it still loads
    ASSERT_TRUE(loadPreset((userPresetFolder() / "default.toml").string()));
    ASSERT_TRUE(mine) << mine.error().oneLine();
    EXPECT_NE(mine->about, "my own");
    EXPECT_NE(mine->settings.select.cVis, 3.0);
    const std::vector<PresetFile> files = listPresets();
    EXPECT_EQ(std::ranges::count(files, "default", &PresetFile::name), 1);
}

TEST_F(PresetFolders, APathIsReadAsItStands) {
    ASSERT_TRUE(savePreset({"x", "by path", {}}, folder_ / "a/b/x.toml"));
    const Result<Preset> preset = loadPreset((folder_ / "a/b/x.toml").string());
    ASSERT_TRUE(preset) << preset.error().oneLine();
    EXPECT_EQ(preset->name, "x");
    EXPECT_EQ(preset->about, "by path");
}

TEST_F(PresetFolders, SayWhatThereIsWhenANameIsNotKnown) {
    const Result<Preset> preset = loadPreset("defualt");
    ASSERT_FALSE(preset);
    EXPECT_EQ(preset.error().file, "defualt");
    EXPECT_EQ(preset.error().reason, "there is no preset of this name");
    EXPECT_NE(preset.error().hint.find("default, lakhia, lakhia2004"), std::string::npos) << preset.error().hint;
    EXPECT_FALSE(loadPreset((folder_ / "missing.toml").string()));
    EXPECT_FALSE(loadPreset(""));
}

TEST_F(PresetFolders, NothingIsSavedThatCouldNotBeReadBack) {
    const Result<void> saved = savePreset({"x", "no \xff UTF-8", {}}, folder_ / "x.toml");
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().file, (folder_ / "x.toml").string());
    EXPECT_EQ(folder_.entryCount(), 0);
}

TEST_F(PresetFolders, AFileThatCannotBeAPresetIsNotReadWhole) {
    std::ofstream(folder_ / "huge.toml") << std::string((1 << 20) + 1, '#');
    const Result<Preset> preset = loadPreset((folder_ / "huge.toml").string());
    ASSERT_FALSE(preset);
    EXPECT_EQ(preset.error().reason, "is larger than 1048576 bytes");
}

}  // namespace
}  // namespace fb
