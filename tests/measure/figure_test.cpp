#include "measure/figure.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "measure/fit_axes.h"
#include "measure/reduce_series.h"

namespace fb {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> counting(std::size_t count) {
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), 0.0);
    return values;
}

TEST(NiceTicks, StandAtOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_EQ(niceTicks(0.0, 10.0, 5).at, (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(niceTicks(0.0, 10.0, 10).step, 1.0);
    EXPECT_EQ(niceTicks(0.0, 10.0, 4).step, 5.0);
    EXPECT_EQ(niceTicks(-3.0, 12.0, 4).at, (std::vector<double>{0, 5, 10}));
    EXPECT_EQ(niceTicks(0.0, 42.0, 3).at, (std::vector<double>{0, 20, 40}));
    EXPECT_DOUBLE_EQ(niceTicks(0.001, 0.0042, 4).step, 0.001);
    EXPECT_EQ(niceTicks(0.0, 2.0, 10, 1.0).at, (std::vector<double>{0, 1, 2}));
}

TEST(NiceTicks, OfNoRangeAreNone) {
    EXPECT_TRUE(niceTicks(1.0, 1.0, 5).at.empty());
    EXPECT_TRUE(niceTicks(2.0, 1.0, 5).at.empty());
    EXPECT_TRUE(niceTicks(0.0, std::numeric_limits<double>::infinity(), 5).at.empty());
    EXPECT_TRUE(niceTicks(kNan, 1.0, 5).at.empty());
}

RC_GTEST_PROP(NiceTicks, AreFewAndInside, ()) {
    const double low = *rc::gen::inRange(-1000, 1000),
                 size = std::pow(10.0, *rc::gen::inRange(-40, 60) / 10.0);
    const int most = *rc::gen::inRange(2, 20);
    const Ticks ticks = niceTicks(low, low + size, most);
    RC_ASSERT(ticks.at.size() <= std::size_t(most) + 1);
    RC_ASSERT(double(ticks.at.size()) >= std::floor(most / 2.5));
    for (double at : ticks.at) RC_ASSERT((at >= low - 1e-6 * size && at <= low + size * (1.0 + 1e-6)));
}

TEST(TickLabel, HasTheDigitsOfItsStep) {
    EXPECT_EQ(tickLabel(10.0, 5.0), "10");
    EXPECT_EQ(tickLabel(0.5, 0.5), "0.5");
    EXPECT_EQ(tickLabel(1.0, 0.25), "1.0");
    EXPECT_EQ(tickLabel(-0.02, 0.01), "-0.02");
    EXPECT_EQ(tickLabel(0.0, 0.001), "0.000");
    EXPECT_EQ(tickLabel(2e7, 1e7), "2e+07");
    EXPECT_EQ(tickLabel(1.5e7, 5e6), "1.5e+07");
    EXPECT_EQ(tickLabel(3e-5, 1e-5), "3e-05");
}

TEST(MovingAverage, IsTheMeanOfTheLastValues) {
    EXPECT_EQ(movingAverage({1, 2, 3, 4, 5}, 3), (std::vector<double>{1, 1.5, 2, 3, 4}));
    EXPECT_EQ(movingAverage({}, 3), (std::vector<double>{}));
}

TEST(MovingAverage, LeavesOutWhatIsNotFinite) {
    const std::vector<double> means = movingAverage({kNan, 2, kNan, 4}, 2);
    EXPECT_TRUE(std::isnan(means[0]));
    EXPECT_EQ(means[1], 2.0);
    EXPECT_EQ(means[2], 2.0);
    EXPECT_EQ(means[3], 4.0);
}

TEST(AxisEnd, IsNotStretchedByOneSpike) {
    std::vector<double> values(200, 10.0);
    values[7] = 12.0;
    EXPECT_EQ(axisEnd(values), 12.0);
    values[7] = 500.0;  // above three times the 99th percentile, 10
    EXPECT_EQ(axisEnd(values), 15.0);
}

TEST(ReduceLine, KeepsASpikeOfOneFrameAmongAHundredThousand) {
    std::vector<double> x = counting(100000), values(100000, 1.0);
    for (double& v : x) v *= 900.0 / 100000.0;
    values[56789] = 310.0;
    values[77777] = -5.0;
    const auto runs = reduceLine(x, values);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_LE(runs[0].size(), 4u * 900u);
    EXPECT_EQ(std::ranges::count(runs[0], glm::dvec2(x[56789], 310.0)), 1);
    EXPECT_EQ(std::ranges::count(runs[0], glm::dvec2(x[77777], -5.0)), 1);
    EXPECT_TRUE(std::ranges::is_sorted(runs[0], {}, [](const glm::dvec2& p) { return p.x; }));
}

TEST(ReduceLine, KeepsFirstLeastMostAndLastOfAColumn) {
    const std::vector<double> x = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 1.5};
    const auto runs = reduceLine(x, std::vector<double>{5, 6, 9, 7, 1, 4, 3});
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0], (std::vector<glm::dvec2>{{0.0, 5}, {0.2, 9}, {0.4, 1}, {0.5, 4}, {1.5, 3}}));
}

TEST(ReduceLine, LeavesAGapWhereTheValueIsNotFinite) {
    const auto runs = reduceLine(counting(6), std::vector<double>{kNan, 1, 2, kNan, 3, kNan});
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0], (std::vector<glm::dvec2>{{1, 1}, {2, 2}}));
    EXPECT_EQ(runs[1], (std::vector<glm::dvec2>{{4, 3}}));
}

TEST(ReduceLine, KeepsEveryPointWhereThereIsRoom) {
    const std::vector<double> values = {5, 3, 8, 1};
    const auto runs = reduceLine(counting(4), values);
    ASSERT_EQ(runs.size(), 1u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(runs[0][i], glm::dvec2(double(i), values[i]));
}

PlotSeries seriesOf(std::vector<double> values, SeriesKind kind = SeriesKind::line) {
    PlotSeries series;
    series.name = "s";
    series.values = std::move(values);
    series.kind = kind;
    return series;
}

TEST(GatherPanel, StacksAreas) {
    Figure figure;
    figure.x = {0, 1};
    PlotPanel panel;
    panel.series = {seriesOf({1, 2}, SeriesKind::area), seriesOf({9, 9}),
                    seriesOf({10, kNan}, SeriesKind::area)};
    const PanelData data = gatherPanel(figure, panel);
    EXPECT_EQ(data.values[0], (std::vector<double>{1, 2}));
    EXPECT_EQ(data.values[1], (std::vector<double>{9, 9}));
    EXPECT_EQ(data.values[2], (std::vector<double>{11, 2}));
    EXPECT_EQ(data.range.low, 1.0);
    EXPECT_EQ(data.range.high, 11.0);
}

TEST(FitYAxis, ReachesFromTickToTickAroundTheData) {
    PlotPanel panel;
    panel.heightPixels = 200.0;  // at most 5 intervals
    PanelData data;
    data.empty = false;
    data.range = {3.0, 43.0};
    const PlotAxis axis = fitYAxis(panel, data);
    EXPECT_EQ(axis.range.low, 0.0);
    EXPECT_EQ(axis.range.high, 50.0);
    panel.high = 33.0;
    EXPECT_EQ(fitYAxis(panel, data).range.high, 33.0);
    EXPECT_TRUE(fitYAxis(panel, data).endsBelow(34.0));
    EXPECT_FALSE(fitYAxis(panel, data).endsBelow(33.0 + 1e-12));
}

TEST(FitYAxis, HasSomeRangeForAnyData) {
    for (double value : {0.0, 5.0, -5.0, 1e9, 1e-9}) {
        for (bool fromZero : {true, false}) {
            PlotPanel panel;
            panel.fromZero = fromZero;
            PanelData data;
            data.empty = false;
            data.range = {value, value};
            const PlotAxis axis = fitYAxis(panel, data);
            EXPECT_GT(axis.range.high, axis.range.low) << value;
            EXPECT_LE(axis.range.low, value);
            EXPECT_GE(axis.range.high, value);
            EXPECT_GE(axis.ticks.at.size(), 2u);
        }
    }
}

std::vector<std::string> wordsOf(const Drawing& drawing) {
    std::vector<std::string> words;
    for (const DrawnItem& item : drawing.items) {
        if (const auto* text = std::get_if<DrawnText>(&item)) words.push_back(text->text);
    }
    return words;
}

bool says(const Drawing& drawing, std::string_view word) {
    return std::ranges::count(wordsOf(drawing), word) > 0;
}

TEST(LayOut, NamesAxesSeriesAndOutliers) {
    Figure figure;
    figure.title = "Title";
    figure.xTitle = "time (s)";
    figure.x = counting(50);
    PlotPanel panel;
    panel.yTitle = "time (ms)";
    panel.series = {seriesOf(counting(50))};
    panel.high = 47.0;  // 48 and 49 lie beyond; ticks every 10
    figure.panels = {panel};
    const Drawing drawing = layOut(figure);
    for (const char* word : {"Title", "time (s)", "time (ms)", "s", "2 beyond the axis, up to 49"}) {
        EXPECT_TRUE(says(drawing, word)) << word;
    }
}

TEST(LayOut, SaysWhereThereIsNoData) {
    Figure figure;
    PlotPanel panel;
    panel.series = {seriesOf({})};
    figure.panels = {panel};
    EXPECT_TRUE(says(layOut(figure), "no data"));
    figure.x = {1.0, 2.0};
    figure.panels[0].series[0].values = {kNan, kNan};
    EXPECT_TRUE(says(layOut(figure), "no data"));
    figure.panels[0].series[0].values = {1.0, kNan};
    EXPECT_FALSE(says(layOut(figure), "no data"));
}

// Every point of every item, and every word by its estimated width, lies on the picture; no words overlap.
TEST(LayOut, ClipsNothingAndLetsNoWordsOverlap) {
    Figure figure;
    figure.title = "A title of some length";
    figure.subtitle = "scene, policy, preset, path";
    figure.xTitle = "time (s)";
    for (std::size_t i = 0; i < 3000; ++i) figure.x.push_back(double(i) / 30.0);
    for (double scale : {1e-6, 1.0, 123456.0}) {
        PlotPanel panel;
        panel.yTitle = "quantity (unit)";
        panel.fromZero = scale > 1.0;
        for (int k = 0; k < 9; ++k) {
            PlotSeries series = seriesOf({}, k < 3   ? SeriesKind::area
                                             : k < 5 ? SeriesKind::impulses
                                                     : SeriesKind::line);
            series.name = "a series with a rather long name " + std::to_string(k);
            series.dashed = k == 8;
            for (std::size_t i = 0; i < 3000; ++i) {
                series.values.push_back(i % 700 == 5 ? kNan : scale * std::sin(double(i) / 50.0 + k));
            }
            panel.series.push_back(series);
        }
        figure.panels.push_back(panel);
    }
    const Drawing drawing = layOut(figure);
    const auto inside = [&](const glm::dvec2& p) {
        return p.x >= 0.0 && p.y >= 0.0 && p.x <= drawing.width && p.y <= drawing.height;
    };
    struct Words {
        double left, top, right, bottom;
    };
    std::vector<Words> all;
    for (const DrawnItem& item : drawing.items) {
        if (const auto* line = std::get_if<DrawnLine>(&item)) {
            EXPECT_TRUE(std::ranges::all_of(line->points, inside));
        } else if (const auto* shape = std::get_if<DrawnShape>(&item)) {
            EXPECT_TRUE(std::ranges::all_of(shape->points, inside));
        } else if (const auto* text = std::get_if<DrawnText>(&item)) {
            const double width = textWidth(text->text, text->size, text->bold);
            const double before = width * (text->anchor == TextAnchor::start    ? 0.0
                                           : text->anchor == TextAnchor::middle ? 0.5
                                                                                : 1.0);
            const glm::dvec2 at = text->at;
            all.push_back(text->upward
                              ? Words{at.x - text->size * 0.8, at.y - width + before, at.x, at.y + before}
                              : Words{at.x - before, at.y - text->size * 0.8, at.x - before + width, at.y});
            EXPECT_TRUE(inside({all.back().left, all.back().top})) << text->text;
            EXPECT_TRUE(inside({all.back().right, all.back().bottom})) << text->text;
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_TRUE(all[i].right <= all[k].left || all[k].right <= all[i].left ||
                        all[i].bottom <= all[k].top || all[k].bottom <= all[i].top)
                << i << " and " << k;
        }
    }
}

}  // namespace
}  // namespace fb
