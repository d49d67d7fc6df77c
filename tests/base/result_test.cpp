#include "base/result.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/check.h"

namespace fb {
namespace {

TEST(ErrorLine, NamesFilePlaceReasonAndHintInThisOrder) {
    const Error error{Error::Kind::failed, "a.toml", "line 3", "is wrong", "do it right"};
    EXPECT_EQ(error.oneLine(), "a.toml: line 3: is wrong (do it right)");
}

TEST(ErrorLine, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ((Error{Error::Kind::failed, "", "", "is wrong", ""}).oneLine(), "is wrong");
    EXPECT_EQ((Error{Error::Kind::failed, "a", "", "is wrong", ""}).oneLine(), "a: is wrong");
    EXPECT_EQ((Error{Error::Kind::failed, "", "byte 4", "is wrong", "help"}).oneLine(),
              "byte 4: is wrong (help)");
}

RC_GTEST_PROP(ErrorLine, IsOneLineWhateverThePartsContain,
              (const std::string& file, const std::string& place, const std::string& reason,
               const std::string& hint)) {
    const std::string line =
        Error{Error::Kind::failed, file + "\r", place + "\x1b[2J", reason + "\n", hint + "\x7f"}.oneLine();
    for (const char c : line) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
}

TEST(Failure, IsOfKindFailedAndUsageFailureOfKindUsage) {
    const Result<int> failed = failure("f", "p", "r", "h");
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().kind, Error::Kind::failed);
    EXPECT_EQ(failed.error().oneLine(), "f: p: r (h)");
    const Result<int> usage = usageFailure("--frames", "is not a number", "try 100");
    ASSERT_FALSE(usage);
    EXPECT_EQ(usage.error().kind, Error::Kind::usage);
    EXPECT_EQ(usage.error().oneLine(), "--frames: is not a number (try 100)");
}

TEST(PassOn, KeepsTheErrorAndItsKindAcrossResultTypes) {
    Result<int> first = usageFailure("--frames", "is not a number");
    const Result<std::string> second = passOn(first);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().kind, Error::Kind::usage);
    EXPECT_EQ(second.error().oneLine(), "--frames: is not a number");
}

// The libraries that are linked start threads, so a plain fork of the test program would not do.
class CheckDeathTest : public testing::Test {
  protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(CheckDeathTest, PrintsTheExpressionBothSidesAndTheLine) {
    const int apples = 3;
    EXPECT_DEATH(FB_CHECK(apples == 4),
                 "bug: apples == 4 is not true \\(3 against 4\\) at .*result_test.cpp:[0-9]+");
    EXPECT_DEATH(FB_CHECK(apples > 7), "apples > 7 is not true \\(3 against 7\\)");
}

TEST_F(CheckDeathTest, StopsOnAPlainConditionToo) {
    const bool ready = false;
    EXPECT_DEATH(FB_CHECK(ready), "bug: ready is not true \\(false\\)");
    EXPECT_DEATH(FB_CHECK(!std::string("x").empty() == false), "1 against 0");
}

TEST_F(CheckDeathTest, TakesSumsOnBothSides) {
    const int a = 1, b = 2, c = 4;
    EXPECT_DEATH(FB_CHECK(a + b == c), "a \\+ b == c is not true \\(3 against 4\\)");
    EXPECT_DEATH(FB_CHECK(c < a * b), "4 against 2");
}

TEST(Check, EvaluatesItsArgumentOnceAndGoesOnWhenItHolds) {
    int calls = 0;
    const auto next = [&] { return ++calls; };
    FB_CHECK(next() == 1);
    FB_CHECK(next() != 1);
    FB_CHECK(next() >= 3);
    FB_CHECK(next() <= 4);
    FB_CHECK(next() < 6);
    FB_CHECK(next() > 5);
    EXPECT_EQ(calls, 6);
}

}  // namespace
}  // namespace fb
