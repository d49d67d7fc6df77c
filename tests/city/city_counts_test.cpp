// The city holds what its options ask for, over a wide range of them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "city/load_city.h"
#include "import/city_budget.h"

namespace fb {
namespace {

double ratio(std::uint64_t actual, std::uint64_t wanted) {
    return static_cast<double>(actual) / static_cast<double>(wanted);
}

void expectAsAsked(const CityOptions& options) {
    const auto city = test::cityOf(options);
    ASSERT_NE(city, nullptr);
    EXPECT_EQ(city->blockCount(), options.blocks);
    const test::CityCounts counts = test::countsOf(test::loadAll(*city));
    EXPECT_NEAR(ratio(counts.triangles, options.triangles), 1.0, 0.05);
    EXPECT_NEAR(ratio(counts.texels, options.texels), 1.0, 0.10);
    EXPECT_NEAR(ratio(counts.grey, counts.triangles), 0.10, 0.05);
    EXPECT_EQ(city->info().report.sourceTriangles, counts.triangles);
    EXPECT_EQ(city->info().report.keptTriangles, counts.triangles);
}

TEST(CityCounts, TheTinyTestCityHasWhatWasAskedFor) {
    expectAsAsked({2, 4000, 65536, 1});
}

TEST(CityCounts, ASmallCityHasWhatWasAskedFor) {
    expectAsAsked(test::smallCity(3));
}

TEST(CityCounts, ASingleBlockHasWhatWasAskedFor) {
    expectAsAsked({1, 5000, 40000, 8});
}

// Planning alone is quick, so the large sizes are checked on the plan, which the blocks must meet exactly.
TEST(CityCounts, TheSizesOfTheThesisAndTheDefaultArePlannedExactly) {
    for (const CityOptions& options : {CityOptions{}, CityOptions{114, 8950000, 937000000, 1}}) {
        const city::CityPlan plan = city::makePlan(options);
        std::uint64_t triangles = 0, grey = 0, texels = 0;
        for (const city::UnitBudget& budget : city::shareBudget(plan, options)) {
            triangles += budget.triangles;
            grey += budget.greyTriangles;
            texels += budget.texels;
        }
        EXPECT_NEAR(ratio(triangles, options.triangles), 1.0, 0.01);
        EXPECT_NEAR(ratio(texels, options.texels), 1.0, 0.01);
        EXPECT_NEAR(ratio(grey, triangles), 0.10, 0.02);
    }
}

RC_GTEST_PROP(CityCountsProperty, AnyAcceptedOptionsAreMet, ()) {
    CityOptions options;
    options.blocks = *rc::gen::inRange<std::uint64_t>(1, 40);
    // From the least that is accepted to fine scans; the logarithm is spread evenly.
    options.triangles = options.blocks * (std::uint64_t{1000} << *rc::gen::inRange(0, 10));
    options.texels = options.blocks * (std::uint64_t{8192} << *rc::gen::inRange(0, 10));
    options.seed = *rc::gen::arbitrary<std::uint64_t>();
    const city::CityPlan plan = city::makePlan(options);
    RC_ASSERT(plan.units.size() == options.blocks);
    std::uint64_t triangles = 0, grey = 0, texels = 0;
    for (const city::UnitBudget& budget : city::shareBudget(plan, options)) {
        triangles += budget.triangles;
        grey += budget.greyTriangles;
        texels += budget.texels;
    }
    RC_ASSERT(std::abs(ratio(triangles, options.triangles) - 1.0) < 0.05);
    RC_ASSERT(std::abs(ratio(texels, options.texels) - 1.0) < 0.10);
    RC_ASSERT(ratio(grey, triangles) > 0.05);
    RC_ASSERT(ratio(grey, triangles) < 0.15);
}

TEST(CityCounts, BlocksDifferInSizeByAtMostAFactorOfFourAroundTheMean) {
    const auto city = test::cityOf({16, 64000, 200000, 2});
    ASSERT_NE(city, nullptr);
    std::size_t least = ~std::size_t{0}, most = 0;
    for (const SourceBlock& block : test::loadAll(*city)) {
        least = std::min(least, block.mesh.triangles.size());
        most = std::max(most, block.mesh.triangles.size());
    }
    EXPECT_GT(most, least * 5 / 4);  // they do vary
    EXPECT_GT(least, 64000u / 16u / 3u);
    EXPECT_LT(most, 64000u / 16u * 3u);
}

TEST(CityOptions, RefusedOnesAreUsageErrorsThatNameTheOption) {
    const auto expectRefused = [](const CityOptions& options, const char* name) {
        const auto city = makeCity(options);
        ASSERT_FALSE(city.has_value()) << name;
        EXPECT_EQ(city.error().kind, Error::Kind::usage);
        EXPECT_EQ(city.error().file, name);
        EXPECT_FALSE(city.error().hint.empty());
    };
    expectRefused({0, 480000, 24000000, 1}, "--blocks");
    expectRefused({10001, 480000000, 240000000, 1}, "--blocks");
    expectRefused({~std::uint64_t{0}, 480000, 24000000, 1}, "--blocks");
    expectRefused({16, 15999, 24000000, 1}, "--triangles");
    expectRefused({16, 32000001, 24000000, 1}, "--triangles");
    expectRefused({16, ~std::uint64_t{0}, 24000000, 1}, "--triangles");
    expectRefused({16, 480000, 131071, 1}, "--texels");
    expectRefused({16, 480000, 256000001, 1}, "--texels");
}

TEST(CityOptions, TheLeastAndTheMostThatAreAcceptedAreMade) {
    EXPECT_NE(test::cityOf({2, 2000, 16384, 1}), nullptr);
    EXPECT_NE(test::cityOf({2, 4000000, 32000000, 1}), nullptr);
}

}  // namespace
}  // namespace fb
