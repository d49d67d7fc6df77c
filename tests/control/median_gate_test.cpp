#include "control/median_gate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace fb {
namespace {

RC_GTEST_PROP(MedianGate, GivesTheMiddleOfTheLastMeasurementsInOrder, ()) {
    const std::size_t frames = 2 * *rc::gen::inRange<std::size_t>(0, 8) + 1;
    const auto values = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 50));
    MedianGate gate;
    std::vector<double> so;
    for (const int value : values) {
        so.push_back(value);
        const double passed = gate.pass(value, frames);
        if (so.size() < frames) {
            RC_ASSERT(passed == value);
            continue;
        }
        std::vector<double> last(so.end() - static_cast<std::ptrdiff_t>(frames), so.end());
        std::sort(last.begin(), last.end());
        RC_ASSERT(passed == last[frames / 2]);
    }
}

TEST(MedianGate, LetsStallsOfFewerThanHalfItsFramesPass) {
    MedianGate gate;
    for (int i = 0; i < 5; ++i) gate.pass(1.0, 5);
    EXPECT_EQ(gate.pass(90.0, 5), 1.0);
    EXPECT_EQ(gate.pass(90.0, 5), 1.0);
    EXPECT_EQ(gate.pass(1.0, 5), 1.0);
    for (int i = 0; i < 5; ++i) gate.pass(1.0, 5);
    gate.pass(90.0, 5);
    gate.pass(90.0, 5);
    EXPECT_EQ(gate.pass(90.0, 5), 90.0) << "three of five are no stall";
}

}  // namespace
}  // namespace fb
