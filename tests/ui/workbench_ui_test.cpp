#include <gtest/gtest.h>

#include "base/random.h"
#include "headless_ui.h"
#include "ui/plot.h"

namespace fb {
namespace {

using test::HeadlessUi;

FrameRecord recordAt(std::uint64_t frame) {
    FrameRecord record;
    record.frame = frame;
    record.timeSeconds = static_cast<double>(frame) / 30.0;
    record.actualMs = 28.0;
    record.estimateMs = 27.0;
    record.targetMs = 30.0;
    record.frontNodes = 30;
    record.levels[0] = 10;
    record.levels[1] = 20;
    return record;
}

// The Tuning panel searched for one knob alone: its slider is the first below the group's header.
ImVec2 sliderOfOnlyKnob(HeadlessUi& ui, const std::string& search) {
    ui.state.knobSearch = search;
    ui.frame();
    ui.frame();
    const float line = ImGui::GetFrameHeightWithSpacing();
    const float left = 1600.0f * (1.0f - ui.state.rightShare);
    return ImVec2(left + 40.0f, 3.5f * line);
}

TEST(WorkbenchUi, DraggingASliderEditsItsKnobAndNoOther) {
    HeadlessUi ui;
    const ImVec2 slider = sliderOfOnlyKnob(ui, "c_targetTime");
    ui.moveMouse(slider);
    ui.press();
    ui.moveMouse(ImVec2(slider.x + 60.0f, slider.y));
    ui.release();
    EXPECT_NE(ui.settings.control.targetMs, ui.reference.control.targetMs);
    for (const Knob& knob : knobs()) {
        if (knob.path == "control.target_ms") continue;
        EXPECT_EQ(knob.get(ui.settings), knob.get(ui.reference)) << knob.path;
    }
}

TEST(WorkbenchUi, ResetAllBringsEveryKnobBackToThePreset) {
    HeadlessUi ui;
    ui.settings.control.targetMs = 60.0;
    ui.settings.select.cVis = 2.0;
    ui.frame();
    const float button = ImGui::CalcTextSize("Reset all").x;
    const float line = ImGui::GetFrameHeightWithSpacing();
    ui.click(ImVec2(1600.0f - 0.5f * button - 8.0f, 1.5f * line));
    EXPECT_EQ(ui.settings.control.targetMs, ui.reference.control.targetMs);
    EXPECT_EQ(ui.settings.select.cVis, ui.reference.select.cVis);
}

TEST(WorkbenchUi, TellsTheSizeOfTheViewAndWhetherTheMouseIsOverIt) {
    HeadlessUi ui;
    Scene scene;
    scene.hierarchy.resize(1);
    ui.scene = &scene;
    ui.history.push(recordAt(1));
    ui.frame();
    ui.moveMouse(ImVec2(300.0f, 300.0f));
    UiRequests requests = ui.frame();
    EXPECT_TRUE(requests.viewHovered);
    EXPECT_NEAR(requests.viewSize.x, 1600.0 * 0.7 - 5.0, 2.0);
    EXPECT_GT(requests.viewSize.y, 450);
    ui.moveMouse(ImVec2(1500.0f, 300.0f));
    EXPECT_FALSE(ui.frame().viewHovered);
}

TEST(WorkbenchUi, HidingThePanelsGivesTheViewTheWholeWindow) {
    HeadlessUi ui;
    ui.state.hidden = true;
    ui.frame();
    EXPECT_EQ(ui.frame().viewSize.x, 1600);
}

TEST(WorkbenchUi, SurvivesTenThousandRandomInputsWithoutLeavingTheRangesOfKnobs) {
    HeadlessUi ui;
    Scene scene;
    scene.hierarchy.resize(3);
    ui.scene = &scene;
    Random random(7);
    for (std::uint64_t i = 1; i <= 10000; ++i) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = ImVec2(static_cast<float>(random.uniform(-50.0, 1650.0)), static_cast<float>(random.uniform(-50.0, 950.0)));
        io.MouseDown[0] = random.uniform() < 0.4;
        io.MouseWheel = random.uniform() < 0.1 ? static_cast<float>(random.uniform(-3.0, 3.0)) : 0.0f;
        io.KeyCtrl = random.uniform() < 0.1;
        if (random.uniform() < 0.05) io.AddInputCharacter(static_cast<unsigned>(random.uniform(32.0, 127.0)));
        if (random.uniform() < 0.02) io.DisplaySize = ImVec2(static_cast<float>(random.uniform(1.0, 2000.0)), static_cast<float>(random.uniform(1.0, 1200.0)));
        ui.history.push(recordAt(i));
        ui.frame();
    }
    for (const Knob& knob : knobs()) {
        EXPECT_GE(knob.get(ui.settings), knob.low) << knob.path;
        EXPECT_LE(knob.get(ui.settings), knob.high) << knob.path;
    }
}

TEST(Plot, TickStepsAreOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(tickStep(0.0, 30.0, 5), 10.0);
    EXPECT_DOUBLE_EQ(tickStep(0.0, 5.0, 5), 1.0);
    EXPECT_DOUBLE_EQ(tickStep(0.0, 0.7, 5), 0.2);
    EXPECT_DOUBLE_EQ(tickStep(0.0, 2400.0, 5), 500.0);
}

}  // namespace
}  // namespace fb
