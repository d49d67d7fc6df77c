#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/report.h"

namespace fb {
namespace {

TEST(Describe, GivesMeanAndDeviationOfAllValues) {
    const Distribution d = describe({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
    EXPECT_DOUBLE_EQ(d.mean, 5.0);
    EXPECT_DOUBLE_EQ(d.sd, 2.0);  // 32 / 8 = 4; divided by 7 it would be 2.14
    EXPECT_EQ(d.max, 9.0);
}

// Distances from 4: 2 0 0 0 1 1 3 5.
TEST(Describe, GivesADeviationThatFewFarValuesDoNotMove) {
    EXPECT_DOUBLE_EQ(describe({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}).robustSd, 1.4826);
    EXPECT_DOUBLE_EQ(describe({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 1e6}).robustSd, 1.4826);
    EXPECT_EQ(describe({}).robustSd, 0.0);
}

TEST(Describe, TakesPercentilesByNearestRank) {
    std::vector<double> values;
    for (int i = 20; i >= 1; --i) values.push_back(i);  // 20 % steps of 5: rank 10, 19, 20
    const Distribution d = describe(values);
    EXPECT_EQ(d.p50, 10.0);
    EXPECT_EQ(d.p95, 19.0);
    EXPECT_EQ(d.p99, 20.0);
}

TEST(Describe, LeavesOutWhatIsNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const Distribution d = describe({nan, 1.0, inf, 3.0, -inf});
    EXPECT_EQ(d.mean, 2.0);
    EXPECT_EQ(d.sd, 1.0);
    EXPECT_EQ(d.p50, 1.0);
    EXPECT_EQ(d.max, 3.0);
}

TEST(Describe, OfNoValuesIsAllZero) {
    for (const std::vector<double>& values :
         {std::vector<double>{}, std::vector<double>{std::numeric_limits<double>::quiet_NaN()}}) {
        const Distribution d = describe(values);
        for (double v : {d.mean, d.sd, d.p50, d.p95, d.p99, d.max}) EXPECT_EQ(v, 0.0);
    }
}

// The definition, counted out: the smallest value that at least p % do not exceed.
double slowPercentile(const std::vector<double>& values, int percent) {
    double best = std::numeric_limits<double>::infinity();
    for (double candidate : values) {
        const auto notAbove = std::ranges::count_if(values, [&](double v) { return v <= candidate; });
        if (notAbove * 100 >= percent * static_cast<long>(values.size())) best = std::min(best, candidate);
    }
    return best;
}

RC_GTEST_PROP(Describe, AgreesWithCountingOutThePercentiles, ()) {
    const auto numbers = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 50)));
    const std::vector<double> values(numbers.begin(), numbers.end());
    const Distribution d = describe(values);
    RC_ASSERT(d.p50 == slowPercentile(values, 50));
    RC_ASSERT(d.p95 == slowPercentile(values, 95));
    RC_ASSERT(d.p99 == slowPercentile(values, 99));
    RC_ASSERT(d.max == slowPercentile(values, 100));
}

}  // namespace
}  // namespace fb
