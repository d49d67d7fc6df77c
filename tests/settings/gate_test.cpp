// The one gate for numbers from sliders, presets and the command line.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "settings/knob_table.h"
#include "worlds/random_worlds.h"

namespace fb {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool same(const Settings& a, const Settings& b) {
    for (const Knob& knob : knobs()) {
        if (std::bit_cast<std::uint64_t>(knob.get(a)) != std::bit_cast<std::uint64_t>(knob.get(b)))
            return false;
    }
    return true;
}

// Settings in which both ends of the rule between knobs are as far apart as they can be.
Settings wideSettings() {
    Settings settings;
    settings.select.hystSwitch = findKnob("select.hyst_switch")->low;
    settings.select.hystLimit = findKnob("select.hyst_limit")->high;
    return settings;
}

std::string errorOf(const Result<void>& result) {
    return result ? "admitted" : result.error().oneLine();
}

TEST(Gate, AdmitsBothEndsOfEveryRangeAndNothingBeyond) {
    for (const Knob& knob : knobs()) {
        for (double value : {knob.low, knob.high}) {
            Settings settings = wideSettings();
            EXPECT_TRUE(admit(settings, knob, value, "test")) << knob.path << " = " << value;
            EXPECT_EQ(knob.get(settings), value);
        }
        for (double value :
             {std::nextafter(knob.low, -kInfinity), std::nextafter(knob.high, kInfinity), knob.low - 1.0,
              knob.high + 1.0, -1e300, 1e300, kNan, -kNan, kInfinity, -kInfinity}) {
            Settings settings = wideSettings();
            const Result<void> admitted = admit(settings, knob, value, "test");
            EXPECT_FALSE(admitted) << knob.path << " = " << value;
            EXPECT_TRUE(same(settings, wideSettings())) << knob.path;
        }
    }
}

TEST(Gate, RefusesFractionsWhereWholeNumbersAreMeant) {
    for (const Knob& knob : knobs()) {
        if (knob.type == KnobType::real) continue;
        Settings settings = wideSettings();
        EXPECT_FALSE(admit(settings, knob, knob.low + 0.5, "test")) << knob.path;
        EXPECT_FALSE(admit(settings, knob, std::nextafter(knob.high, 0.0), "test")) << knob.path;
        EXPECT_TRUE(same(settings, wideSettings()));
    }
}

TEST(Gate, SaysWhereTheValueCameFromWhatIsWrongAndWhatIsAllowed) {
    Settings settings;
    EXPECT_EQ(errorOf(setFromText(settings, "select.c_fore", "1.0", "--set")),
              "--set: select.c_fore: 1 is not allowed (it must be between 0 and 0.99)");
    EXPECT_EQ(errorOf(setFromText(settings, "control.target_ms", "0", "--set")),
              "--set: control.target_ms: 0 is not allowed (it must be between 0.05 and 10000 ms)");
    EXPECT_EQ(errorOf(setFromText(settings, "select.c_vis", "nan", "--set")),
              "--set: select.c_vis: nan is not allowed (it must be between 0 and 100)");
    EXPECT_EQ(
        errorOf(setFromText(settings, "build.desired_triangles", "900.5", "--set")),
        "--set: build.desired_triangles: 900.5 is not allowed (it must be between 16 and 1000000 triangles)");
    EXPECT_EQ(errorOf(setFromText(settings, "select.c_vis", "much", "--set")),
              "--set: select.c_vis: \"much\" is not a value of it (it must be between 0 and 100)");
    EXPECT_EQ(errorOf(setFromText(settings, "select.policy", "lakhia2", "--set")),
              "--set: select.policy: \"lakhia2\" is not a value of it (it must be one of lakhia lakhia-naive "
              "funkhouser funkhouser-incremental maciel-shirley erikson greedy screen-error coarse full frontbench)");
    EXPECT_EQ(errorOf(setFromText(settings, "select.hyst_band", "maybe", "--set")),
              "--set: select.hyst_band: \"maybe\" is not a value of it (it must be true or false)");
    EXPECT_EQ(errorOf(setFromText(settings, "select.c_viz", "1", "--set")),
              "--set: select.c_viz: there is no such knob (`frontbench knobs` lists them all)");
    EXPECT_TRUE(same(settings, Settings{}));
}

TEST(Gate, ReadsNumbersOnlyWhereTheWholeTextIsOne) {
    for (std::string_view text : {"", " 1", "1 ", "1,5", "1.5x", "0x10", "--1", "1e999", "one"}) {
        Settings settings;
        EXPECT_FALSE(setFromText(settings, "select.c_vis", text, "test")) << text;
        EXPECT_TRUE(same(settings, Settings{}));
    }
    Settings settings;
    EXPECT_TRUE(setFromText(settings, "select.c_vis", "2.5e-1", "test"));
    EXPECT_EQ(settings.select.cVis, 0.25);
    EXPECT_TRUE(setFromText(settings, "build.desired_triangles", "1e3", "test"));
    EXPECT_EQ(settings.build.desiredTriangles, 1000);
}

TEST(Gate, ReadsBooleansAndChoicesByTheirWords) {
    Settings settings;
    for (std::string_view text : {"true", "1", "on"}) {
        settings.draw.boxes = false;
        EXPECT_TRUE(setFromText(settings, "draw.boxes", text, "test"));
        EXPECT_TRUE(settings.draw.boxes) << text;
    }
    for (std::string_view text : {"false", "0", "off"}) {
        settings.draw.boxes = true;
        EXPECT_TRUE(setFromText(settings, "draw.boxes", text, "test"));
        EXPECT_FALSE(settings.draw.boxes) << text;
    }
    EXPECT_TRUE(setFromText(settings, "select.policy", "lakhia-naive", "test"));
    EXPECT_EQ(settings.select.policy, PolicyId::lakhiaNaive);
    EXPECT_FALSE(setFromText(settings, "select.policy", "1", "test"));
    EXPECT_FALSE(setFromText(settings, "select.policy", "", "test"));
}

TEST(Gate, KeepsTheSwitchOfTheHysteresisBelowItsLimit) {
    Settings settings;
    settings.select.hystSwitch = 15.0;
    settings.select.hystLimit = 45.0;
    const Settings before = settings;
    EXPECT_EQ(errorOf(setFromText(settings, "select.hyst_switch", "46", "--set")),
              "--set: select.hyst_switch: c_hystSwitch must not be above c_hystLimit (raise "
              "select.hyst_limit first)");
    EXPECT_FALSE(setFromText(settings, "select.hyst_limit", "14", "--set"));
    EXPECT_TRUE(same(settings, before));
    EXPECT_TRUE(setFromText(settings, "select.hyst_switch", "45", "--set")) << "equal is allowed";
    EXPECT_TRUE(setFromText(settings, "select.hyst_limit", "4510", "--set"));
    EXPECT_TRUE(setFromText(settings, "select.hyst_switch", "1500", "--set"));
    EXPECT_TRUE(checkTogether(settings, "test"));
    settings.select.hystLimit = 10.0;
    EXPECT_FALSE(checkTogether(settings, "test"));
}

RC_GTEST_PROP(Gate, AdmitsWhatIsInRangeAndLeavesTheSettingsAloneOtherwise, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    for (const Knob& knob : knobs()) {
        Settings settings = wideSettings();
        const double value = r.index(2) == 0 ? std::bit_cast<double>(r.bits()) : randomAdmissible(r, knob);
        const bool whole = knob.type == KnobType::real || value == std::floor(value);
        const bool good = value >= knob.low && value <= knob.high && whole;
        const bool admitted = admit(settings, knob, value, "test").has_value();
        RC_ASSERT(admitted == good);
        if (good) RC_ASSERT(knob.get(settings) == value);
        if (!good) RC_ASSERT(same(settings, wideSettings()));
    }
}

RC_GTEST_PROP(ValueLabel, ReadBackGivesTheSameBitsForEveryKnob, ()) {
    Random r(*rc::gen::arbitrary<std::uint64_t>());
    for (const Knob& knob : knobs()) {
        const double value = randomAdmissible(r, knob);
        Settings settings = wideSettings();
        RC_ASSERT(setFromText(settings, knob.path, valueLabel(knob, value), "test").has_value());
        RC_ASSERT(std::bit_cast<std::uint64_t>(knob.get(settings)) == std::bit_cast<std::uint64_t>(value));
    }
}

TEST(ValueText, IsWhatTomlCallsARealAnIntegerABooleanAndAString) {
    const auto text = [](std::string_view path, double value) { return valueText(*findKnob(path), value); };
    EXPECT_EQ(text("select.c_vis", 1.275), "1.275");
    EXPECT_EQ(text("select.c_vis", 3.0), "3.0");
    EXPECT_EQ(text("select.hyst_start", -1.0), "-1.0");
    EXPECT_EQ(text("select.hyst_start", -0.0), "-0.0");
    EXPECT_EQ(text("select.hyst_limit", 1e7), "1e+07");
    EXPECT_EQ(text("build.level_factor", 4.0), "4");
    EXPECT_EQ(text("build.desired_triangles", 1000000.0), "1000000");
    EXPECT_EQ(text("model.seed", 1e9), "1000000000");
    EXPECT_EQ(text("select.hyst_band", 1.0), "true");
    EXPECT_EQ(text("select.hyst_band", 0.0), "false");
    EXPECT_EQ(text("select.policy", 1.0), "\"lakhia-naive\"");
    EXPECT_EQ(valueLabel(*findKnob("select.policy"), 1.0), "lakhia-naive");
}

}  // namespace
}  // namespace fb
