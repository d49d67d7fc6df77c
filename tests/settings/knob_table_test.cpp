#include "settings/knob_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace fb {
namespace {

bool whole(double value) {
    return value == std::floor(value);
}

TEST(KnobTable, EveryKnobHasAUniquePathInItsGroup) {
    std::set<std::string> paths;
    std::size_t lastGroup = 0;
    for (const Knob& knob : knobs()) {
        EXPECT_EQ(knob.path, std::string(knob.group) + "." + std::string(knob.key));
        EXPECT_TRUE(paths.insert(knob.path).second) << knob.path << " stands twice";
        for (char c : knob.key) {
            EXPECT_TRUE(std::islower(static_cast<unsigned char>(c)) ||
                        std::isdigit(static_cast<unsigned char>(c)) || c == '_')
                << knob.path;
        }
        const auto group = std::ranges::find(knobGroups(), knob.group);
        ASSERT_NE(group, knobGroups().end()) << knob.path;
        const auto place = static_cast<std::size_t>(group - knobGroups().begin());
        EXPECT_GE(place, lastGroup) << knob.path << " does not stand with its group";
        lastGroup = place;
        EXPECT_EQ(findKnob(knob.path), &knob);
    }
    EXPECT_EQ(lastGroup + 1, knobGroups().size()) << "a group without knobs";
}

TEST(KnobTable, EveryKnobHasAHelpTextThatIsASentence) {
    for (const Knob& knob : knobs()) {
        ASSERT_GE(knob.help.size(), 10u) << knob.path;
        EXPECT_TRUE(std::isupper(static_cast<unsigned char>(knob.help.front()))) << knob.path;
        EXPECT_EQ(knob.help.back(), '.') << knob.path;
    }
}

TEST(KnobTable, EveryRangeIsFiniteNotEmptyAndContainsTheDefault) {
    for (const Knob& knob : knobs()) {
        EXPECT_TRUE(std::isfinite(knob.low) && std::isfinite(knob.high)) << knob.path;
        EXPECT_LT(knob.low, knob.high) << knob.path;
        EXPECT_GE(knob.initial, knob.low) << knob.path;
        EXPECT_LE(knob.initial, knob.high) << knob.path;
        if (knob.type == KnobType::real) continue;
        EXPECT_TRUE(whole(knob.low) && whole(knob.high) && whole(knob.initial)) << knob.path;
        EXPECT_LT(std::abs(knob.high), 0x1p53) << knob.path << " does not fit a double exactly";
    }
}

TEST(KnobTable, NumbersHaveAUnitChoicesHaveNamesAndBooleansAreZeroOrOne) {
    for (const Knob& knob : knobs()) {
        const bool number = knob.type == KnobType::real || knob.type == KnobType::integer;
        EXPECT_EQ(!knob.unit.empty(), number) << knob.path << ": \"1\" is the unit of what has none";
        EXPECT_EQ(!knob.choices.empty(), knob.type == KnobType::choice) << knob.path;
        if (knob.type == KnobType::boolean) {
            EXPECT_EQ(knob.low, 0.0);
            EXPECT_EQ(knob.high, 1.0);
        }
        if (knob.type != KnobType::choice) continue;
        EXPECT_EQ(knob.low, 0.0);
        EXPECT_EQ(knob.high, static_cast<double>(knob.choices.size() - 1)) << knob.path;
        const std::set<std::string_view> names(knob.choices.begin(), knob.choices.end());
        EXPECT_EQ(names.size(), knob.choices.size()) << knob.path << " has two choices of one name";
        EXPECT_EQ(names.count(""), 0u) << knob.path;
    }
}

TEST(KnobTable, DefaultsOfTheTableAreThoseOfTheStructsAndKeepTheRules) {
    const Settings defaults;
    for (const Knob& knob : knobs()) EXPECT_EQ(knob.get(defaults), knob.initial) << knob.path;
    EXPECT_TRUE(checkTogether(defaults, "defaults"));
}

TEST(KnobTable, EachKnobSetsItsOwnValueAndNoOther) {
    for (const Knob& knob : knobs()) {
        for (double value : {knob.low, knob.high}) {
            Settings settings;
            knob.set(settings, value);
            for (const Knob& other : knobs()) {
                EXPECT_EQ(other.get(settings), &other == &knob ? value : other.initial)
                    << knob.path << ", " << other.path;
            }
        }
    }
}

TEST(KnobTable, FindsNothingUnderOtherNames) {
    for (std::string_view path :
         {"", "select", "select.", ".c_vis", "c_vis", "select.C_VIS", "select.c_vis ", "control.c_vis"}) {
        EXPECT_EQ(findKnob(path), nullptr) << path;
    }
}

TEST(KnobTable, HoldsTheConstantsOfTheThesisUnderTheirSymbols) {
    const auto symbol = [](std::string_view path) { return findKnob(path)->symbol; };
    EXPECT_EQ(symbol("build.desired_triangles"), "c_desiredTris");
    EXPECT_EQ(symbol("build.level_factor"), "c_levelFactor");
    EXPECT_EQ(symbol("select.c_textured"), "c_textured");
    EXPECT_EQ(symbol("select.c_vis"), "c_vis");
    EXPECT_EQ(symbol("select.c_fore"), "c_fore");
    EXPECT_EQ(symbol("control.target_ms"), "c_targetTime");
    EXPECT_EQ(symbol("select.hyst_switch"), "c_hystSwitch");
    EXPECT_EQ(symbol("select.hyst_limit"), "c_hystLimit");
    EXPECT_EQ(symbol("load.c_memory"), "c_memory");
}

// The hash names what a replay depends on: all knobs but the view modes.
TEST(SettingsHash, ChangesWithEveryKnobButTheViewModes) {
    const std::set<std::string> viewModes = {"draw.colour", "draw.wireframe", "draw.boxes"};
    const Settings defaults;
    const std::uint64_t before = settingsHash(defaults);
    std::set<std::uint64_t> seen = {before};
    for (const Knob& knob : knobs()) {
        Settings settings;
        knob.set(settings, knob.initial == knob.low ? knob.high : knob.low);
        const std::uint64_t after = settingsHash(settings);
        if (viewModes.count(knob.path) != 0) {
            EXPECT_EQ(after, before) << knob.path;
        } else {
            EXPECT_TRUE(seen.insert(after).second) << knob.path << " is not in the hash";
        }
    }
    EXPECT_EQ(settingsHash(Settings{}), before);
}

TEST(SettingsHash, TellsNeighbouringValuesApart) {
    Settings settings;
    settings.select.cVis = std::nextafter(settings.select.cVis, 2.0);
    EXPECT_NE(settingsHash(settings), settingsHash(Settings{}));
}

}  // namespace
}  // namespace fb
