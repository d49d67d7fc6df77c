#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "measure/replay_figures.h"
#include "small_report.h"
#include "xml_checker.h"

namespace fb {
namespace {

class WriteReport : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("fb_report_test_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

const std::set<std::string> kPlots = {"time", "levels", "estimate", "toggles", "memory", "error"};

TEST_F(WriteReport, WritesTablesAndPlotsAndNothingElse) {
    const ReplayReport report = test::smallReport();
    const std::filesystem::path out = folder_ / "deep" / "out";
    ASSERT_TRUE(writeReport(report, out).has_value());
    EXPECT_EQ(textOf(out / "frames.csv"), framesCsv(report));
    EXPECT_EQ(textOf(out / "summary.json"), summaryJson(report));
    EXPECT_EQ(textOf(out / "loads.csv"), report.loadsCsv);
    std::set<std::string> files, expected;
    for (const auto& entry : std::filesystem::directory_iterator(out / "plots")) {
        files.insert(entry.path().filename().string());
    }
    for (const std::string& name : kPlots) {
        expected.insert(name + ".png");
        expected.insert(name + ".svg");
    }
    EXPECT_EQ(files, expected);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}), 4);
}

TEST_F(WriteReport, WritesPlotsThatCanBeReadAndShowSomething) {
    const ReplayReport report = test::smallReport();
    ASSERT_TRUE(writeReport(report, folder_).has_value());
    for (const NamedFigure& named : replayFigures(report)) {
        const Drawing drawing = layOut(named.figure);
        const std::string png = (folder_ / "plots" / (named.name + ".png")).string();
        const auto input = OIIO::ImageInput::open(png);
        ASSERT_TRUE(input) << png;
        EXPECT_EQ(input->spec().width, drawing.width);
        EXPECT_EQ(input->spec().height, drawing.height);
        EXPECT_EQ(input->spec().width, 1000);
        EXPECT_NEAR(input->spec().height, 470, 70);
        ASSERT_EQ(input->spec().nchannels, 3);
        std::vector<std::uint8_t> pixels(3u * 1000u * std::size_t(drawing.height));
        ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
        EXPECT_EQ(pixels, rasterise(drawing).pixels);
        std::set<std::uint32_t> colours;
        for (std::size_t i = 0; i < pixels.size(); i += 3) {
            colours.insert(std::uint32_t(pixels[i]) << 16 | std::uint32_t(pixels[i + 1]) << 8 |
                           pixels[i + 2]);
        }
        EXPECT_GT(colours.size(), 20u) << png;
        const std::string svg = textOf(folder_ / "plots" / (named.name + ".svg"));
        EXPECT_EQ(test::faultInXml(svg), "") << named.name;
    }
}

TEST_F(WriteReport, OfNoFramesSaysSo) {
    ReplayReport report = test::smallReport();
    report.frames.clear();
    ASSERT_TRUE(writeReport(report, folder_).has_value());
    for (const std::string& name : kPlots) {
        const std::string svg = textOf(folder_ / "plots" / (name + ".svg"));
        EXPECT_EQ(test::faultInXml(svg), "");
        EXPECT_NE(svg.find("no data"), std::string::npos) << name;
    }
}

TEST_F(WriteReport, IsTheSameTwice) {
    const ReplayReport report = test::smallReport();
    ASSERT_TRUE(writeReport(report, folder_ / "a").has_value());
    ASSERT_TRUE(writeReport(report, folder_ / "b").has_value());
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "a")) {
        if (!entry.is_regular_file()) continue;
        EXPECT_EQ(textOf(entry.path()),
                  textOf(folder_ / "b" / std::filesystem::relative(entry.path(), folder_ / "a")));
    }
}

// A file stands where a folder is needed: refused for every user, root too.
TEST_F(WriteReport, IntoAFolderThatCannotBeMadeIsAnError) {
    std::ofstream(folder_ / "file") << "x";
    const Result<void> written = writeReport(test::smallReport(), folder_ / "file" / "out");
    ASSERT_FALSE(written.has_value());
    EXPECT_NE(written.error().oneLine().find("file"), std::string::npos);
}

TEST_F(WriteReport, OverSomethingThatIsNoFileIsAnError) {
    std::filesystem::create_directories(folder_ / "plots" / "memory.png" / "occupied");
    const Result<void> written = writeReport(test::smallReport(), folder_);
    ASSERT_FALSE(written.has_value());
    EXPECT_NE(written.error().file.find("memory.png"), std::string::npos) << written.error().oneLine();
}

std::vector<double> seriesOf(const ReplayReport& report, std::string_view figure, std::size_t panel,
                             std::size_t series) {
    for (const NamedFigure& named : replayFigures(report)) {
        if (named.name == figure) return named.figure.panels.at(panel).series.at(series).values;
    }
    return {};
}

TEST(ReplayFigures, ShowWhatTheFramesHold) {
    ReplayReport report = test::smallReport();
    for (FrameRecord& frame : report.frames) {
        frame.residentBytes *= 1 << 20;
        frame.vTimeMs = 2e-6;
    }
    using Values = std::vector<double>;
    EXPECT_EQ(seriesOf(report, "time", 0, 1), (Values{24, 36, 30}));
    EXPECT_EQ(seriesOf(report, "levels", 0, 0), (Values{1, 2, 0}));
    EXPECT_EQ(seriesOf(report, "levels", 1, 2), (Values{50, 0, 0}));
    EXPECT_EQ(seriesOf(report, "estimate", 0, 0), (Values{-25, 25, -10}));
    EXPECT_EQ(seriesOf(report, "estimate", 0, 1), (Values{-25, 0, -10.0 / 3.0}));
    EXPECT_EQ(seriesOf(report, "estimate", 1, 0), (Values{2, 2, 2}));
    EXPECT_EQ(seriesOf(report, "toggles", 0, 0), (Values{1, 0, 0}));
    EXPECT_EQ(seriesOf(report, "toggles", 0, 1), (Values{0, -1, 0}));
    EXPECT_EQ(seriesOf(report, "toggles", 0, 2), (Values{1, 1, 2.0 / 3.0}));
    EXPECT_EQ(seriesOf(report, "memory", 0, 0), (Values{50, 90, 100}));
    EXPECT_EQ(seriesOf(report, "error", 0, 0), (Values{1, 3, 2}));
    EXPECT_EQ(seriesOf(report, "error", 1, 0), (Values{4, 10, 6}));
}

}  // namespace
}  // namespace fb
