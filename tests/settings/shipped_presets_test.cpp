// The presets that ship.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/program_folder.h"
#include "settings/knob_table.h"
#include "settings/preset.h"

namespace fb {
namespace {

std::filesystem::path shipped(const std::string& name) {
    return programFolder() / "presets" / (name + ".toml");
}

TEST(ShippedPresets, AllParseAndSayInOneLineWhatTheyAreFor) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shipped("default").parent_path())) {
        ASSERT_EQ(entry.path().extension(), ".toml");
        const Result<Preset> preset = loadPreset(entry.path().string());
        ASSERT_TRUE(preset) << preset.error().oneLine();
        EXPECT_GE(preset->about.size(), 20u) << preset->name;
        EXPECT_EQ(preset->about.find('\n'), std::string::npos) << preset->name;
        ++count;
    }
    EXPECT_GE(count, 2);
}

// Table 6.1 of the thesis, and the behaviour that its chapter 4 prints.
TEST(ShippedPresets, Lakhia2004IsTable61AsPrinted) {
    const Result<Preset> preset = loadPreset(shipped("lakhia2004").string());
    ASSERT_TRUE(preset) << preset.error().oneLine();
    const Settings& s = preset->settings;
    EXPECT_EQ(s.build.desiredTriangles, 900);
    EXPECT_EQ(s.build.levelFactor, 4);
    EXPECT_EQ(s.select.cTextured, 0.127);
    EXPECT_EQ(s.select.cVis, 1.275);
    EXPECT_EQ(s.select.cFore, 0.450);
    EXPECT_EQ(s.control.targetMs, 30.0);
    EXPECT_EQ(s.select.hystSwitch, 1500.0);
    EXPECT_EQ(s.select.hystLimit, 4510.0);
    EXPECT_EQ(s.load.cMemory, 935.0);

    EXPECT_EQ(s.select.policy, PolicyId::lakhia);
    EXPECT_EQ(s.select.hystUnit, 1.0);
    EXPECT_EQ(s.select.hystStart, 0.0);
    EXPECT_FALSE(s.select.hystBand);
    EXPECT_FALSE(s.control.medianGate);
    EXPECT_GT(s.control.vTimeGain, 0.0);
}

// The gains of the second loop are not printed ("gradually"): they are those of the measurements that the
// thesis is compared with.
TEST(ShippedPresets, Lakhia2004DiffersFromTheDefaultInWhatTheThesisSaysAlone) {
    const Result<Preset> preset = loadPreset(shipped("lakhia2004").string());
    ASSERT_TRUE(preset) << preset.error().oneLine();
    std::vector<std::string> paths;
    for (const std::string& line : presetDifferences(Settings{}, preset->settings)) {
        paths.push_back(line.substr(0, line.find(':')));
    }
    EXPECT_EQ(paths, (std::vector<std::string>{"select.policy", "select.c_textured", "select.hyst_switch", "select.hyst_limit",
                                               "select.hyst_start", "select.hyst_band", "control.median_gate",
                                               "control.share_gain", "control.share_drop",
                                               "control.share_proportional", "control.share_limit", "load.order",
                                               "effects.redistribution", "effects.fill_rate",
                                               "effects.texture_pressure"}));
    EXPECT_EQ(preset->settings.control.shareGain, 0.01);
    EXPECT_EQ(preset->settings.control.shareDrop, 0.01);
    EXPECT_FALSE(preset->settings.control.shareProportional);
}

TEST(ShippedPresets, LakhiaIsTheDefaultWithAnotherPolicyAndItsOrderOfLoading) {
    const Result<Preset> preset = loadPreset(shipped("lakhia").string());
    ASSERT_TRUE(preset) << preset.error().oneLine();
    EXPECT_EQ(presetDifferences(Settings{}, preset->settings).size(), 2u);
    EXPECT_EQ(preset->settings.select.policy, PolicyId::lakhia);
    EXPECT_EQ(preset->settings.load.order, LoadOrder::priority);
}

TEST(ShippedPresets, DefaultIsWhatTheProgramStartsWith) {
    const Result<Preset> preset = loadPreset(shipped("default").string());
    ASSERT_TRUE(preset) << preset.error().oneLine();
    EXPECT_EQ(presetDifferences(Settings{}, preset->settings), (std::vector<std::string>{}));
}

}  // namespace
}  // namespace fb
