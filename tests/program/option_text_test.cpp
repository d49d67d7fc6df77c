// Texts of options become values, or one usage error.
#include <gtest/gtest.h>

#include "app/option_text.h"
#include "app/progress_display.h"

namespace fb {
namespace {

TEST(OptionText, CountsMayHaveUnits) {
    EXPECT_EQ(parseCount("480000").value(), 480000u);
    EXPECT_EQ(parseCount("480K").value(), 480000u);
    EXPECT_EQ(parseCount("8.95M").value(), 8950000u);
    EXPECT_EQ(parseCount("1G").value(), 1000000000u);
    EXPECT_EQ(parseCount("0").value(), 0u);
    for (const char* text : {"", "K", "-1", "1.5", "1.0005K1", "5T", "nan", "inf", "1e30", " 1", "0x10"}) {
        const Result<std::uint64_t> count = parseCount(text);
        ASSERT_FALSE(count) << text;
        EXPECT_EQ(count.error().kind, Error::Kind::usage);
    }
}

TEST(OptionText, SizesAreTwoSidesWithinLimits) {
    EXPECT_EQ(parseSize("1280x720").value(), glm::ivec2(1280, 720));
    EXPECT_EQ(parseSize("16384x1").value(), glm::ivec2(16384, 1));
    for (const char* text : {"", "x", "1280", "1280x", "x720", "0x720", "1280x0", "-1x5", "16385x1", "12 x 7", "1280x720p"}) {
        EXPECT_FALSE(parseSize(text)) << text;
    }
}

// c_hystSwitch must not exceed c_hystLimit: raising both works in either order, and a refused set changes nothing.
TEST(OptionText, SetsMayComeInAnyOrder) {
    for (const std::vector<std::string>& sets :
         {std::vector<std::string>{"select.hyst_switch=1500", "select.hyst_limit=4510"},
          std::vector<std::string>{"select.hyst_limit=4510", "select.hyst_switch=1500"}}) {
        Settings settings;
        ASSERT_TRUE(applySets(settings, sets));
        EXPECT_EQ(settings.select.hystSwitch, 1500.0);
        EXPECT_EQ(settings.select.hystLimit, 4510.0);
    }
    Settings settings;
    const Result<void> refused = applySets(settings, {"control.target_ms=20", "control.target_ms"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, Error::Kind::usage);
    EXPECT_EQ(settings.control.targetMs, Settings{}.control.targetMs);
}

TEST(ProgressLine, IsReadBack) {
    double fraction = 0.0;
    std::string phase;
    EXPECT_TRUE(parseProgressLine("progress 0.4213 build blocks", fraction, phase));
    EXPECT_DOUBLE_EQ(fraction, 0.4213);
    EXPECT_EQ(phase, "build blocks");
    EXPECT_FALSE(parseProgressLine("note: 3 triangles were dropped", fraction, phase));
    EXPECT_FALSE(parseProgressLine("", fraction, phase));
    EXPECT_DOUBLE_EQ(fraction, 0.4213);
}

}  // namespace
}  // namespace fb
